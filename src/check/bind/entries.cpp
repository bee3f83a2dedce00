// SPDX-License-Identifier: MIT
//
// Comparisons of blackboard entries. A state of an entry may stand for many
// values, so an atom may be neither true nor false in it. A number differs from
// every text; what is unknown or not there differs from everything.
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

const EntryValue& value_in(const StateVariable& entry, int state) {
  return entry.values[static_cast<std::size_t>(state)];
}

// The states of an entry where something holds, and where it is not known.
struct Truths {
  std::vector<int> holds;
  std::vector<int> open;

  auto operator<=>(const Truths&) const = default;
};

template <class Truth>
Truths truths(const StateVariable& entry, Truth truth) {
  Truths found;
  for (std::size_t i = 0; i < entry.states.size(); ++i) {
    const int state = static_cast<int>(i);
    const std::optional<bool> is_so = truth(state);
    if (!is_so) found.open.push_back(state);
    if (is_so && *is_so) found.holds.push_back(state);
  }
  return found;
}

// `mode == idle`: a name means its state, and its value where it is only one.
std::optional<bool> compared_with_state(const StateVariable& entry, int state,
                                        Relation relation, int name) {
  const bool is_alike = entry.value_name(state) == entry.value_name(name);
  if (is_one_value(value_in(entry, name)) && !is_alike) {
    return compared(value_in(entry, state), relation, value_in(entry, name));
  }
  if (relation == Relation::NotEqual) return !is_alike;
  const bool is_strict =
      relation == Relation::Less || relation == Relation::Greater;
  return is_alike && !is_strict;
}

// The states of the left one, by what they mean for the right one.
std::map<Truths, std::vector<int>> alike_beside(Relation relation,
                                                const StateVariable& left,
                                                const StateVariable& right) {
  std::map<Truths, std::vector<int>> alike;
  for (std::size_t i = 0; i < left.values.size(); ++i) {
    const EntryValue& value = left.values[i];
    alike[truths(right, [&](int state) {
      return compared(value, relation, value_in(right, state));
    })].push_back(static_cast<int>(i));
  }
  return alike;
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
                         const std::vector<int>& holds,
                         const std::vector<int>& open) {
  const Expression state = read(entry.variable);
  if (!open.empty()) {
    leave_open(
        atom, is_among(state, open), {entry.number},
        fmt::format("whether `{}` is not known where `{}` is {}", atom.text,
                    entry.of->name, entry.of->value_name(open.front())),
        "it");
  }
  return is_among(state, holds);
}

Expression Binder::compared_number(const Atom& atom, const Entry& entry,
                                   Relation relation, double constant) {
  const EntryValue number{NumberRange{constant, constant}, std::nullopt, false};
  const auto [holds, open] = truths(*entry.of, [&](int state) {
    return compared(value_in(*entry.of, state), relation, number);
  });
  if (holds.empty() && open.empty()) {
    warn_never(atom, fmt::format("`{}` has no such number", entry.of->name));
  }
  return known(atom, entry, holds, open);
}

// `true` is 1, as in scripts, unless a state is called so.
Binder::Bound Binder::compared_entry(const Atom& atom, const Entry& entry,
                                     Relation relation, const Side& other,
                                     const Operand& operand) {
  std::optional<Decimal> number = other.constant;
  const bool is_state =
      std::ranges::any_of(entry.of->states, [&](const std::string& state) {
        return equal_ignoring_case(state, other.symbol);
      });
  if (!number && !is_state) {
    if (equal_ignoring_case(other.symbol, "true")) number = Decimal{1, 0};
    if (equal_ignoring_case(other.symbol, "false")) number = Decimal{};
  }
  if (number && entry.has_numbers()) {
    return compared_number(atom, entry, relation, number->nearest());
  }
  if (other.constant) {
    return beside_number(atom, entry.variable, relation, *other.constant,
                         operand.span);
  }
  const auto named = value_of(other, Side{entry.variable, {}, {}}, operand);
  if (!named) return std::nullopt;
  const int name = named->terms().front().operand;
  const auto [holds, open] = truths(*entry.of, [&](int state) {
    return compared_with_state(*entry.of, state, relation, name);
  });
  return known(atom, entry, holds, open);
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
    for (const auto& [found, states] :
         alike_beside(atom.relation, *left.of, *right.of)) {
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

}  // namespace btcheck
