// SPDX-License-Identifier: MIT
//
// What is wrong with a log, thrown where it is found. read_log gives it the
// file's name; it is of no line.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "text/diagnostic.hpp"

namespace btcheck {

inline Diagnostic flaw(std::string_view code, std::string message,
                       std::string help = {}) {
  Diagnostic found;
  found.code = code;
  found.message = std::move(message);
  found.help = std::move(help);
  return found;
}

// BT1303: "the log is damaged: ...".
inline Diagnostic damage(const std::string& what) {
  return flaw("BT1303", "the log is damaged: " + what);
}

}  // namespace btcheck
