// SPDX-License-Identifier: MIT
//
// The words of scripts.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace btcheck::btcpp {

enum class ScriptTokenKind : unsigned char {
  Name,
  Number,  // decimal or hexadecimal
  Truth,   // true, false
  Text,    // in single quotes
  Operator,
  Bad,  // an unfinished string or number, a character of no operator
  End
};

struct ScriptToken {
  ScriptTokenKind kind = ScriptTokenKind::End;
  std::string_view text;  // as written, quotes included
  std::size_t at = 0;     // byte
};

// The last is the End; the text must outlive them.
std::vector<ScriptToken> tokens_of(std::string_view script);

}  // namespace btcheck::btcpp
