// SPDX-License-Identifier: MIT
//
// What is wrong with a log, thrown where it is found. read_log gives it the
// file's name; it is of no line.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "explore/state/limits.hpp"
#include "text/choice.hpp"
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

// BT1311, unless all limits are kept.
inline void keep_limits(const Limits& limits, std::size_t bytes) {
  const StopReason stopped = limits.reached({.bytes = bytes});
  if (stopped == StopReason::None) return;
  throw flaw(
      "BT1311",
      stopped == StopReason::Timeout
          ? fmt::format("reading the log takes longer than {} allows",
                        word(Choice::Timeout))
      : stopped == StopReason::Interrupted
          ? "reading the log was interrupted"
          : fmt::format("reading the log takes more memory than {} allows",
                        word(Choice::Memory)),
      "record the topic of the tree alone");
}

}  // namespace btcheck
