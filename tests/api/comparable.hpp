// SPDX-License-Identifier: MIT
//
// A report of the door beside that of the program.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace btcheck {

// Without what differs from run to run, and what only a command has; options
// and fields of the request have one name.
inline nlohmann::json comparable(std::string text) {
  const std::string field = "`leaves`", option = "--leaves";
  for (std::size_t at = 0; (at = text.find(field, at)) != text.npos;) {
    text.replace(at, field.size(), option);
  }
  nlohmann::json report = nlohmann::json::parse(text);
  report.erase("timing");
  for (nlohmann::json& tree : report["trees"]) tree.erase("timing");
  return report;
}

}  // namespace btcheck
