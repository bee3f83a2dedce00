// SPDX-License-Identifier: MIT
//
// Values and names as words of rules.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

#include "text/utf8.hpp"

namespace btcheck {

// `go_home` for "go home". Letters beyond ASCII are letters of rules, too.
inline std::string as_word(std::string_view text) {
  std::string word;
  for (const char c : text) {
    const bool is_kept =
        is_letter(c) || is_digit(c) || static_cast<unsigned char>(c) >= 0x80;
    word += is_kept ? c : '_';
  }
  return word;
}

// `minus_0_5` for -0.5.
inline std::string number_word(double number) {
  std::string word = as_word(fmt::format("{}", std::abs(number)));
  return number < 0 ? "minus_" + word : word;
}

}  // namespace btcheck
