// SPDX-License-Identifier: MIT
//
// Why a run goes as it does, in one sentence.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// The rule that a run breaks, to hold other runs against it. Where something is
// assumed of runs, only what happens within so many ticks can be compared: that
// does not depend on how a run goes on.
struct BrokenRule {
  const BoundProperty* rule = nullptr;  // or nothing is compared
  bool is_assumed = false;
};

// One or two sentences for a reader who knows behavior trees and no temporal
// logic: "Sequence17 goes on with goto_waypoint@27, which was running, and
// does not tick measure_battery again." Each names what happens on this very
// run; "" when there is nothing of which that is certain. `subjects` is what
// the property speaks of; `trigger_state` is the state from which an answer is
// waited for, where the property has such a thing. `broken` is the property
// itself (nearest.hpp).
std::string why(const BehaviorTree& tree, const Network& network,
                const Run& run, const Subjects& subjects,
                std::optional<std::size_t> trigger_state,
                const BrokenRule& broken = {});

// The actions that the loop of the run ticks and that never succeed, fail or
// are halted in it, in pre-order; those with a :duration are left out. Empty
// when the run has no loop.
std::vector<NodeId> running_for_ever(const BehaviorTree& tree,
                                     const Network& network, const Run& run);

}  // namespace btcheck
