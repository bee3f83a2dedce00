// SPDX-License-Identifier: MIT
#include "trace/watch/entry_regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "ltl/rules/compared.hpp"
#include "text/diagnostic.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::array<std::string_view, 3> kNotThere = {"unset", "no_value",
                                                       "unknown"};

// `go home` as rules call it: go_home.
std::string word_of_text(std::string_view text) {
  std::string word;
  for (const char c : text) {
    const bool is_kept =
        is_letter(c) || is_digit(c) || static_cast<unsigned char>(c) >= 0x80;
    word += is_kept ? c : '_';
  }
  return word.empty() ? "empty" : word;
}

std::string word_of_number(double number) {
  std::string word = word_of_text(fmt::format("{}", std::abs(number)));
  return number < 0 ? "minus_" + word : word;
}

// "minus_0_5" → -0.5; nothing for what is no number.
std::optional<double> number_of_word(std::string word) {
  const bool is_below = word.starts_with("minus_");
  if (is_below) word.erase(0, 6);
  if (word.empty() || !is_digit(word[0])) return std::nullopt;
  std::ranges::replace(word, '_', '.');
  const auto number = as_number<double>(word);
  return number && is_below ? std::optional(-*number) : number;
}

struct Compared {
  std::set<double> numbers;
  std::set<std::string> texts;

  void add(const Operand& other) {
    if (other.name.empty() || !other.node.empty()) return;
    const bool is_truth = equal_ignoring_case(other.name, "true") ||
                          equal_ignoring_case(other.name, "false");
    if (is_truth ||
        std::ranges::find(kNotThere, other.name) != kNotThere.end()) {
      return;
    }
    if (const auto number = number_of_word(other.name)) {
      numbers.insert(*number);
    } else {
      texts.insert(other.name);
    }
  }
};

bool is_name(const Operand& operand, std::string_view name) {
  return operand.node.empty() && !operand.is_number &&
         operand.calculation == Arithmetic::None &&
         equal_ignoring_case(operand.name, name);
}

Compared compared_with(const PropertyFile& rules, std::string_view name) {
  Compared compared;
  ComparedNumbers numbers;
  ComparedNames names;
  add_compared(rules, numbers, names);
  compared.numbers = numbers[lowered(name)];
  for (const Atom& atom : rules.atoms) {
    if (atom.kind != AtomKind::Comparison) continue;
    if (is_name(atom.left, name)) compared.add(atom.right);
    if (is_name(atom.right, name)) compared.add(atom.left);
  }
  return compared;
}

void add_state(StateVariable& variable, std::string name, EntryValue value) {
  variable.states.push_back(std::move(name));
  variable.values.push_back(std::move(value));
}

void add_numbers(StateVariable& variable, double least, double greatest,
                 std::string name) {
  if (least > greatest) return;  // no double lies between
  add_state(variable, std::move(name),
            {NumberRange{least, greatest}, std::nullopt, false});
}

}  // namespace

bool names_entry(const PropertyFile& rules, std::string_view name) {
  return std::ranges::any_of(rules.atoms, [&](const Atom& atom) {
    bool is_named = false;
    visit_leaves(atom,
                 [&](const Operand& side) { is_named |= is_name(side, name); });
    return is_named;
  });
}

StateVariable entry_regions(const PropertyFile& rules,
                            const std::string& name) {
  const Compared compared = compared_with(rules, name);
  StateVariable variable;
  variable.name = name;
  for (const std::string_view word : kNotThere) {
    add_state(variable, std::string(word), {});
  }
  double least = -kInfinite;
  for (const double number : compared.numbers) {
    add_numbers(variable, least, std::nextafter(number, -kInfinite),
                "below_" + word_of_number(number));
    add_numbers(variable, number, number, word_of_number(number));
    least = std::nextafter(number, kInfinite);
  }
  add_numbers(variable, least, kInfinite,
              compared.numbers.empty()
                  ? "any_number"
                  : "above_" + word_of_number(*compared.numbers.rbegin()));
  for (const std::string& text : compared.texts) {
    add_state(variable, text, {std::nullopt, text, false});
  }
  add_state(variable, "other_text",
            {std::nullopt, std::string(kOtherText), false});
  add_state(variable, "other", {});
  variable.max = static_cast<int>(variable.states.size()) - 1;
  return variable;
}

int region_of(const StateVariable& entry, std::string_view shown) {
  const auto state_where = [&](const auto& fits) {
    for (std::size_t i = 0; i < entry.states.size(); ++i) {
      if (fits(entry.values[i])) return static_cast<int>(i);
    }
    return entry.max;
  };
  if (shown.size() >= 2 && shown.front() == '\'') {
    const std::string word = word_of_text(shown.substr(1, shown.size() - 2));
    return state_where([&](const EntryValue& value) {
      return value.text && (*value.text == word || *value.text == kOtherText);
    });
  }
  if (const auto number = as_number<double>(shown)) {
    return state_where([&](const EntryValue& value) {
      return value.numbers && *number >= value.numbers->least &&
             *number <= value.numbers->greatest;
    });
  }
  const auto known = std::ranges::find(entry.states, shown);
  return known == entry.states.end()
             ? entry.max
             : static_cast<int>(known - entry.states.begin());
}

}  // namespace btcheck
