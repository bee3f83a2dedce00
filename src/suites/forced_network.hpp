// SPDX-License-Identifier: MIT
//
// What somebody can make a tree do who answers for its leaves, and writes what
// they write: the part of the network in which nothing else decides.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "explore/state/step.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// A TransitionSystem. Steps go in the order of `simulate --script`
// (docs/run.md) where several could be taken, and a clock that is measured in
// real time is never up. Tree and system must outlive it.
class ForcedNetwork {
 public:
  ForcedNetwork(const BehaviorTree& tree, const CompiledNetwork& system);

  std::size_t word_count() const { return system_.word_count(); }
  PropositionSet label(StateView) const { return 0; }
  template <class Found>
  void initial_states(Found&& found) const {
    system_.initial_states(found);
  }
  template <class Stepped>
  void successors(StateView state, Stepped&& stepped) const {
    const std::vector<Way> all = ways(state);
    for (const Way& way : all) stepped(view_of(way.after), way.step);
    if (all.empty()) stepped(state, kIdleStep);
  }

  struct Way {
    Step step;
    StateVector after;
  };
  // None where nothing happens any more, or where something else decides.
  std::vector<Way> ways(StateView state) const;
  // The run ends there with an exception, or a fault.
  bool is_fault(StateView state) const;

  // Whether the edge is an answer that a leaf is asked for.
  bool is_leafs_answer(const Automaton& automaton, const Edge& edge) const {
    return decides(automaton, edge) == Decides::Leaf;
  }

  // Whether a step is what a leaf writes into an entry, by a port.
  bool is_write(const Step& step) const {
    const Decides by = decides_[step.edge];
    return by == Decides::Writes || by == Decides::Halting;
  }
  // Whether a step hangs on what an entry holds.
  bool is_about_entry(const Step& step) const;
  // Why nobody can force a step of the network: "real time: `Sleep`".
  std::string reason(const Step& step) const;

  const BehaviorTree& tree() const { return tree_; }
  const CompiledNetwork& system() const { return system_; }
  const Network& network() const { return system_.network(); }

 private:
  // Who decides about an edge of a node.
  enum class Decides : std::uint8_t {
    Tree,       // the tree itself
    Leaf,       // a leaf answers
    Writes,     // a leaf writes by a port, while it is ticked
    Halting,    // the same while it is halted
    Keeps,      // nobody knows whether this leaf keeps its answer
    IsIdle,     // a leaf that has been reset
    Rounds,     // an entry that is not known has the number of rounds
    LeafFault,  // it writes what nobody has declared
    World       // something else
  };
  Decides decides(const Automaton& automaton, const Edge& edge) const;
  std::vector<std::uint32_t> open_edges(StateView state,
                                        AutomatonId automaton) const;
  // The places of the edges of the node that moves next.
  std::vector<std::uint32_t> next_edges(StateView state) const;
  void keep_forced(StateView state, std::vector<std::uint32_t>& places) const;
  Way way(StateView state, std::uint32_t place, bool is_progress) const;

  const BehaviorTree& tree_;
  const CompiledNetwork& system_;
  bool is_real_;                    // clocks are those of the robot
  std::vector<Decides> decides_;    // by number of the edge
  std::vector<AutomatonId> owner_;  // likewise
};

// Whether a step begins a tick of the only tree, and whether it ends one.
bool begins_tick(const BehaviorTree& tree, const Network& network,
                 const Step& step);
bool ends_tick(const BehaviorTree& tree, const Network& network,
               const Step& step);

}  // namespace btcheck
