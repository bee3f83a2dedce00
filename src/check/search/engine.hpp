// SPDX-License-Identifier: MIT
//
// Which search answers which property, and one search for many.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/bind/verdict.hpp"
#include "explore/components/component_store.hpp"
#include "explore/large/scratch.hpp"
#include "explore/reduce/observed.hpp"
#include "explore/search/reachability.hpp"
#include "explore/state/limits.hpp"
#include "explore/state/step.hpp"

namespace btcheck {

// Of a network that is at its start.
enum class PartsUse : std::uint8_t {
  Never,
  WhereLarge,  // more than kLargeStates states are left by full reduction
  Always
};
inline constexpr std::uint64_t kLargeStates = 100'000;

struct SearchChoices {
  // Where single states are asked for.
  SearchOrder order = SearchOrder::BreadthFirst;
  // Of all but branching time, where at most dead values are forgotten.
  Reduction reduction = Reduction::Full;
  // Whether rules are asked part by part, with Reduction::Full; Never holds for
  // the default report as well.
  PartsUse parts = PartsUse::WhereLarge;
  unsigned threads = 1;  // for single states; no answer depends on it
  Scratch scratch = {};  // where that search goes on when memory is used up
  // Up to so many states one thread searches and keeps who was reached from
  // whom; a breadth-first search that needs more starts over with all threads,
  // and with a third of the memory for each state.
  std::uint64_t sequential_states = 1'000'000;
  // Whether verdicts have the runs that show them; they take room and time.
  bool keeps_runs = true;
  // Whether more is told of a verdict than what shows it: what it does not
  // need, how often it was asked.
  bool tells_more = true;
  // What is known of parts of this tree and others like it, and is told of
  // more; null: what one search finds serves no other. No answer depends on it.
  std::shared_ptr<ComponentStore> components = {};
};

struct Verification {
  std::vector<PropertyVerdict> verdicts;  // one for each property, in order
  // Some run ends in a fault: what would have followed is not judged by any
  // verdict. False as well when the limits end the search before one is found.
  bool has_faults = false;
};

// All properties that ask of single states share one search, all of branching
// time one graph; each other one has its own. Every run told has been replayed
// on the network as it is given. A run found in a reduced one is looked for
// again in the whole, among its first kShortRunStates states: those tell of
// shortest runs.
inline constexpr std::uint64_t kShortRunStates = 300'000;
Verification verify(const CompiledNetwork& system, const BoundFile& file,
                    SearchChoices choices, const Limits& limits);

// A run that ends in a fault, where the network has any.
std::optional<Run> run_to_fault(const CompiledNetwork& system,
                                SearchChoices choices, const Limits& limits);

}  // namespace btcheck
