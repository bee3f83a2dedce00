// SPDX-License-Identifier: MIT
//
// Real-time patterns decided on one run, by their definition.
#pragma once

#include <cstddef>
#include <vector>

#include "ltl/timed/timed_pattern.hpp"

namespace btcheck::reference {

// An infinite run as far as patterns see it: the step from the last state
// leads back to state `loop`.
struct TimedRun {
  std::vector<PropositionSet> labels;
  std::vector<int> elapsed;  // by state: units of time of the step from it
  std::size_t loop = 0;
};

// Whether the run satisfies the pattern. A pattern with a closing must have a
// trigger and no opening.
bool satisfies(const TimedPattern& pattern, const TimedRun& run);

// Whether the run violates the pattern from its state `at` on, which must be
// an occurrence.
bool is_violated_at(const TimedPattern& pattern, const TimedRun& run,
                    std::size_t at);

// Whether a beginning (its loop means nothing) violates the pattern from its
// state `at` on whatever follows.
bool is_lost_at(const TimedPattern& pattern, const TimedRun& begin,
                std::size_t at);

}  // namespace btcheck::reference
