// SPDX-License-Identifier: MIT
//
// A simulation from its beginning on, at random or by a script, without
// questions: how far it goes, and how it has ended.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "check/bind/verdict.hpp"
#include "check/simulate/simulation.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

struct Course {
  int ticks = 100;  // where it stops
  // Asked before each choice.
  std::function<bool()> may_go_on = [] { return true; };
  // Told each step with the state before it.
  std::function<void(const Valuation& before, const RunStep& step)> told =
      [](const Valuation&, const RunStep&) {};
};

// The value is the simulation at its end; with an error beside it, the script
// asks for what the tree cannot do. Tree and network must outlive it.
Result<Simulation> simulated_at_random(const BehaviorTree& tree,
                                       const Network& network,
                                       std::uint64_t seed,
                                       const Course& course);
Result<Simulation> simulated_by_script(const BehaviorTree& tree,
                                       const Network& network,
                                       const SourceText& script,
                                       const Course& course);

// The number of the latest tick of any tree.
int most_ticks(const Simulation& simulation);

// How a run has ended: "the tree ended with success in tick 3". `ticks` is how
// many it was to have.
std::string ending_text(const Simulation& simulation, int ticks);

}  // namespace btcheck
