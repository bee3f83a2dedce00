// SPDX-License-Identifier: MIT
//
// Which search answers which property, and one search for many.
#pragma once

#include <vector>

#include "check/bind.hpp"
#include "check/verdict.hpp"
#include "diagnostic.hpp"
#include "explore/limits.hpp"
#include "explore/reachability.hpp"
#include "explore/step.hpp"

namespace btcheck {

// A property whose atoms have become predicates of one network.
struct BoundProperty {
  const Property* property = nullptr;
  // How it is checked: `[] P` of a P without temporal operators is checked as
  // `always P`, which is the same and gives a shortest run.
  PropertyForm form = PropertyForm::Ltl;
  StatePredicate predicate;  // P of never, always, possible, P leadsto Q within
  StatePredicate answer;     // Q
  BoundFormula formula;      // Ltl
};

// Binds every property of a file; every error is reported. The tree, the
// network and the file must outlive the result.
Result<std::vector<BoundProperty>> bind_properties(
    const BehaviorTree& tree, const Network& network,
    const PropertyFile& properties, const SourceText& source);

// One verdict for each property, in order. All that ask of single states share
// one breadth-first search; each of the others has a search of its own. Every
// run told has been replayed.
std::vector<PropertyVerdict> verify(
    const CompiledNetwork& system, const std::vector<BoundProperty>& properties,
    SearchOrder order, const Limits& limits);

// True when some run ends in a fault: what would have followed is not judged by
// any verdict. False as well when the limits end the search before one is
// found.
bool can_fault(const CompiledNetwork& system, const Limits& limits);

}  // namespace btcheck
