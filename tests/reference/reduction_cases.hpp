// SPDX-License-Identifier: MIT
//
// The networks on which reductions are compared, all their states written out.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "explore/state/transition_system.hpp"
#include "reference/naive_network.hpp"

namespace btcheck::reference {

struct ReductionCase {
  std::string text;  // of the tree
  TickSemantics ticks = TickSemantics::Root;
  std::uint64_t seed = 0;
  Network network;
  NaiveSpace space;
};

inline constexpr std::size_t kMostStatesOfCase = 3000;

// Nothing when the text cannot be read or there are too many states.
std::optional<ReductionCase> reduction_case(const std::string& text,
                                            TickSemantics ticks,
                                            std::uint64_t seed);

// Calls check(case) for so many random trees under every tick semantics, until
// it answers No. Every fifth is a pair of trees in parallel over the same
// variables, every fifth asks the weather before and after all it does, and
// every fifth is an XML tree.
void for_reduction_cases(
    unsigned own_seed, int trees,
    const std::function<GoOn(const ReductionCase&)>& check);

// How many networks there were, and how many had what.
struct ReductionCensus {
  int networks = 0;
  int xml_trees = 0;
  int several_trees = 0;
  int untimed = 0;
  int free_variables = 0;
  int contracts = 0;
  int fixed_timers = 0;
  int ranged_timers = 0;
  int faults = 0;
  std::uint64_t states = 0;

  void count(const ReductionCase& each);
};

}  // namespace btcheck::reference
