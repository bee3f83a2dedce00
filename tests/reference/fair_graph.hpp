// SPDX-License-Identifier: MIT
//
// Fair runs in a graph, by the fixpoint of Emerson and Lei.
#pragma once

#include <cstddef>
#include <vector>

#include "ltl/buchi/buchi.hpp"

namespace btcheck::reference {

// A graph whose steps belong to acceptance sets.
struct FairGraph {
  struct Step {
    std::size_t target;
    AcceptanceSet sets;
  };

  std::vector<std::vector<Step>> steps;  // by state
  AcceptanceSet all_sets = 0;
};

// For each state whether a run begins there that passes through all sets
// infinitely often.
std::vector<bool> states_with_fair_run(const FairGraph& graph);

}  // namespace btcheck::reference
