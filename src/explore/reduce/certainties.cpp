// SPDX-License-Identifier: MIT
//
// Guards are conjunctions, and most conjuncts compare a variable with a
// constant; that is all that is looked at.
#include "explore/reduce/certainties.hpp"

#include <algorithm>

namespace btcheck {
namespace {

bool is_variable(const Term& term, VariableId variable) {
  return term.operation == Operation::Variable &&
         term.operand == static_cast<std::int32_t>(index(variable));
}

}  // namespace

std::optional<int> constant_value(const Assignment& assignment) {
  const auto terms = assignment.value.terms();
  if (terms.size() != 1 || terms[0].operation != Operation::Constant) {
    return std::nullopt;
  }
  return terms[0].operand;
}

std::optional<int> demanded_value(const Expression& guard,
                                  VariableId variable) {
  for (const Expression& conjunct : guard.conjuncts()) {
    const auto terms = conjunct.terms();
    if (terms.size() == 3 && is_variable(terms[0], variable) &&
        terms[1].operation == Operation::Constant &&
        terms[2].operation == Operation::Equal) {
      return terms[1].operand;
    }
  }
  return std::nullopt;
}

bool excludes(const Expression& guard, VariableId variable, int value) {
  const Expression refusal = differs(variable, value);
  const auto demanded = demanded_value(guard, variable);
  const auto conjuncts = guard.conjuncts();
  return (demanded && demanded != value) ||
         std::find(conjuncts.begin(), conjuncts.end(), refusal) !=
             conjuncts.end();
}

bool takes_time(const Network& network, const Edge& edge) {
  return network.ticks != TickSemantics::None && edge.when.lower > 0;
}

}  // namespace btcheck
