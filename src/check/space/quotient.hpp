// SPDX-License-Identifier: MIT
//
// The state space as somebody sees it from outside: states that nobody can tell
// apart are one.
#pragma once

#include <string>
#include <vector>

#include "check/space/step_labels.hpp"
#include "explore/minimise/labelled_graph.hpp"
#include "explore/minimise/partition.hpp"
#include "explore/state/limits.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

struct SpaceQuotient {
  Equivalence equivalence = Equivalence::Branching;
  SeenAnswers seen = SeenAnswers::OfAll;
  // A limit that was reached: then there is no graph.
  StopReason stopped = StopReason::None;
  SearchProgress whole;             // of the search behind it
  LabelledGraph graph;              // state 0 has the first state of all runs
  std::vector<std::string> labels;  // by label; that of kSilent is "i"
};

// Every state is explored and every step kept, then the coarsest partition is
// found (explore/minimise/partition.hpp). In memory: about 60 bytes for a step
// and 60 for a state at the peak, beside the states themselves while they are
// searched.
SpaceQuotient quotient_of_space(const Network& network, Equivalence equivalence,
                                SeenAnswers seen, const Limits& limits);

}  // namespace btcheck
