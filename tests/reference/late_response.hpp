// SPDX-License-Identifier: MIT
//
// P leadsto Q within [from, to] on toy systems, naively.
#pragma once

#include <cstdint>
#include <optional>

#include "ltl/timed/pattern_search.hpp"
#include "reference/toy_system.hpp"

namespace btcheck::reference {

struct LateResponse {
  bool exists = false;  // an occurrence that is not answered in time
  // Of a run in which time passes `to`, if there is one.
  std::optional<std::size_t> fewest_steps;
  std::uint64_t triggers = 0;  // reachable states with the trigger
  int longest_answer = -1;     // the longest time to a first answer
};

LateResponse late_response(const ToySystem& system,
                           const TimedPattern& response);

// True when the run shows that the trigger at its state `trigger` is not
// answered: by its end, or because no time passes in its cycle.
bool misses_response(const ToySystem& system, const TimedPattern& response,
                     const Lasso& lasso, std::size_t trigger);

}  // namespace btcheck::reference
