// SPDX-License-Identifier: MIT
//
// A recording of a robot as a file that is a whole log at any time.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "cli/inputs/files.hpp"
#include "trace/logs/behavior_log.hpp"

namespace btcheck {

// "robot.btlog" is the first, "robot-2.btlog" the second; with a word before
// the number where several robots are recorded, "robot-arm_1667-2.btlog".
std::string recording_name(const std::string& name, const std::string& word,
                           int number);

class LogFile {
 public:
  // The log, with its first records, takes the place of what was there. Returns
  // why it cannot be written, or "".
  std::string begin(const std::string& name, const BehaviorLog& log);
  std::string add(std::span<const LogTransition> records);

  const std::string& name() const { return name_; }

 private:
  std::string flaw() const;

  std::string name_;
  std::unique_ptr<OpenFile> file_;
};

}  // namespace btcheck
