// SPDX-License-Identifier: MIT
//
// --from: where runs begin, instead of where those of the tree do.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "check/check.hpp"
#include "cli/options/options.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// The recording of --from, read once and asked of each network.
class StartFrom {
 public:
  // Reads it, or shows what is wrong with it.
  static std::optional<StartFrom> read(const Options& options,
                                       const Limits& limits);

  // "from run.itf.json@2"
  std::string text() const;

  // Has the network begin in the state of that number, from 0, of those that
  // the recording leaves open; where there are fewer, in the last. Says why
  // not.
  std::vector<Diagnostic> begin(const BehaviorTree& tree, Network& network,
                                const TreeInput& input, std::size_t number,
                                const Limits& limits);

  // Of the networks asked so far, the most states that were left open.
  std::size_t count() const { return count_; }

 private:
  std::string file_;
  std::optional<int> tick_;
  LogReading reading_;
  std::variant<BehaviorLog, RecordedRun> recording_;
  std::size_t count_ = 0;
};

// Has a network that is not asked rules begin there: one state, or it is
// refused (BT1809). False, and shows why, where that cannot be.
bool begin_from(const Options& options, const BehaviorTree& tree,
                const TreeInput& input, Network& network, const Limits& limits);

// Checks from every state that the recording leaves open; a rule holds when it
// holds from each. Nothing, and shows why, where the recording cannot be read.
std::optional<CheckResult> check_from(const Options& options,
                                      const TreeInput& tree,
                                      const std::vector<InputFile>& properties,
                                      CheckOptions how);

}  // namespace btcheck
