// SPDX-License-Identifier: MIT
//
// Real-time patterns on toy systems, by writing all ages out.
#pragma once

#include "ltl/timed/timed_pattern.hpp"
#include "reference/toy_system.hpp"

namespace btcheck::reference {

// True in the states of with_occurrence where a run that stays in such states
// for ever violates the pattern.
inline constexpr std::uint32_t kDue = 63;

// The runs of the system, each with one occurrence of the pattern picked, or
// none so far; runs go on only as long as that occurrence may be violated. A
// run of the system violates the pattern iff it is here with `<> [] due`.
ToySystem with_occurrence(const ToySystem& system, const TimedPattern& pattern);

}  // namespace btcheck::reference
