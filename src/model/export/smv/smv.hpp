// SPDX-License-Identifier: MIT
//
// The network as a model for NuSMV and nuXmv, in their language SMV.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// What a claim's p0, p1, … stand for.
struct SmvProposition {
  enum class Kind : std::uint8_t {
    State,  // `condition`, in a dead state `when_dead` if it is there
    Moves,  // the step is one of `movers`
    Passes  // the step is one of time
  };
  Kind kind = Kind::State;
  Expression condition;
  std::optional<Expression> when_dead;
  std::vector<AutomatonId> movers;
};

// Something to be checked. Letters, digits and `_` in the name, no digit first;
// the names of a model's claims differ.
struct SmvClaim {
  enum class Kind : std::uint8_t { Invariant, Linear, Branching };
  std::string name;
  Kind kind = Kind::Invariant;
  std::string formula;  // as SMV writes it, over p0, p1, …
  std::vector<SmvProposition> propositions;
  std::vector<std::string> remarks = {};  // for its reader, a line each
};

// One module (NuSMV 2.6 user manual, chapter 2) whose every step is one step
// of the network, told by the input variable `step`: as many states as a
// search of btcheck finds, and every run infinite, an idle step leading back to
// its state. With claims that are no invariants, where variables move by
// themselves, one bit more tells whether the last step was progress, and
// JUSTICE asks for it again and again: our built-in justice. An error
// when a value may leave 32 bits.
Result<std::string> smv_text(const BehaviorTree& tree, const Network& network,
                             const std::vector<SmvClaim>& claims = {});

}  // namespace btcheck
