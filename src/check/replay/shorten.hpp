// SPDX-License-Identifier: MIT
//
// Runs made simpler for people, after the search.
#pragma once

#include <functional>

#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// The run without moves of free state variables and without rounds of the tree
// that do not matter for what it shows; a loop stays a loop, and one that makes
// progress. `run` must be a run of the network of which `still_shows` is true;
// so is the result, which has been executed from its first step to its last.
// `still_shows` must find its own way on a run: the numbers of states and the
// beginning of the loop change. Tries at most some two thousand candidates,
// and none for a run of more than 20,000 steps.
Run shortened(const Network& network, Run run,
              const std::function<bool(const Run&)>& still_shows);

}  // namespace btcheck
