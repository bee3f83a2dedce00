// SPDX-License-Identifier: MIT
//
// The checker spells formulas and the exporters name propositions; between
// them a formula is a text with numbered places.
#include "model/export/formula_pattern.hpp"

#include <algorithm>

namespace btcheck {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_of_name(char c) {
  return is_digit(c) || c == '_' || (c >= 'a' && c <= 'z') ||
         (c >= 'A' && c <= 'Z');
}

// The length of the word that begins the text.
std::size_t word_length(std::string_view text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_of_name);
  return static_cast<std::size_t>(end - text.begin());
}

bool is_place(std::string_view word) {
  return word.size() >= 2 && word[0] == 'p' &&
         std::all_of(word.begin() + 1, word.end(), is_digit);
}

}  // namespace

std::string with_propositions(
    std::string_view formula,
    const std::function<std::string(std::size_t)>& text) {
  std::string result;
  while (!formula.empty()) {
    const std::size_t length = std::max<std::size_t>(word_length(formula), 1);
    const std::string_view word = formula.substr(0, length);
    if (is_place(word)) {
      result += text(std::stoul(std::string(word.substr(1))));
    } else {
      result += word;
    }
    formula.remove_prefix(length);
  }
  return result;
}

}  // namespace btcheck
