// SPDX-License-Identifier: MIT
//
// What can be asked of one state, or of one step, of a network.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/automata/network.hpp"

namespace btcheck {

// A truth value of states, over the network's variables. In a dead state (no
// step but an idle one leads from it) `when_dead` counts, if it is there.
struct StatePredicate {
  Expression expression;
  std::optional<Expression> when_dead;
};

// What a proposition looks at.
enum class PropositionKind : std::uint8_t {
  State,   // `of` is true in the state
  Enter,   // `of` is false, and true after the step that is taken
  Leave,   // `of` is true, and false after it
  Moves,   // the step is one of `movers`
  Passes,  // the step is one of time
};

// A truth value of states, or of the steps that leave them (state/event LTL:
// Chaki, Clarke, Ouaknine, Sharygina and Sinha, IFM 2004).
struct Proposition {
  StatePredicate of;
  PropositionKind kind = PropositionKind::State;
  std::vector<AutomatonId> movers;
};

}  // namespace btcheck
