// SPDX-License-Identifier: MIT
//
// What distinguishes a run from the nearest one that does right: the choice of
// the world after which it was too late, or that comes in every round.
#pragma once

#include <string>

#include "check/bind/bound_property.hpp"
#include "trace/why/story.hpp"

namespace btcheck {

// "fly -> failure in tick 1 breaks the rule; with fly -> success it need not be
// broken."; "" for rules that are not about one kind of state, and where a few
// thousand states from each choice do not show it. What is assumed is left
// aside: a rule with an assumption that a finite run does not satisfy, or that
// is a formula, is not to be asked about.
std::string nearest_right(const Story& story, const BoundProperty& rule);

}  // namespace btcheck
