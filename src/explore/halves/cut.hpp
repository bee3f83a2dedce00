// SPDX-License-Identifier: MIT
//
// Where to cut the state vector in two.
#pragma once

#include <cstddef>

#include "explore/state/step.hpp"

namespace btcheck {

// How many groups of variables to give to the low half (StateLayout), such
// that as few different halves occur as possible. Found out on a sample of
// reachable states, by up to two threads; the same for equal networks and any
// number of threads.
std::size_t best_cut(const CompiledNetwork& system, unsigned threads = 1);

}  // namespace btcheck
