// SPDX-License-Identifier: MIT
//
// Random questions about single states of a network, and what they see.
//
// Most compare one variable with one of its values, as events do; some order a
// variable or compare two, which makes every value matter; some combine two of
// these.
#include "reference/random_questions.hpp"

#include <algorithm>

namespace btcheck::reference {
namespace {

class QuestionMaker {
 public:
  QuestionMaker(const Network& network, SplitMix64& random)
      : network_(network), random_(random) {}

  VariableId variable() {
    for (;;) {
      const VariableId any{static_cast<std::uint32_t>(
          random_.below(static_cast<int>(network_.variables.size())))};
      if (network_.variable(any).domain_size() > 1) return any;
    }
  }

  StatePredicate predicate() {
    StatePredicate made{condition(), std::nullopt};
    if (random_.percent(25)) made.when_dead = condition();
    return made;
  }

 private:
  Expression value_of(VariableId id) {
    const Variable& variable = network_.variable(id);
    return Expression::constant(
        variable.min + random_.below(static_cast<int>(variable.domain_size())));
  }

  Expression comparison() {
    const VariableId id = variable();
    switch (random_.below(6)) {
      case 0:
        return Expression::binary(Operation::NotEqual, read(id), value_of(id));
      case 1:
        return Expression::binary(Operation::Less, read(id), value_of(id));
      case 2:
        return Expression::binary(Operation::Equal, read(id), read(variable()));
      default:
        return Expression::binary(Operation::Equal, read(id), value_of(id));
    }
  }

  Expression condition() {
    Expression first = comparison();
    if (random_.percent(60)) return first;
    const Operation operation =
        random_.percent(50) ? Operation::And : Operation::Or;
    return Expression::binary(operation, std::move(first), comparison());
  }

  const Network& network_;
  SplitMix64& random_;
};

}  // namespace

bool Questions::see_death() const {
  return std::any_of(predicates.begin(), predicates.end(),
                     [](const StatePredicate& predicate) {
                       return predicate.when_dead.has_value();
                     });
}

Observed Questions::observed(const Network& network) const {
  Observed observed(network);
  for (const StatePredicate& each : predicates) observed.add(each);
  for (const VariableId each : whole) observed.add(each);
  return observed;
}

Questions random_questions(const Network& network, SplitMix64& random) {
  QuestionMaker maker(network, random);
  Questions questions;
  for (int n = 1 + random.below(3); n > 0; --n) {
    if (random.percent(25)) {
      questions.whole.push_back(maker.variable());
    } else {
      questions.predicates.push_back(maker.predicate());
    }
  }
  return questions;
}

Answers answers(const Questions& questions, const NaiveState& state,
                bool is_dead) {
  Answers all;
  for (const StatePredicate& each : questions.predicates) {
    const bool counts_dead = is_dead && each.when_dead;
    all.push_back(
        naive_value(counts_dead ? *each.when_dead : each.expression, state));
  }
  for (const VariableId each : questions.whole) {
    all.push_back(state.value(each));
  }
  return all;
}

}  // namespace btcheck::reference
