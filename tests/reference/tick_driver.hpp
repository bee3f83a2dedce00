// SPDX-License-Identifier: MIT
//
// A network ticked from left to right, as a TickInterpreter ticks its tree.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "model/automata/network.hpp"
#include "reference/naive_network.hpp"
#include "reference/tick_interpreter.hpp"

namespace btcheck::reference {

// What was chosen during one tick, by node and in the order of the questions.
struct Decisions {
  template <class Choice>
  struct Decision {
    std::vector<Choice> allowed;
    Choice chosen;
  };
  std::map<NodeId, std::deque<Decision<NodeStatus>>> answers;
  std::map<NodeId, std::deque<Decision<int>>> values;
  std::map<NodeId, std::deque<bool>> due;
  std::vector<int> moved;  // all variables, after the free ones have moved
};

// The network cannot do what was decided, or can do something else as well.
struct Disagreement : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Drives a network with tick semantics `root`. Timers go first. Then the
// enabled automaton with the least number acts, which in post-order finishes
// the subtree of the leftmost child that was called. Whoever is neither a leaf
// nor a timer must have exactly one edge to take. Tree and network must
// outlive the driver.
class TickDriver {
 public:
  TickDriver(const BehaviorTree& tree, const Network& network)
      : tree_(tree), naive_(network), state_(naive_.initial()) {}

  // One tick with these decisions. The locals have the network's names; a
  // timer that counts has its clock for `elapsed`.
  TickResult tick(Decisions decisions);

 private:
  const Network& network() const { return naive_.network(); }
  const Automaton& root() const;
  std::string_view location(const Automaton& automaton) const;
  void fire(std::uint32_t edge);
  bool fire_timer(Decisions& decisions);
  void move_free_variables(const Decisions& decisions);
  bool move_one_step(const Automaton& automaton, int target);
  bool step_nodes(Decisions& decisions);
  std::uint32_t decided(const std::vector<std::uint32_t>& enabled,
                        Decisions& decisions) const;
  std::uint32_t answered(NodeId leaf, const std::vector<std::uint32_t>& enabled,
                         Decisions& decisions) const;
  std::uint32_t written(NodeId set_sv,
                        const std::vector<std::uint32_t>& enabled,
                        Decisions& decisions) const;
  TickResult result() const;

  const BehaviorTree& tree_;
  NaiveNetwork naive_;
  NaiveState state_;
  std::vector<TickEvent> events_;
  std::set<NodeId> asked_;  // timers, since time has passed
};

// What a comparison has seen besides differences.
struct TickCensus {
  int ticks = 0;
  int events = 0;
  int halts = 0;
  int faults = 0;
};

// Ticks a tree and its network side by side with the same random decisions,
// until the given number of ticks or a fault: the first difference, in words.
std::optional<std::string> first_difference(const BehaviorTree& tree,
                                            const Network& network,
                                            std::uint64_t seed, int ticks,
                                            TickCensus& census);

}  // namespace btcheck::reference
