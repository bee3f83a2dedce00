// SPDX-License-Identifier: MIT
//
// Reading off an expression which values it tells apart: `v = c` and `v != c`
// tell c from the rest, and whatever else is done with v tells all from all.
// That is coarser than need be for `v < 3`, which is rare, and never too fine.
#include "explore/reduce/observed.hpp"

#include "explore/state/accesses.hpp"

namespace btcheck {

void Observed::add(const Expression& expression) {
  for_each_read(expression, [&](VariableId variable, std::optional<int> value) {
    if (!value) return add(variable);
    View& view = views_[index(variable)];
    if (view.kind == Sight::EveryValue) return;
    view.kind = Sight::SomeValues;
    view.values.push_back(*value);
  });
}

void Observed::add(const StatePredicate& predicate) {
  add(predicate.expression);
  if (!predicate.when_dead) return;
  add(*predicate.when_dead);
  sees_death_ = true;
}

void Observed::add(std::span<const Proposition> propositions) {
  for (const Proposition& proposition : propositions) {
    add(proposition.of);
    sees_steps_ |= proposition.kind != PropositionKind::State;
  }
}

}  // namespace btcheck
