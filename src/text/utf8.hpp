// SPDX-License-Identifier: MIT
//
// Text of unknown origin as code points.
#pragma once

#include <cstddef>
#include <string_view>

namespace btcheck {

struct CodePoint {
  char32_t value = 0;
  std::size_t length = 1;  // bytes
  bool is_valid = false;   // an invalid one is a single byte
};

// The code point that begins at text[at]; `at` must be below the size.
CodePoint decode(std::string_view text, std::size_t at);

// How many there are, each invalid byte counted as one.
int count_code_points(std::string_view text);

// Control characters, and those that draw nothing of their own but reorder or
// hide what is around them.
bool is_harmful(char32_t c);

// Not the first byte of a code point.
constexpr bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0u) == 0x80;
}

}  // namespace btcheck
