// SPDX-License-Identifier: MIT
#include "trace/watch/entry_regions.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "model/tree/value_words.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

constexpr double kEndOfNumbers = std::numeric_limits<double>::infinity();
constexpr std::string_view kMinus = "minus_";
constexpr std::string_view kOfText = "text_";

std::optional<double> real_in(std::string_view text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

// -0.5 for `minus_0_5`.
std::optional<double> number_said(std::string_view word) {
  if (!word.starts_with(kMinus)) return std::nullopt;
  std::string text(word.substr(kMinus.size()));
  if (text.empty() || !is_digit(text.front())) return std::nullopt;
  if (const auto point = text.find('_'); point != std::string::npos) {
    text[point] = '.';
  }
  const auto number = real_in(text);
  return number ? std::optional(-*number) : std::nullopt;
}

// The words and numbers that rules compare names with.
std::set<std::string> words_in(const PropertyFile& rules,
                               std::vector<double>& numbers) {
  std::set<std::string> words;
  for (const Atom& atom : rules.atoms) {
    if (atom.kind == AtomKind::Range) {
      numbers.push_back(atom.low.nearest());
      numbers.push_back(atom.high.nearest());
    }
    visit_leaves(atom, [&](const Operand& side) {
      if (side.is_number) {
        numbers.push_back(side.number.nearest());
      } else if (side.node.empty() && !side.name.empty()) {
        words.insert(side.name);
      }
    });
  }
  return words;
}

}  // namespace

EntryRegions::EntryRegions(const PropertyFile& rules) {
  const std::set<std::string> words = words_in(rules, numbers_);
  for (const std::string& word : words) {
    if (equal_ignoring_case(word, "true")) numbers_.push_back(1);
    if (equal_ignoring_case(word, "false")) numbers_.push_back(0);
    if (const auto number = number_said(word)) numbers_.push_back(*number);
  }
  std::ranges::sort(numbers_);
  numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
  add("unset", {});
  add("no_value", {});
  add("of_another_type", {});
  double least = -kEndOfNumbers;
  std::string name = "any_number";
  for (const double number : numbers_) {
    const std::string word = number_word(number);
    add(least == -kEndOfNumbers ? "below_" + word : name,
        {NumberRange{least, std::nextafter(number, -kEndOfNumbers)},
         std::nullopt, false});
    add(word, {NumberRange{number, number}, std::nullopt, false});
    least = std::nextafter(number, kEndOfNumbers);
    name = "above_" + word;
  }
  add(name, {NumberRange{least, kEndOfNumbers}, std::nullopt, false});
  for (const std::string& word : words) add_word(word);
  add("another_text", {std::nullopt, std::string(kOtherText), false});
}

void EntryRegions::add(std::string name, EntryValue value) {
  states_.push_back(std::move(name));
  values_.push_back(std::move(value));
}

void EntryRegions::add_word(const std::string& word) {
  const bool is_known = std::ranges::any_of(states_, [&](const auto& state) {
    return equal_ignoring_case(state, word);
  });
  if (is_known || equal_ignoring_case(word, "true") ||
      equal_ignoring_case(word, "false")) {
    return;
  }
  add(word, {std::nullopt, word, false});
}

StateVariable EntryRegions::variable(std::string name) const {
  StateVariable made;
  made.name = std::move(name);
  made.states = states_;
  made.values = values_;
  made.max = static_cast<int>(states_.size()) - 1;
  return made;
}

int EntryRegions::region_of(std::string_view value) const {
  const int last = static_cast<int>(states_.size()) - 1;
  const auto named = [&](std::string_view name) -> std::optional<int> {
    for (int i = 0; i <= last; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (equal_ignoring_case(states_[at], name)) return i;
    }
    return std::nullopt;
  };
  const auto text_named = [&](std::string_view name) -> std::optional<int> {
    const auto found = named(name);
    const bool is_text =
        found && values_[static_cast<std::size_t>(*found)].text.has_value();
    return is_text ? found : std::nullopt;
  };
  if (value.starts_with('\'')) {
    const std::string_view text = value.substr(1, value.size() - 2);
    const std::string word = text.empty() ? "empty" : as_word(text);
    if (const auto found = text_named(word)) return *found;
    return text_named(std::string(kOfText) + word).value_or(last);
  }
  const auto number = real_in(value);
  constexpr int kOfAnotherType = 2;
  if (!number) return named(value).value_or(kOfAnotherType);
  if (std::isnan(*number)) return kOfAnotherType;
  const auto place = std::ranges::lower_bound(numbers_, *number);
  const auto before = static_cast<int>(place - numbers_.begin());
  constexpr int kFirst = 3;  // of the states that are numbers
  const bool is_that = place != numbers_.end() && *place == *number;
  return kFirst + 2 * before + (is_that ? 1 : 0);
}

std::vector<std::string> entry_names(const std::vector<std::string>& entries) {
  const auto own = [](const std::string& entry) {
    const std::string name = as_word(entry.substr(entry.rfind('/') + 1));
    return name.empty() ? std::string("_") : name;
  };
  std::map<std::string, int> uses;
  for (const std::string& entry : entries) ++uses[own(entry)];
  std::vector<std::string> names(entries.size());
  std::set<std::string> taken;
  // Those of the tree itself first.
  for (const bool is_inner : {false, true}) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const bool has_path = entries[i].find('/') != std::string::npos;
      if (has_path != is_inner) continue;
      const std::string name = own(entries[i]);
      names[i] = unused_name(
          taken, is_inner && uses[name] > 1 ? as_word(entries[i]) : name);
    }
  }
  return names;
}

}  // namespace btcheck
