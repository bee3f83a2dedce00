// SPDX-License-Identifier: MIT
//
// Comparisons of blackboard entries. A state of an entry may stand for many
// values, so an atom may be neither true nor false in it. Numbers and texts
// differ from each other; what is unknown or not there differs from everything.
// Only numbers are less or greater.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "check/bind/bind.hpp"

namespace btcheck {
namespace {

// Whether one is in this relation to the other, when it does not depend on
// which numbers they are.
std::optional<bool> compared(const NumberRange& left, Relation relation,
                             const NumberRange& right) {
  const auto decided = [](bool all, bool none) {
    return all || none ? std::optional<bool>(all) : std::nullopt;
  };
  const bool are_apart =
      left.greatest < right.least || right.greatest < left.least;
  const bool are_one = left.least == left.greatest &&
                       right.least == right.greatest && !are_apart;
  switch (relation) {
    case Relation::Equal:
      return decided(are_one, are_apart);
    case Relation::NotEqual:
      return decided(are_apart, are_one);
    case Relation::Less:
      return decided(left.greatest < right.least, left.least >= right.greatest);
    case Relation::LessEqual:
      return decided(left.greatest <= right.least, left.least > right.greatest);
    case Relation::Greater:
      return compared(right, Relation::Less, left);
    case Relation::GreaterEqual:
      return compared(right, Relation::LessEqual, left);
  }
  return std::nullopt;
}

std::optional<bool> compared(const EntryValue& left, Relation relation,
                             const EntryValue& right) {
  if (left.numbers && right.numbers) {
    return compared(*left.numbers, relation, *right.numbers);
  }
  const bool is_plain =
      relation == Relation::Equal || relation == Relation::NotEqual;
  if (!is_plain) return false;
  const bool may_both_be_texts =
      (left.text || left.is_any_text) && (right.text || right.is_any_text);
  if (may_both_be_texts && !(left.text && right.text)) return std::nullopt;
  return (may_both_be_texts && left.text == right.text) ==
         (relation == Relation::Equal);
}

bool is_one_value(const EntryValue& value) {
  return value.text || (value.numbers && !value.is_any_text &&
                        value.numbers->least == value.numbers->greatest);
}

Expression either(Expression left, Expression right) {
  if (is_never(left)) return right;
  return Expression::binary(Operation::Or, std::move(left), std::move(right));
}

// The state of an entry is among these, which ascend.
Expression is_among(const Expression& state, const std::vector<int>& states) {
  Expression found = Expression::constant(0);
  for (std::size_t begin = 0; begin < states.size();) {
    std::size_t end = begin + 1;
    while (end < states.size() && states[end] == states[end - 1] + 1) ++end;
    const auto beside = [&](Operation operation, std::size_t i) {
      return Expression::binary(operation, state,
                                Expression::constant(states[i]));
    };
    found =
        either(std::move(found),
               end == begin + 1 ? beside(Operation::Equal, begin)
                                : both(beside(Operation::GreaterEqual, begin),
                                       beside(Operation::LessEqual, end - 1)));
    begin = end;
  }
  return found;
}

}  // namespace

bool Binder::Entry::has_numbers() const {
  return std::ranges::any_of(of->values, [](const EntryValue& value) {
    return value.numbers.has_value();
  });
}

std::optional<Binder::Entry> Binder::entry_of(
    std::optional<VariableId> variable) const {
  const auto& all = network_.state_variable;
  const auto found = std::ranges::find(all, variable);
  if (found == all.end()) return std::nullopt;
  const auto number = static_cast<std::size_t>(found - all.begin());
  const StateVariable& of = tree_.variables[number];
  if (of.values.empty()) return std::nullopt;
  return Entry{static_cast<StateVariableId>(number), *variable, &of};
}

template <class Truth>
Binder::Truths Binder::truths(const Entry& entry, Truth truth) {
  Truths found;
  for (std::size_t i = 0; i < entry.of->states.size(); ++i) {
    const int state = static_cast<int>(i);
    const std::optional<bool> is_so = truth(state);
    if (!is_so) found.open.push_back(state);
    if (is_so && *is_so) found.holds.push_back(state);
  }
  return found;
}

void Binder::leave_open(const Atom& atom, Expression where,
                        std::vector<StateVariableId> entries,
                        std::string message, std::string_view what) {
  open_.push_back(
      {std::move(where), std::move(entries),
       source_.diagnostic(
           Severity::Error, "BT1105", atom.span, std::move(message), "",
           fmt::format("compare {} with the numbers that the scripts compare "
                       "{} with",
                       what, what))});
}

// The states in which the atom is known to be true; where it is not known is
// noted.
Expression Binder::known(const Atom& atom, const Entry& entry,
                         const Truths& found) {
  const Expression state = read(entry.variable);
  if (!found.open.empty()) {
    leave_open(
        atom, is_among(state, found.open), {entry.number},
        fmt::format("whether `{}` is not known where `{}` is {}", atom.text,
                    entry.of->name, entry.of->value_name(found.open.front())),
        "it");
  }
  return is_among(state, found.holds);
}

// `mode == idle`: a name means its state, and its value where it is only one.
std::optional<bool> Binder::compared_with_state(const Entry& entry, int state,
                                                Relation relation, int name) {
  const bool is_alike =
      entry.of->value_name(state) == entry.of->value_name(name);
  if (is_one_value(entry.value(name)) && !is_alike) {
    return compared(entry.value(state), relation, entry.value(name));
  }
  if (relation == Relation::NotEqual) return !is_alike;
  const bool is_strict =
      relation == Relation::Less || relation == Relation::Greater;
  return is_alike && !is_strict;
}

Expression Binder::compared_number(const Atom& atom, const Entry& entry,
                                   Relation relation, double constant) {
  const EntryValue number{NumberRange{constant, constant}, std::nullopt, false};
  const Truths found = truths(entry, [&](int state) {
    return compared(entry.value(state), relation, number);
  });
  if (found.holds.empty() && found.open.empty()) {
    warn_never(atom, fmt::format("`{}` has no such number", entry.of->name));
  }
  return known(atom, entry, found);
}

// `true` is 1, as in scripts, unless a state is called so.
Binder::Bound Binder::compared_entry(const Atom& atom, const Entry& entry,
                                     Relation relation, const Side& other,
                                     const Operand& operand) {
  std::optional<std::int64_t> number = other.constant;
  const bool is_state =
      std::ranges::any_of(entry.of->states, [&](const std::string& state) {
        return equal_ignoring_case(state, other.symbol);
      });
  if (!number && !is_state) {
    if (equal_ignoring_case(other.symbol, "true")) number = 1;
    if (equal_ignoring_case(other.symbol, "false")) number = 0;
  }
  if (number && entry.has_numbers()) {
    return compared_number(atom, entry, relation, static_cast<double>(*number));
  }
  const auto named =
      value_of(atom, other, Side{entry.variable, {}, {}}, operand);
  if (!named) return std::nullopt;
  const int name = named->terms().front().operand;
  return known(atom, entry, truths(entry, [&](int state) {
                 return compared_with_state(entry, state, relation, name);
               }));
}

// By what they hold, whatever their states are called; where that would be too
// large, it is not known at all.
Binder::Bound Binder::compared_entries(const Atom& atom, const Entry& left,
                                       const Entry& right) {
  Expression holds = Expression::constant(0);
  Expression open = Expression::constant(0);
  const auto also = [&](Expression& to, const std::vector<int>& of_left,
                        const std::vector<int>& of_right) {
    if (of_right.empty()) return;
    to = either(std::move(to), both(is_among(read(left.variable), of_left),
                                    is_among(read(right.variable), of_right)));
  };
  constexpr std::size_t kMostPairs = std::size_t{1} << 22;
  bool is_small =
      left.of->values.size() * right.of->values.size() <= kMostPairs;
  if (is_small) {
    for (const auto& [found, states] : alike_beside(atom, left, right)) {
      also(holds, states, found.holds);
      also(open, states, found.open);
      is_small = holds.terms().size() + open.terms().size() <= kMostTerms;
      if (!is_small) break;
    }
  }
  if (!is_small) {
    holds = Expression::constant(0);
    open = Expression::constant(1);
  }
  if (!is_never(open)) {
    leave_open(atom, std::move(open), {left.number, right.number},
               fmt::format("whether `{}` is not always known", atom.text),
               "them");
  }
  return holds;
}

// The states of the left one, by what they mean for the right one.
std::map<Binder::Truths, std::vector<int>> Binder::alike_beside(
    const Atom& atom, const Entry& left, const Entry& right) {
  std::map<Truths, std::vector<int>> alike;
  for (std::size_t i = 0; i < left.of->values.size(); ++i) {
    const int own = static_cast<int>(i);
    alike[truths(right, [&](int state) {
      return compared(left.value(own), atom.relation, right.value(state));
    })].push_back(own);
  }
  return alike;
}

}  // namespace btcheck
