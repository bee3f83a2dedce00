// SPDX-License-Identifier: MIT
//
// Edges taken apart: what each half of the state vector has to do with them.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "explore/state/condition.hpp"
#include "explore/state/state_layout.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// Where an edge reads and writes.
enum class EdgeReach : std::uint8_t {
  Own,   // the half of its automaton alone
  Both,  // both, each conjunct and each assignment one of them
  Mixed  // some conjunct or assignment looks at both
};

// An edge as its own half sees it, the one that its automaton lies in.
struct SplitEdge {
  EdgeReach reach = EdgeReach::Own;
  Condition guard;               // what must hold in its own half
  std::uint32_t effect = 0;      // what it does to its own half
  std::uint32_t far_guard = 0;   // Both: what must hold in the other half,
  std::uint32_t far_effect = 0;  // and what it does to it
  int lower = 0;
  int upper = 0;
};

// The automaton whose edges these are. Indices as in the network.
struct SplitAutomaton {
  Half half = Half::Low;
  Field location;
  std::optional<Field> gate;
  std::optional<Field> clock;
  bool is_timer = false;
  std::vector<std::vector<SplitEdge>> edges;  // by source
  std::vector<int> greatest_clock;            // by location; 0: none runs

  // Its present location.
  std::size_t present(const Word* state) const {
    return static_cast<std::size_t>(location.get(state) - location.base);
  }
};

// Every edge of a network, taken apart. Conditions on one half that edges
// of the other have are numbered, and effects on halves: those that are the
// same have one number, and there are few. Number 0 is the guard that is true,
// and the effect that changes nothing. Immutable.
class SplitEdges {
 public:
  // Both must outlive it.
  SplitEdges(const Network& network, const StateLayout& layout);

  const std::vector<SplitAutomaton>& automata() const { return automata_; }
  // Of the guards that edges of the other half have on this one, the first is
  // true; the others need a bit each.
  static constexpr std::size_t kMostFarGuards = 64;

  bool holds(const SplitEdge& edge, const Word* state) const {
    return conditions_.holds(edge.guard, state);
  }
  // The far guards on this half that it meets, one bit each.
  Word met(Half half, const Word* state) const {
    const std::vector<FarGuard>& guards = far_guards_[index(half)];
    Word met = 0;
    for (std::size_t g = 0; g < guards.size(); ++g) {
      met |= Word{conditions_.holds(guards[g].condition, state)} << g;
    }
    return met;
  }
  void apply(std::uint32_t effect, Word* state) const;

 private:
  // The value is assigned to the field.
  struct Write {
    Field field;
    Program value;
  };
  using Assignments = std::vector<std::pair<Field, Expression>>;
  struct AssignmentsHash {
    std::size_t operator()(const Assignments& assignments) const;
  };
  struct FarGuard {
    Expression expression;
    Condition condition;
  };
  // The parts of one edge on their way.
  struct Parts;

  void split_automaton(const Automaton& automaton, std::size_t number);
  SplitEdge split_edge(const Automaton& automaton, const Edge& edge, Half own);
  void split_guard(const Edge& edge, Parts& parts) const;
  void split_update(const Assignment& update, Parts& parts) const;
  void add_to(Parts& parts, const Field& field, const Expression& value) const;
  std::uint32_t number_of_effect(Assignments assignments);
  std::uint32_t number_of_guard(const Expression& guard, Half half);

  const Network& network_;
  const StateLayout& layout_;
  std::vector<std::size_t> clocked_;  // the automata with a clock
  ConditionPool conditions_;
  std::vector<SplitAutomaton> automata_;
  std::vector<std::vector<Write>> effects_;
  std::unordered_map<Assignments, std::uint32_t, AssignmentsHash>
      known_effects_;
  std::vector<FarGuard> far_guards_[2];  // by the half they read
};

}  // namespace btcheck
