// SPDX-License-Identifier: MIT
//
// Runs made simpler for people, after the search.
#pragma once

#include <functional>

#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// The run without moves of free state variables and rounds of the tree that do
// not matter for what it shows; a loop stays a loop that makes progress.
// `still_shows` must be true of `run`, and must find its own way on a run:
// numbers of states and the beginning of the loop change. The result has been
// executed from its first step to its last. Tries some two thousand candidates,
// and none for a run of more than 20,000 steps.
Run shortened(const Network& network, Run run,
              const std::function<bool(const Run&)>& still_shows);

}  // namespace btcheck
