// SPDX-License-Identifier: MIT
//
// A path that shows why a formula of CTL holds in a state, or fails.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "explore/search/stored_graph.hpp"
#include "ltl/branching/ctl.hpp"

namespace btcheck {

// States first to last, by position, of a path of which `claim` is said and
// that one path cannot show: that something holds on all runs from a state
// (`AG EF p` fails where EF p does), or one claim too many.
struct Unshown {
  Claim claim;
  std::size_t first = 0;
  std::size_t last = 0;
};

// A path in a stored graph, by state numbers. A finite one may be gone on with
// by any fair run; the others end with a cycle that is itself fair, if between
// two states a step of progress is taken where there is one.
struct GraphPath {
  static constexpr std::size_t kFinite = static_cast<std::size_t>(-1);

  std::vector<StateId> states;  // not empty
  // Where the last state leads back to, kFinite: nowhere.
  std::size_t loop = kFinite;
  // What the path leaves to be believed; empty: it is a proof.
  std::vector<Unshown> unshown;

  bool is_complete() const { return unshown.empty(); }
};

// A path from `state` that shows that the claim is true there: a witness, or a
// counterexample. Nothing where that is not so, and nothing where no path could
// show any of it: EF p failing, AG p holding. Prefixes are shortest for the
// operator they belong to; cycles are short, not shortest.
std::optional<GraphPath> demonstrate(CtlChecker& checker, Claim claim,
                                     StateId state);

}  // namespace btcheck
