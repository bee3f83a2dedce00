// SPDX-License-Identifier: MIT
//
// The order of the automata is the paper's numbering; what each node's
// automaton looks like stands in mapping/, one file per family of node types.
#include "model/lowering.hpp"

#include <utility>

#include "model/btcpp/action_clients.hpp"
#include "model/mapping/btcpp/builder.hpp"
#include "model/mapping/paper/drawings.hpp"
#include "model/mapping/py_trees/drawings.hpp"
#include "model/tree/answers.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

Automaton& add_automaton_of(mapping::Context& context, StateVariableId variable,
                            VariableId location) {
  Network& network = context.network;
  const StateVariable& written = context.tree.variable(variable);
  network.state_automaton[index(variable)] =
      AutomatonId{static_cast<std::uint32_t>(network.automata.size())};
  Automaton& automaton = network.automata.emplace_back();
  automaton.kind = AutomatonKind::StateVariable;
  automaton.name = written.name;
  automaton.state_variable = variable;
  automaton.location = location;
  return automaton;
}

// The automaton of an enumerated state variable (paper, section 3.8.3 and the
// Mars rover of appendix F): its locations are the values. One that the tree
// writes stays where the tree puts it; the others move along :transitions at
// any instant, or when its clock says so.
void add_state_automaton(mapping::Context& context, StateVariableId variable) {
  const StateVariable& written = context.tree.variable(variable);
  Automaton& automaton = add_automaton_of(
      context, variable, context.network.state_variable[index(variable)]);
  for (const std::string& state : written.states) {
    automaton.locations.push_back({state});
  }
  if (!moves_freely(context.tree, variable)) return;
  const bool has_clock =
      !written.lasting.empty() && context.network.ticks != TickSemantics::None;
  for (std::size_t i = 0; i < written.transitions.size(); ++i) {
    const auto& [from, to] = written.transitions[i];
    // A move within a region is to another of its values.
    if (from == to && written.programs.empty()) continue;
    Edge& edge = automaton.edges.emplace_back();
    edge.source = LocationId{static_cast<std::uint32_t>(from)};
    edge.target = LocationId{static_cast<std::uint32_t>(to)};
    edge.when = kAnyTime;
    if (has_clock) edge.when = {written.lasting[i].min, written.lasting[i].max};
    edge.label = written.name + " := " + written.value_name(to);
    if (!written.programs.empty()) {
      edge.scripts = {{written.programs[static_cast<std::size_t>(to)],
                       ScriptOutcomeKind::Ends}};
    }
  }
}

// A free number has one location, in which it takes any value at any instant,
// the present one as well: so the same is true of every value of a region.
void add_moving_number(mapping::Context& context, StateVariableId variable) {
  const StateVariable& written = context.tree.variable(variable);
  const VariableId value = context.network.state_variable[index(variable)];
  Automaton& automaton = add_automaton_of(
      context, variable,
      context.add_variable(
          {VariableRole::Location, "location", 0, 0, 0, {"moves"}}));
  automaton.locations.push_back({"moves"});
  if (written.min == written.max) return;
  for (const int next : context.sampled(variable)) {
    Edge& edge = automaton.edges.emplace_back();
    edge.when = kAnyTime;
    edge.updates = {mapping::set(value, next)};
    edge.label = written.name + " := " + written.value_name(next);
  }
}

void add_state_variables(mapping::Context& context) {
  for (const StateVariable& variable : context.tree.variables) {
    context.network.state_variable.push_back(context.add_variable(
        {VariableRole::State, variable.name, variable.min, variable.max,
         variable.initial, variable.states, std::nullopt, variable.scale}));
  }
  context.network.state_automaton.resize(context.tree.variables.size());
  for (std::uint32_t i = 0; i < context.tree.variables.size(); ++i) {
    const StateVariableId variable{i};
    if (context.tree.variables[i].is_enumeration()) {
      add_state_automaton(context, variable);
    } else if (moves_freely(context.tree, variable)) {
      add_moving_number(context, variable);
    }
  }
}

// Every node gets its process number and its shared record before any
// automaton is drawn, because an automaton names those of its children.
void add_nodes(mapping::Context& context,
               const std::vector<NodeId>& in_post_order) {
  Network& network = context.network;
  const std::size_t count = context.tree.nodes.size();
  const auto words = status_names(context.tree.profile);
  network.node_automaton.resize(count);
  network.node_status.resize(count);
  network.node_caller.resize(count);
  for (NodeId node : in_post_order) {
    const Node& written = context.tree.node(node);
    network.node_automaton[index(node)] =
        AutomatonId{static_cast<std::uint32_t>(network.automata.size())};
    Automaton automaton;
    automaton.name = unique_name(context.tree, node);
    automaton.node = node;
    automaton.location =
        context.add_variable({VariableRole::Location, "location", 0, 0, 0, {}});
    if (!written.is_root()) {
      automaton.gate = context.add_variable(
          {VariableRole::Caller,
           "caller",
           0,
           1,
           0,
           {"None", unique_name(context.tree, written.parent)}});
      network.node_caller[index(node)] = automaton.gate;
    }
    network.node_status[index(node)] = context.add_variable(
        {VariableRole::Status, "rstatus", 0, static_cast<int>(words.size()) - 1,
         0, std::vector<std::string>(words.begin(), words.end())});
    network.automata.push_back(std::move(automaton));
  }
}

// Drops the locations of the frame that no edge leads to (a ForceFailure has
// no use for `success`), with the edges that leave them. A timer is called
// into its locations by others and keeps them all.
void drop_unused_locations(Automaton& automaton) {
  std::vector<bool> used(automaton.locations.size(), false);
  used[0] = true;
  for (bool grows = true; grows;) {
    grows = false;
    for (const Edge& edge : automaton.edges) {
      if (!used[index(edge.source)] || used[index(edge.target)]) continue;
      used[index(edge.target)] = grows = true;
    }
  }
  std::vector<LocationId> renumbered(used.size());
  std::vector<Location> kept;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    renumbered[i] = LocationId{static_cast<std::uint32_t>(kept.size())};
    kept.push_back(std::move(automaton.locations[i]));
  }
  automaton.locations = std::move(kept);
  std::erase_if(automaton.edges,
                [&](const Edge& edge) { return !used[index(edge.source)]; });
  for (Edge& edge : automaton.edges) {
    edge.source = renumbered[index(edge.source)];
    edge.target = renumbered[index(edge.target)];
  }
}

const mapping::Drawings& drawings_of(Profile profile) {
  using namespace mapping;
  static const Drawings kBtf(
      In::Btf, {kLeafDrawings, kControlDrawings, kDecoratorDrawings});
  static const Drawings kBtcpp(
      In::Btcpp, {kEngineLeafDrawings, kEngineSequenceDrawings,
                  kEngineParallelDrawings, kBranchingDrawings,
                  kEngineDecoratorDrawings, kTimeDrawings, kNav2Drawings});
  static const Drawings kPyTrees(
      In::PyTrees, {kPyTreesLeafDrawings, kPyTreesCompositeDrawings,
                    kPyTreesDecoratorDrawings});
  if (profile == Profile::PyTrees) return kPyTrees;
  return is_engine(profile) ? kBtcpp : kBtf;
}

// Rounds of an unknown number come to an end, and a goal is not reached in no
// time: the first say so where they are drawn.
void mark_goals(const BehaviorTree& tree, Automaton& automaton) {
  if (!btcpp::is_action_client(tree.profile, tree.node(automaton.node).id)) {
    return;
  }
  for (Edge& edge : automaton.edges) {
    if (automaton.target(edge).role == LocationRole::Success) {
      edge.is_like_time = true;
    }
  }
}

// Edge numbers, whose each variable is, and the domains of locations.
void finish(const BehaviorTree& tree, Network& network) {
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    Automaton& automaton = network.automata[a];
    const auto own = [&](VariableId variable) {
      network.variables[index(variable)].owner = AutomatonId{a};
    };
    if (automaton.kind == AutomatonKind::Node) {
      drop_unused_locations(automaton);
      mark_goals(tree, automaton);
    }
    own(automaton.location);
    if (automaton.kind == AutomatonKind::StateVariable) continue;
    if (automaton.gate) own(*automaton.gate);
    for (const VariableId local : automaton.locals) own(local);
    if (automaton.kind == AutomatonKind::Node) {
      own(network.node_status[index(automaton.node)]);
    }
    Variable& location = network.variables[index(automaton.location)];
    location.max = static_cast<int>(automaton.locations.size()) - 1;
    location.value_names = automaton.location_names();
  }
  network.number_edges();
}

}  // namespace

Network lower(const BehaviorTree& tree, TickSemantics ticks,
              const SampledValues& samples) {
  const Stage stage("the automata were drawn");
  Network network;
  network.profile = tree.profile;
  network.ticks = ticks;
  mapping::Context context{tree, network, {}, samples};
  const std::vector<NodeId> in_post_order = post_order(tree);
  const mapping::Drawings& drawings = drawings_of(tree.profile);
  add_state_variables(context);
  add_nodes(context, in_post_order);
  if (is_engine(tree.profile)) context.answers = possible_answers(tree);
  for (NodeId node : in_post_order) {
    ask_budget();
    mapping::NodeBuilder builder(context, node);
    drawings.of(tree.node(node).type)(builder);
  }
  finish(tree, network);
  return network;
}

}  // namespace btcheck
