// SPDX-License-Identifier: MIT
//
// What all fuzzers share: one entry point for libFuzzer, and how a flaw ends
// the program.
#pragma once

#include <string_view>

#include "text/diagnostic.hpp"

namespace btcheck {

// What a fuzzer does with any bytes; each program has one.
void check_bytes(std::string_view bytes);

// Ends the program where the condition does not hold.
void require(bool condition);
// The same where a flaw was found, which it says.
void require_none(std::string_view flaw);

// A value or errors, never both, and errors that can be shown.
template <class Value>
void require_sound(const Result<Value>& read) {
  require(has_error(read.diagnostics) != read.value.has_value());
  for (const Diagnostic& found : read.diagnostics) {
    require(!render(found).empty());
  }
}

}  // namespace btcheck
