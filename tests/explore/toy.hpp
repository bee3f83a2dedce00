// SPDX-License-Identifier: MIT
//
// Systems without any tree: graphs written down step by step, and networks of
// hand-made automata.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "explore/state/transition_system.hpp"
#include "model/automata/network.hpp"

namespace btcheck::toy {

// A graph as a TransitionSystem: the packed state is the state's number.
class Graph {
 public:
  struct Arc {
    Word target;
    Step step;
  };

  explicit Graph(std::size_t states) : arcs_(states) {}

  // A step of edge 0, unless it is said otherwise.
  void add(std::size_t from, std::size_t to, Step step = {0, 0, true}) {
    arcs_[from].push_back({to, step});
  }
  void add_initial(std::size_t state) { initial_.push_back(state); }

  std::size_t size() const { return arcs_.size(); }
  const std::vector<Arc>& arcs(std::size_t state) const { return arcs_[state]; }

  std::size_t word_count() const { return 1; }
  template <class Found>
  void initial_states(Found&& found) const {
    for (const Word state : initial_) found(StateView(&state, 1));
  }
  template <class Stepped>
  void successors(StateView state, Stepped&& stepped) const {
    for (const Arc& arc : arcs_[state[0]]) {
      stepped(StateView(&arc.target, 1), arc.step);
    }
    if (arcs_[state[0]].empty()) stepped(state, Step{kTimeStep, 1, true});
  }
  PropositionSet label(StateView) const { return 0; }

 private:
  std::vector<std::vector<Arc>> arcs_;
  std::vector<Word> initial_;
};

static_assert(TransitionSystem<Graph>);

// 2 to 12 states, 0 to 3 steps from each, of every kind.
inline Graph random_graph(std::mt19937& random) {
  const std::size_t states = 2 + random() % 11;
  Graph graph(states);
  for (std::size_t from = 0; from < states; ++from) {
    for (std::size_t n = random() % 4; n > 0; --n) {
      const bool takes_time = random() % 3 == 0;
      const std::uint32_t edge = takes_time ? kTimeStep : 0;
      const bool progress = takes_time || random() % 3 != 0;
      graph.add(from, random() % states,
                {edge, static_cast<std::uint8_t>(takes_time), progress});
    }
  }
  graph.add_initial(0);
  return graph;
}

inline Expression variable(VariableId id) {
  return Expression::variable(static_cast<std::int32_t>(index(id)));
}

inline Expression is(VariableId id, int value) {
  return Expression::binary(Operation::Equal, variable(id),
                            Expression::constant(value));
}

inline Assignment assign(VariableId id, int value) {
  return {id, Expression::constant(value)};
}

// A network under construction.
class Draft {
 public:
  VariableId variable(std::string name, int min, int max, int initial = 0,
                      VariableRole role = VariableRole::State) {
    network_.variables.push_back(
        {role, std::move(name), min, max, initial, {}});
    return VariableId{
        static_cast<std::uint32_t>(network_.variables.size() - 1)};
  }

  AutomatonId automaton(AutomatonKind kind, std::string name,
                        std::vector<std::string> locations,
                        std::optional<VariableId> gate = std::nullopt) {
    Automaton made;
    made.kind = kind;
    made.name = std::move(name);
    made.location =
        variable("location", 0, static_cast<int>(locations.size()) - 1, 0,
                 VariableRole::Location);
    for (std::string& each : locations) {
      made.locations.push_back({std::move(each)});
    }
    made.gate = gate;
    if (kind == AutomatonKind::Node) {
      made.node =
          NodeId{static_cast<std::uint32_t>(network_.node_status.size())};
      network_.node_status.push_back(
          variable("rstatus", 0, 4, 0, VariableRole::Status));
    }
    network_.automata.push_back(std::move(made));
    return AutomatonId{
        static_cast<std::uint32_t>(network_.automata.size() - 1)};
  }

  void edge(AutomatonId of, std::uint32_t from, std::uint32_t to,
            Interval when = kAtOnce, Expression guard = {},
            std::vector<Assignment> updates = {}) {
    network_.automata[index(of)].edges.push_back(
        {LocationId{from}, LocationId{to}, std::move(guard), std::move(updates),
         when, ""});
  }

  VariableId location(AutomatonId of) const {
    return network_.automata[index(of)].location;
  }
  void set_ticks(TickSemantics ticks) { network_.ticks = ticks; }
  void set_fault(VariableId fault) { network_.fault = fault; }

  Network finish() {
    network_.number_edges();
    return network_;
  }

 private:
  Network network_;
};

}  // namespace btcheck::toy
