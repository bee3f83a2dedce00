// SPDX-License-Identifier: MIT
//
// A report of the door beside that of the program.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace btcheck {

// Without what differs from run to run, and what only a command has.
inline nlohmann::json comparable(const std::string& text) {
  nlohmann::json report = nlohmann::json::parse(text);
  report.erase("timing");
  for (nlohmann::json& tree : report["trees"]) tree.erase("timing");
  return report;
}

}  // namespace btcheck
