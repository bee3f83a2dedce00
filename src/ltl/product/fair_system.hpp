// SPDX-License-Identifier: MIT
//
// What the searches for cycles need: a system whose steps are in sets.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>

#include "explore/state/limits.hpp"
#include "explore/state/transition_system.hpp"
#include "ltl/buchi/buchi.hpp"

namespace btcheck {

// A transition system each of whose steps belongs to some acceptance sets. Its
// fair runs are the infinite ones that pass through every set infinitely
// often. As in a TransitionSystem, the views handed out die with the call; a
// state without successors is allowed.
template <class System>
concept FairSystem = requires(const System& system, StateView state,
                              void (*found)(StateView),
                              void (*stepped)(StateView, Step, AcceptanceSet)) {
  { system.word_count() } -> std::convertible_to<std::size_t>;
  { system.all_sets() } -> std::convertible_to<AcceptanceSet>;
  system.initial_states(found);
  system.successors(state, stepped);
};

enum class SearchOutcome : unsigned char { Empty, Found, GaveUp };

// How a search for a run ended, with the run when it found one.
struct RunSearch {
  SearchOutcome outcome = SearchOutcome::Empty;
  StopReason stopped = StopReason::None;  // why it gave up
  SearchProgress progress;
  std::optional<Lasso> lasso;
};

}  // namespace btcheck
