// SPDX-License-Identifier: MIT
//
// `btcheck simulate`: one run of a tree, at random, as a script has it, or by
// hand.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "check/simulate/simulation.hpp"
#include "cli/options/options.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// A tree to simulate, and the text of its file.
struct SimulatedTree {
  const BehaviorTree& tree;
  const Network& network;
  const std::string& source;
};

// How far a run goes when nobody says.
inline constexpr int kSimulatedTicks = 100;

// A run without questions: by its seed, or else by a file.
struct SimulationPlan {
  std::optional<std::uint64_t> seed;
  std::string script;  // the file's name
  int ticks = kSimulatedTicks;
};

// Runs at most so many ticks and writes a line for each when it is over
// (trace/formats/text.hpp). The value is the simulation at the end of its
// run; with an error beside it, the script asks for what the tree cannot do.
Result<Simulation> simulate(const SimulatedTree& simulated,
                            const SimulationPlan& plan, std::ostream& out);

// What a command line asks for, from standard input to standard output: such a
// run, which -o keeps, or stepping by hand (cli/stepping.hpp).
struct Simulated {
  std::vector<Diagnostic> findings;
  bool is_interrupted = false;  // the run is the one up to then
};
Simulated simulate_as_told(const SimulatedTree& simulated,
                           const Options& options);

// The number of the latest tick of any tree.
int most_ticks(const Simulation& simulation);

// How a run has ended: "the tree ended with success in tick 3". `ticks` is
// how many were asked for.
std::string ending_text(const Simulation& simulation, int ticks);

// The run as ITF JSON; `how` it was made: "seed 7", "by hand".
std::string simulated_itf(const SimulatedTree& simulated, const Run& run,
                          const std::string& how);

}  // namespace btcheck
