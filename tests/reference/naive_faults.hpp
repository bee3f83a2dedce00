// SPDX-License-Identifier: MIT
//
// Faults put into leaves by hand: the functions of the naive engine are called
// tick by tick with every answer that the leaves can give, those with a fault
// and those without, and what comes of it is counted.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "model/tree/leaf_fault.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::reference {

// A fault of one leaf.
struct NaiveFault {
  NodeId leaf{};
  FaultKind kind{};
  int late = 0;
};

// Over all runs on which all faults strike.
struct NaiveEffect {
  bool strikes = false;
  bool succeeds = false;
  bool fails = false;
  bool throws = false;
  bool hangs = false;      // some run comes to where no end is reached any more
  std::set<NodeId> asked;  // leaves, once all faults have struck
  std::size_t states = 0;
};

// Nothing where there are more states than so many, where a tick does not come
// to an end, or where the tree has nodes of which the world decides more than
// yes or no.
std::optional<NaiveEffect> naive_effect(const BehaviorTree& tree,
                                        std::span<const NaiveFault> faults,
                                        std::size_t most_states);

// What all nodes but one answer, in their order, on runs that end within so
// many ticks with SUCCESS; and how the leaf's last answer was.
struct SeenRun {
  std::string answers;
  bool leaf_has_succeeded = false;
  bool has_struck = false;

  auto operator<=>(const SeenRun&) const = default;
};
std::optional<std::set<SeenRun>> naive_successes(
    const BehaviorTree& tree, std::span<const NaiveFault> faults, NodeId leaf,
    int most_ticks, std::size_t most_runs);

}  // namespace btcheck::reference
