// SPDX-License-Identifier: MIT
//
// The states that a reduction leaves, written out, and what can be learned
// from a space whether it was reduced or not.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "explore/reduce/live_variables.hpp"
#include "explore/reduce/reduced_network.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_questions.hpp"

namespace btcheck::reference {

// The state that a packed one stands for.
NaiveState unpacked(const CompiledNetwork& system, StateView state);

struct ReducedSpace {
  NaiveSpace space;  // a step's edge is the first of those it stands for
  std::set<std::uint32_t> edges;  // passed, in chains too
  // By state: the packed one, and the step it was first reached by.
  std::vector<StateVector> vectors;
  std::vector<std::size_t> parents;
  std::vector<Step> steps;

  // The path to a state.
  std::vector<RunState> path_to(std::size_t state) const;
  // The paths to the dead states, and for steps that lead back to their own
  // path the run that takes it round for ever; `most` of each.
  std::vector<Lasso> runs(std::size_t most) const;
};

// Nothing when there are more than `most` states.
std::optional<ReducedSpace> reduced_space(const ReducedNetwork& system,
                                          std::size_t most);

// What a partial-order reduction promises to keep.
struct Findings {
  std::set<std::uint32_t> edges;   // ever taken
  std::set<NaiveState> dead;       // without those after a fault
  std::set<Answers> answers_dead;  // those after a fault included
  std::map<Answers, int> time_to;  // fewest units to each that is reached
};
Findings findings(const Network& network, const Questions& questions,
                  const NaiveSpace& space, std::set<std::uint32_t> edges);
std::set<std::uint32_t> edges_of(const NaiveSpace& space);

// In which of these two differ, "" for none.
std::string difference(const Findings& whole, const Findings& reduced);

// Why a run of single steps is none of the network, "" when it is one. The
// states of `system`, a compilation of the same network, are compared.
std::string run_flaw(const CompiledNetwork& system, const Lasso& run);

// Walks both networks side by side from their first states: "" when the same
// edges and steps of time are possible in both everywhere, with the same
// answers, and only what is marked as forgotten differs.
struct Bisimulation {
  std::string flaw;
  std::size_t states = 0;
  std::size_t live_states = 0;
};
Bisimulation walk_both(const Network& network, const LiveNetwork& live,
                       const Questions& questions, std::size_t most);

}  // namespace btcheck::reference
