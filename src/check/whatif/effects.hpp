// SPDX-License-Identifier: MIT
//
// What a graph of runs shows of the mission's ends.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "check/whatif/answer_graph.hpp"
#include "check/whatif/whatif.hpp"

namespace btcheck {

// Pairs of leaves of which one ends what the other begins.
std::vector<OnOff> on_and_off(const BehaviorTree& tree);

// Runs, as numbers of arcs, that show what an Effect says; empty for what is
// not so.
struct Shown {
  using Path = std::vector<std::uint32_t>;
  std::optional<Path> succeeds;
  std::optional<Path> fails;
  std::optional<Path> throws;
  std::optional<Path> hangs;  // with a round of what it then does for ever
  std::optional<Path> left;   // running or on
};

// `known`: what is so without faults is not told of what is left.
Effect effect_of(const AnswerGraph& graph, const std::vector<OnOff>& pairs,
                 const Effect* known, Shown& shown);

// Of the runs that ask a leaf, from then on: how they end.
Effect ends_behind(const AnswerGraph& graph, NodeId leaf);

// All that happens along a run.
std::vector<NodeEvent> events_along(const AnswerGraph& graph,
                                    const Shown::Path& path);

// How the mission gets on after the fault, as the run shows it; `asked` are the
// leaves that healthy runs ask, by node.
std::optional<Recovery> recovery_on(const BehaviorTree& tree, NodeId leaf,
                                    const std::vector<NodeEvent>& run,
                                    const std::vector<bool>& asked);

// By node: whether some run asks it once all faults have struck; without
// faults, at all.
std::vector<bool> asked_behind(const BehaviorTree& tree,
                               const AnswerGraph& graph);

}  // namespace btcheck
