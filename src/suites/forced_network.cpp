// SPDX-License-Identifier: MIT
#include "suites/forced_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "check/simulate/simulation.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {

ForcedNetwork::ForcedNetwork(const BehaviorTree& tree,
                             const CompiledNetwork& system)
    : tree_(tree), system_(system), is_real_(is_engine(tree.profile)) {
  for (std::uint32_t a = 0; a < network().automata.size(); ++a) {
    const Automaton& automaton = network().automata[a];
    for (const Edge& edge : automaton.edges) {
      decides_.push_back(decides(automaton, edge));
      owner_.push_back(AutomatonId{a});
    }
  }
}

ForcedNetwork::Decides ForcedNetwork::decides(const Automaton& automaton,
                                              const Edge& edge) const {
  if (automaton.kind != AutomatonKind::Node) return Decides::World;
  const Node& node = tree_.node(automaton.node);
  const Location& target = automaton.target(edge);
  const bool is_leaf = is_scripted(node.type);
  if (edge.asks_world) {
    if (is_leaf && target.name.starts_with("measures_")) return Decides::Writes;
    if (is_leaf && target.name.starts_with("halts_")) return Decides::Halting;
    return edge.label == "is idle then" ? Decides::IsIdle : Decides::World;
  }
  if (node.repetitions == kOpenRounds && target.role == LocationRole::Call) {
    return Decides::Rounds;
  }
  if (!is_leaf || edge.label == "halts itself") return Decides::Tree;
  if (keeps_answer(edge)) {
    return node.contract.memory == LeafMemory::Latched ? Decides::Tree
                                                       : Decides::Keeps;
  }
  if (target.role == LocationRole::Error) return Decides::LeafFault;
  return is_answer(target.role) ? Decides::Leaf : Decides::Tree;
}

std::vector<std::uint32_t> ForcedNetwork::open_edges(
    StateView state, AutomatonId automaton) const {
  std::vector<std::uint32_t> places;
  const std::int64_t clock = system_.clock(state, automaton);
  system_.open_edges(state, automaton, [&](std::uint32_t place) {
    const std::uint32_t number = system_.edge_number(place);
    if (network().edge(number).when.lower <= clock) places.push_back(place);
  });
  return places;
}

std::vector<std::uint32_t> ForcedNetwork::next_edges(StateView state) const {
  std::vector<std::uint32_t> next;
  std::optional<AutomatonId> first;
  system_.for_each_open(state, [&](AutomatonId open) {
    if (first && index(*first) < index(open)) return GoOn::Yes;
    if (network().automaton(open).kind != AutomatonKind::Node) return GoOn::Yes;
    auto places = open_edges(state, open);
    if (!places.empty()) {
      first = open;
      next = std::move(places);
    }
    return GoOn::Yes;
  });
  return next;
}

ForcedNetwork::Way ForcedNetwork::way(StateView state, std::uint32_t place,
                                      bool is_progress) const {
  Way made{{system_.edge_number(place), 0, is_progress},
           StateVector(state.begin(), state.end())};
  system_.fire(place, made.after);
  return made;
}

// Of several edges of one node, those that somebody can choose among.
void ForcedNetwork::keep_forced(StateView state,
                                std::vector<std::uint32_t>& places) const {
  if (places.size() == 1) {
    const Decides by = decides_[system_.edge_number(places[0])];
    if (by == Decides::LeafFault || by == Decides::Rounds) places.clear();
    return;
  }
  const auto keep = [&](auto&& is_kept) {
    std::erase_if(places, [&](std::uint32_t place) {
      return !is_kept(decides_[system_.edge_number(place)], place);
    });
  };
  const auto has = [&](Decides by) {
    return std::ranges::any_of(places, [&](std::uint32_t place) {
      return decides_[system_.edge_number(place)] == by;
    });
  };
  for (const Decides by : {Decides::Leaf, Decides::Writes, Decides::IsIdle}) {
    if (!has(by)) continue;
    return keep([by](Decides each, std::uint32_t) { return each == by; });
  }
  if (has(Decides::Halting)) {
    // What is not written then stays as it is.
    return keep([&](Decides, std::uint32_t place) {
      const Edge& edge = network().edge(system_.edge_number(place));
      return std::ranges::all_of(edge.updates, [&](const Assignment& update) {
        const Way made = way(state, place, true);
        return system_.value(view_of(made.after), update.variable) ==
               system_.value(state, update.variable);
      });
    });
  }
  if (has(Decides::World)) return places.clear();
  keep([](Decides by, std::uint32_t) { return by == Decides::Tree; });
  if (places.size() != 1) places.clear();
}

std::vector<ForcedNetwork::Way> ForcedNetwork::ways(StateView state) const {
  std::vector<Way> ways;
  const auto take_first_of_system = [&](auto&& is_wanted) {
    system_.successors(state, [&](StateView target, const Step& step) {
      if (!ways.empty() || !is_wanted(target, step)) return;
      ways.push_back({step, StateVector(target.begin(), target.end())});
    });
  };
  if (system_.is_preempted(state)) {
    if (is_fault(state) || is_real_) return ways;
    take_first_of_system([](StateView, const Step&) { return true; });
    return ways;
  }
  std::vector<std::uint32_t> places = next_edges(state);
  if (places.empty()) {
    take_first_of_system([&](StateView target, const Step& step) {
      return step.edge == kTimeStep &&
             !std::equal(target.begin(), target.end(), state.begin());
    });
    return ways;
  }
  keep_forced(state, places);
  for (const std::uint32_t place : places) {
    ways.push_back(way(state, place, true));
  }
  // What moves by itself does so where the tick begins.
  if (ways.size() != 1 || !begins_tick(tree_, network(), ways[0].step)) {
    return ways;
  }
  for (const auto& mover : network().state_automaton) {
    if (!mover) continue;
    for (const std::uint32_t place : open_edges(state, *mover)) {
      ways.push_back(way(state, place, false));
    }
  }
  return ways;
}

bool ForcedNetwork::is_fault(StateView state) const {
  return network().fault && system_.value(state, *network().fault) != 0;
}

bool ForcedNetwork::is_about_entry(const Step& step) const {
  if (step.edge == kTimeStep) return false;
  const std::string& label = network().edge(step.edge).label;
  return decides_[step.edge] == Decides::World &&
         (label.starts_with('`') || label.starts_with("throws: `"));
}

std::string ForcedNetwork::reason(const Step& step) const {
  if (step.edge == kTimeStep) return "real time";
  const Automaton& automaton = network().automaton(owner_[step.edge]);
  const Edge& edge = network().edge(step.edge);
  switch (automaton.kind) {
    case AutomatonKind::Timer:
      return fmt::format("real time: {}", short_name(tree_, automaton.node));
    case AutomatonKind::StateVariable:
      return fmt::format("when {} changes",
                         tree_.variable(automaton.state_variable).name);
    case AutomatonKind::Node:
      break;
  }
  const std::string node = short_name(tree_, automaton.node);
  switch (decides_[step.edge]) {
    case Decides::Keeps:
      return fmt::format("whether {} keeps its answer", node);
    case Decides::Rounds:
      return fmt::format("how many rounds {} takes", node);
    case Decides::LeafFault:
      return fmt::format("{} writes what is not declared", node);
    case Decides::Halting:
      return fmt::format("what {} writes when it is halted", node);
    default:
      return edge.label.empty() ? fmt::format("what {} does", node)
                                : fmt::format("{}: {}", node, edge.label);
  }
}

namespace {

const Edge* edge_of_root(const BehaviorTree& tree, const Network& network,
                         const Step& step) {
  if (step.edge == kTimeStep) return nullptr;
  const Automaton& root = network.automaton(tree.roots.front());
  const std::uint32_t number = step.edge - root.first_edge;
  return number < root.edges.size() ? &root.edges[number] : nullptr;
}

}  // namespace

bool begins_tick(const BehaviorTree& tree, const Network& network,
                 const Step& step) {
  const Edge* edge = edge_of_root(tree, network, step);
  const Automaton& root = network.automaton(tree.roots.front());
  return edge != nullptr && root.source(*edge).role == LocationRole::Tick;
}

bool ends_tick(const BehaviorTree& tree, const Network& network,
               const Step& step) {
  const Edge* edge = edge_of_root(tree, network, step);
  const Automaton& root = network.automaton(tree.roots.front());
  return edge != nullptr && edge->source != edge->target &&
         is_answer(root.target(*edge).role);
}

}  // namespace btcheck
