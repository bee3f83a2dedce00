// SPDX-License-Identifier: MIT
//
// Each predicate becomes word tests and, where it must, a small program.
#include "explore/labels.hpp"

namespace btcheck {

LabelledNetwork::LabelledNetwork(const CompiledNetwork& system,
                                 const std::vector<StatePredicate>& predicates)
    : system_(system), conditions_(system.network(), system.layout()) {
  for (const StatePredicate& predicate : predicates) {
    Compiled compiled;
    compiled.condition = conditions_.compile(predicate.expression);
    compiled.when_dead = predicate.when_dead
                             ? conditions_.compile(*predicate.when_dead)
                             : compiled.condition;
    depends_on_dead_ |= predicate.when_dead.has_value();
    compiled_.push_back(compiled);
  }
}

}  // namespace btcheck
