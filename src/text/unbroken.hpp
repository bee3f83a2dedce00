// SPDX-License-Identifier: MIT
//
// A name is one line, wherever it is shown.
#pragma once

#include <string>
#include <string_view>

namespace btcheck {

// The text with each line feed written out, as `harmless` writes all that it
// does not leave: "\u{a}". Every reader does this to the names that it reads,
// so that none of them begins a line of a report.
inline std::string unbroken(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n') {
      line += "\\u{a}";
    } else {
      line += c;
    }
  }
  return line;
}

}  // namespace btcheck
