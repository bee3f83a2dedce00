// SPDX-License-Identifier: MIT
#include "report/formats/rules.hpp"

namespace btcheck {

std::span<const Rule> rules() { return verdict_codes(); }

const Rule* rule_of(std::string_view code) {
  const CodeRow* row = code_named(code);
  return row == nullptr || row->name.empty() ? nullptr : row;
}

std::string_view diagnostic_summary(std::string_view code) {
  const CodeRow* row = code_named(code);
  if (row == nullptr) return "something is wrong with an input";
  std::string_view words = row->summary;
  if (words.ends_with('.')) words.remove_suffix(1);
  return words;
}

}  // namespace btcheck
