// SPDX-License-Identifier: MIT
//
// Searches for states that meet predicates, any number of them at once.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "explore/large/scratch.hpp"
#include "explore/reduce/reduced_network.hpp"
#include "explore/search/reachability.hpp"
#include "explore/state/limits.hpp"
#include "explore/state/proposition.hpp"

namespace btcheck {

// For each predicate a run to the first state found that meets it: breadth
// first, to one of the nearest.
struct StateAnswers {
  ReachabilityResult result;
  std::vector<std::optional<Lasso>> found;
};

struct StateSearch {
  SearchOrder order = SearchOrder::BreadthFirst;
  unsigned threads = 1;
  // Up to so many states one thread searches and keeps who was reached from
  // whom; a breadth-first search that needs more starts over with all threads,
  // and with a third of the memory for each state.
  std::uint64_t sequential_states = 1'000'000;
  Scratch scratch = {};  // where that one goes on when memory is used up
};

// With `known` not empty, only the predicates that have a run there are asked.
// The system must observe all that is read.
StateAnswers search_states(const ReducedNetwork& system,
                           const std::vector<StatePredicate>& predicates,
                           const std::vector<std::optional<Lasso>>& known,
                           StateSearch how, const Limits& limits);

}  // namespace btcheck
