// SPDX-License-Identifier: MIT
//
// A random run of a tree: a few ticks of it, whatever its leaves answer.
#pragma once

#include <cstdint>

#include "check/simulate/simulation.hpp"

namespace btcheck::reference {

inline Run random_run(const BehaviorTree& tree, const Network& network,
                      std::uint64_t seed, int ticks) {
  Simulation simulation(tree, network, Interleaving::Open);
  btcheck::SplitMix64 random(seed);
  while (simulation.end() == RunEnd::None && simulation.choices().size() > 0 &&
         simulation.run().steps.size() < 400 &&
         simulation.ticks(tree.roots[0]) <= ticks) {
    simulation.take(random_choice(simulation.choices(), random));
  }
  return simulation.run();
}

}  // namespace btcheck::reference
