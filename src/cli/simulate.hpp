// SPDX-License-Identifier: MIT
//
// `btcheck simulate`: one run of a tree, at random, by a script, or by hand.
#pragma once

#include <iosfwd>
#include <string>

#include "check/check.hpp"
#include "check/simulate/course.hpp"
#include "check/simulate/simulation.hpp"
#include "cli/options/options.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// A tree to simulate, and the texts that it was read from.
struct SimulatedTree {
  const BehaviorTree& tree;
  const Network& network;
  const TreeInput& input;
};

// Runs at most so many ticks, by the seed or else by the script, and writes a
// line for each tick when it is over (trace/formats/text.hpp). The value is
// the simulation at the end of its run; with an error beside it, the script
// asks for what the tree cannot do.
Result<Simulation> simulate(const SimulatedTree& simulated,
                            const SimulationPlan& plan, std::ostream& out);

// Whether each line that is read is also written. A terminal shows what is
// typed; a pipe would not.
enum class Echo : unsigned char { No, Yes };

// Stepping by hand: reads a line for each question until `q` or the end of the
// input; `?` lists what may be typed. `s FILE` writes a file.
void step_through(const SimulatedTree& simulated, std::istream& in,
                  std::ostream& out, Echo echo);

// The run as ITF JSON; `how` it was made: "seed 7", "by hand".
std::string simulated_itf(const SimulatedTree& simulated, const Run& run,
                          const std::string& how);

// Writes it to a file. A run that is too long for `trace` to read, or for
// --memory, is not written. Returns what went wrong, or "".
std::string keep_run(const std::string& file, const SimulatedTree& simulated,
                     const Run& run, const std::string& how);

}  // namespace btcheck
