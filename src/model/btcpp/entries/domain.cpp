// SPDX-License-Identifier: MIT
//
// An entry keeps its name if it is the only one of that name, or the root's;
// otherwise the path of its subtree goes before it: `a_Move_4_goal`. States are
// named after their values: `idle`, `3`, `minus_1`, `0_5`, `from_4` for 4 and
// more. Characters that no name in a property can have become `_`. A text that
// would have the name of a number becomes `text_3`, any other second `idle_2`.
#include "model/btcpp/entries/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "model/tree/value_words.hpp"
#include "text/diagnostic.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck::btcpp {
namespace {

constexpr double kMostKept = 0x1p31;
constexpr double kNoEnd = std::numeric_limits<double>::infinity();

// What a state is called, and what a property can say of it.
struct ToldValue {
  std::string word;
  EntryValue value = {};
};

ToldValue told(const ScriptValue& value) {
  const double number = value.number;
  const auto from = [](double low, double high) {
    return EntryValue{NumberRange{low, high}, std::nullopt, false};
  };
  switch (value.kind) {
    case ScriptKind::Unknown:
      return {"unknown"};
    case ScriptKind::Unset:
      return {"unset"};
    case ScriptKind::Empty:
      return {"no_value"};
    case ScriptKind::Any:
      return {value.is_lost() ? "lost" : "any",
              {NumberRange{-kNoEnd, kNoEnd}, std::nullopt, true}};
    case ScriptKind::AnyText:
      return {"any_text", {std::nullopt, std::nullopt, true}};
    case ScriptKind::AtMost:
      return {"to_" + number_word(number), from(-kNoEnd, number)};
    case ScriptKind::Number:
      return {value.is_minus_zero ? "minus_0" : number_word(number),
              from(number, number)};
    case ScriptKind::AtLeast:
      return {
          value.is_any_number() ? "any_number" : "from_" + number_word(number),
          from(number, kNoEnd)};
    case ScriptKind::NotANumber:
      return {"nan"};
    case ScriptKind::Text:
      return {value.text.empty() ? "empty" : as_word(value.text),
              {std::nullopt, value.text, false}};
  }
  return {};
}

// A double that is whole, where the domain has the same integer: `1_0`.
bool is_second(const ScriptDomain& domain, const ScriptValue& value) {
  ScriptValue integer = value;
  integer.type = NumberType::Integer;
  integer.is_minus_zero = false;
  return value.is_number() && value.type != NumberType::Integer &&
         domain.index_of(integer) != 0;
}

// Whatever type the engine keeps it in, or has noted of the entry.
bool are_alike(const ScriptValue& one, const ScriptValue& other) {
  return one.kind == other.kind && one.number == other.number &&
         one.text == other.text && one.is_lost() == other.is_lost();
}

std::vector<int> alike_in(const std::vector<ScriptValue>& values) {
  std::vector<int> alike;
  bool are_all_different = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto first = std::ranges::find_if(
        values, [&](const auto& value) { return are_alike(value, values[i]); });
    alike.push_back(static_cast<int>(first - values.begin()));
    are_all_different &= alike.back() == static_cast<int>(i);
  }
  if (are_all_different) alike.clear();
  return alike;
}

// Whether a rule may mean the entry by this name.
bool may_be_called(const EntryName& entry, std::string_view name) {
  const std::string word = as_word(entry.name);
  if (name.size() < word.size()) return false;
  const std::size_t before = name.size() - word.size();
  return equal_ignoring_case(name.substr(before), word) &&
         (before == 0 || name[before - 1] == '_');
}

StateVariable variable_of(const ScriptDomain& domain) {
  StateVariable variable;
  std::set<std::string> taken;
  for (const ScriptValue& value : domain.values) {
    auto [word, entry_value] = told(value);
    if (is_second(domain, value)) word += "_0";
    const bool is_beside_number = value.kind == ScriptKind::Text &&
                                  taken.contains(word) && number_in(value.text);
    if (is_beside_number) word.insert(0, "text_");
    variable.states.push_back(unused_name(taken, word));
    variable.values.push_back(std::move(entry_value));
  }
  variable.alike = alike_in(domain.values);
  variable.max = static_cast<int>(variable.states.size()) - 1;
  variable.moves = Moves::Sampled;
  return variable;
}

}  // namespace

void ScriptDomain::widen(double number) {
  lowest = std::min(lowest, std::floor(number));
  highest = std::max(highest, std::ceil(number));
}

ScriptValue ScriptDomain::kept(const ScriptValue& value) const {
  if (!value.is_number() || value.is_any_number() ||
      value.kind == ScriptKind::NotANumber) {
    return value;
  }
  if (limits) {  // `a - 1` of a range would be a new one for ever
    return value.kind == ScriptKind::Number
               ? value
               : ScriptValue::any_number(value.type).as(value.noted);
  }
  const double above = highest + 1;
  const double below = lowest - 1;
  const bool has_above = above <= kMostKept && value.kind != ScriptKind::AtMost;
  const bool has_below =
      below >= -kMostKept && value.kind != ScriptKind::AtLeast;
  ScriptValue range = value;
  if (value.kind == ScriptKind::Number && value.type == NumberType::Real) {
    range.type = value.is_whole() ? NumberType::Whole : NumberType::Real;
  }
  if (value.number >= above && has_above) {
    range.kind = ScriptKind::AtLeast;
    range.number = above;
    return range;
  }
  if (value.number <= below && has_below) {
    range.kind = ScriptKind::AtMost;
    range.number = below;
    return range;
  }
  if (value.kind == ScriptKind::Number) return value;
  // Whether it may be negative decides whether it is a truth value.
  const bool is_from_0 = value.kind == ScriptKind::AtLeast && value.number >= 0;
  return (is_from_0 ? ScriptValue::range(ScriptKind::AtLeast, 0, value.type)
                    : ScriptValue::any_number(value.type))
      .as(value.noted);
}

std::size_t ScriptDomain::index_of(const ScriptValue& value) const {
  const auto found = std::ranges::find(values, value);
  if (found == values.end()) return 0;
  return static_cast<std::size_t>(found - values.begin());
}

void EntryGroups::join(const EntryName& one, const EntryName& other) {
  above_[first_of(one)] = first_of(other);
}

EntryName EntryGroups::first_of(EntryName entry) {
  while (true) {
    EntryName& up = above_.emplace(entry, entry).first->second;
    if (up == entry) return entry;
    up = above_.at(up);
    entry = up;
  }
}

std::map<EntryName, std::size_t> EntryGroups::numbers() {
  std::map<EntryName, std::size_t> of_first;
  std::map<EntryName, std::size_t> of_all;
  for (const auto& [entry, up] : above_) {
    of_all[entry] =
        of_first.emplace(first_of(entry), of_first.size()).first->second;
  }
  return of_all;
}

std::optional<std::set<double>> asked_of(const ScriptDetail& detail,
                                         const EntryName& entry) {
  std::optional<std::set<double>> all;
  for (const auto& [name, numbers] : detail.asked) {
    if (!may_be_called(entry, name)) continue;
    if (!all) all.emplace();
    all->insert(numbers.begin(), numbers.end());
  }
  return all;
}

std::string compared_with(const ScriptDetail& detail, const EntryName& entry) {
  for (const auto& [name, others] : detail.beside) {
    if (!may_be_called(entry, name)) continue;
    for (const std::string& other : others) {
      if (other != "unknown" && other != "unset") return other;
    }
  }
  return {};
}

std::size_t most_values(const ScriptDetail& detail, const EntryName& entry) {
  const std::size_t most = detail.most_values(entry);
  constexpr std::size_t kMostAsked = ScriptDetail::kMostValues << 3;
  return asked_of(detail, entry) ? std::max(most, kMostAsked) : most;
}

std::vector<std::string> names_of_entries(
    const BtcppExpansion& expansion, const std::vector<EntryName>& entries,
    const std::map<EntryName, std::string>& known) {
  std::vector<std::string> names;
  std::map<std::string, int> uses;
  std::set<std::string> taken;
  for (const auto& [entry, name] : known) taken.insert(name);
  for (const EntryName& entry : entries) ++uses[as_word(entry.name)];
  for (const EntryName& entry : entries) {
    if (const auto named = known.find(entry); named != known.end()) {
      names.push_back(named->second);
      continue;
    }
    std::string name = as_word(entry.name);
    if (name.empty()) name = "_";
    if (uses[as_word(entry.name)] > 1 && entry.subtree != 0) {
      name = as_word(expansion.subtrees[entry.subtree].path) + "_" + name;
    }
    names.push_back(unused_name(taken, name));
  }
  return names;
}

std::vector<StateVariable> entry_variables(
    const BtcppExpansion& expansion, const std::vector<EntryName>& entries,
    const std::vector<ScriptDomain>& domains,
    const std::map<EntryName, ScriptValue>& literals) {
  std::vector<StateVariable> variables;
  const std::vector<std::string> names = names_of_entries(expansion, entries);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    StateVariable variable = variable_of(domains[i]);
    variable.name = names[i];
    const auto literal = literals.find(entries[i]);
    if (literal != literals.end()) {
      variable.initial = static_cast<int>(domains[i].index_of(literal->second));
    }
    variables.push_back(std::move(variable));
  }
  return variables;
}

}  // namespace btcheck::btcpp
