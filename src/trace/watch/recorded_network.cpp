// SPDX-License-Identifier: MIT
#include "trace/watch/recorded_network.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "model/tree/node_types.hpp"
#include "text/diagnostic.hpp"
#include "text/numbers.hpp"

namespace btcheck {
namespace {

// The locations of every node's frame, by the names that runs have.
constexpr std::array<std::pair<std::string_view, LocationRole>, 10>
    kFrameLocations = {{{"start_", LocationRole::Start},
                        {"tick_node", LocationRole::Tick},
                        {"success", LocationRole::Success},
                        {"failure", LocationRole::Failure},
                        {"running", LocationRole::Running},
                        {"skipped", LocationRole::Skipped},
                        {"halt", LocationRole::Halt},
                        {"halted", LocationRole::Halted},
                        {"done", LocationRole::Done},
                        {"elsewhere", LocationRole::Inner}}};
constexpr int kElsewhere = static_cast<int>(kFrameLocations.size()) - 1;

// Of a number that no file says the bounds of.
constexpr int kGreatest = 1'000'000'000;

NodeType type_named(std::string_view name) {
  for (const NodeTypeInfo& info : kNodeTypes) {
    if (info.name == name) return info.type;
  }
  return NodeType::OtherControl;
}

// The words that rules compare variables with.
std::vector<std::string> symbols_in(const PropertyFile& rules) {
  std::vector<std::string> found;
  for (const Atom& atom : rules.atoms) {
    if (!atom.word.empty()) found.push_back(atom.word);
    visit_leaves(atom, [&](const Operand& side) {
      if (side.node.empty() && !side.name.empty()) found.push_back(side.name);
    });
  }
  return found;
}

template <class Text>
void add_once(std::vector<std::string>& words, const Text& word) {
  const bool is_known = std::ranges::any_of(words, [&](const auto& known) {
    return equal_ignoring_case(known, word);
  });
  if (!is_known) words.emplace_back(word);
}

}  // namespace

int RecordedNetwork::location_number(std::string_view name) {
  const auto place = std::ranges::find(
      kFrameLocations, name, &std::pair<std::string_view, LocationRole>::first);
  return place == kFrameLocations.end()
             ? kElsewhere
             : static_cast<int>(place - kFrameLocations.begin());
}

RecordedNetwork::RecordedNetwork(const RecordedRun& run,
                                 const PropertyFile& rules)
    : regions_(rules), has_entries_(run.has_entries) {
  const bool is_of_engine =
      !run.states.empty() && std::ranges::any_of(run.states.front().statuses,
                                                 [](const std::string& status) {
                                                   return status == "idle";
                                                 });
  const bool is_log = run.states.empty();
  tree_.file = run.tree;
  tree_.profile = is_log || is_of_engine ? Profile::Btcpp4 : Profile::Paper;
  network_.profile = tree_.profile;
  network_.ticks = tick_semantics(run.ticks).value_or(TickSemantics::Root);
  const auto names = has_entries_ ? entry_names(run.variables) : run.variables;
  for (std::size_t v = 0; v < run.variables.size(); ++v) {
    add_variable(has_entries_ ? regions_.variable(names[v])
                              : variable_of(run, v, rules));
  }
  for (std::uint32_t n = 0; n < run.nodes.size(); ++n) {
    add_node(run.nodes[n], n);
  }
  network_.node_automaton.resize(run.nodes.size());
  network_.node_status.resize(run.nodes.size());
  network_.node_caller.resize(run.nodes.size());
  for (const NodeId node : post_order(tree_)) add_automaton(index(node));
}

VariableId RecordedNetwork::add(VariableRole role, std::string name,
                                std::vector<std::string> values,
                                std::optional<AutomatonId> owner) {
  Variable variable;
  variable.role = role;
  variable.name = std::move(name);
  variable.max = static_cast<int>(values.size()) - 1;
  variable.value_names = std::move(values);
  variable.owner = owner;
  network_.variables.push_back(std::move(variable));
  return VariableId{static_cast<std::uint32_t>(network_.variables.size() - 1)};
}

StateVariable RecordedNetwork::variable_of(const RecordedRun& run,
                                           std::size_t number,
                                           const PropertyFile& rules) {
  StateVariable variable;
  variable.name = run.variables[number];
  if (run.is_number[number]) {
    variable.min = -kGreatest;
    variable.max = kGreatest;
  } else {
    for (const RecordedState& state : run.states) {
      add_once(variable.states, state.values[number]);
    }
    for (const std::string& word : symbols_in(rules)) {
      add_once(variable.states, word);
    }
    variable.max = static_cast<int>(variable.states.size()) - 1;
  }
  return variable;
}

void RecordedNetwork::add_variable(StateVariable variable) {
  const AutomatonId automaton{
      static_cast<std::uint32_t>(network_.automata.size())};
  const bool moves = variable.is_enumeration();
  const VariableId own =
      add(VariableRole::State, variable.name, variable.states,
          moves ? std::optional(automaton) : std::nullopt);
  network_.variables.back().min = variable.min;
  network_.variables.back().max = variable.max;
  network_.state_variable.push_back(own);
  network_.state_automaton.push_back(moves ? std::optional(automaton)
                                           : std::nullopt);
  if (moves) {
    Automaton& made = network_.automata.emplace_back();
    made.kind = AutomatonKind::StateVariable;
    made.name = variable.name;
    made.location = own;
    for (const std::string& state : variable.states) {
      made.locations.push_back({state, LocationRole::Inner, {}});
    }
  }
  tree_.variables.push_back(std::move(variable));
}

void RecordedNetwork::add_node(const RecordedNode& node, std::uint32_t number) {
  Node made;
  made.type = type_named(node.type);
  made.name = node.name;
  made.id = node.type;
  made.span.line = static_cast<int>(node.line);
  made.span.column = static_cast<int>(node.column);
  made.parent = NodeId{node.parent.value_or(number)};
  if (node.parent) {
    tree_.nodes[*node.parent].children.push_back(NodeId{number});
  } else {
    tree_.roots.push_back(NodeId{number});
  }
  tree_.nodes.push_back(std::move(made));
}

void RecordedNetwork::add_automaton(std::uint32_t number) {
  const AutomatonId id{static_cast<std::uint32_t>(network_.automata.size())};
  const Node& node = tree_.nodes[number];
  Automaton made;
  made.kind = AutomatonKind::Node;
  made.name = unique_name(tree_, NodeId{number});
  made.node = NodeId{number};
  std::vector<std::string> names;
  for (const auto& [name, role] : kFrameLocations) {
    made.locations.push_back({std::string(name), role, {}});
    names.emplace_back(name);
  }
  made.location = add(VariableRole::Location, "location", names, id);
  const auto statuses = status_names(tree_.profile);
  network_.node_status[number] = add(VariableRole::Status, "rstatus",
                                     {statuses.begin(), statuses.end()}, id);
  if (!node.is_root()) {
    made.gate = add(VariableRole::Caller, "caller", {"None", "parent"}, id);
    network_.node_caller[number] = made.gate;
  }
  network_.node_automaton[number] = id;
  network_.automata.push_back(std::move(made));
}

VariableId RecordedNetwork::location(std::size_t node) const {
  return network_.automaton(NodeId{static_cast<std::uint32_t>(node)}).location;
}

int RecordedNetwork::value_of(std::size_t variable,
                              const std::string& word) const {
  const StateVariable& of = tree_.variables[variable];
  if (!of.is_enumeration()) return as_number<int>(word).value_or(0);
  const auto place = std::ranges::find_if(of.states, [&](const auto& state) {
    return equal_ignoring_case(state, word);
  });
  return static_cast<int>(place - of.states.begin());
}

void RecordedNetwork::read(const RecordedState& state,
                           std::span<const std::size_t> nodes,
                           Valuation& valuation) const {
  auto& values = valuation.variables;
  values.resize(network_.variables.size(), 0);
  const auto statuses = status_names(tree_.profile);
  for (const std::size_t n : nodes) {
    values[index(location(n))] = location_number(state.locations[n]);
    const auto status = std::ranges::find(statuses, state.statuses[n]);
    values[index(network_.node_status[n])] =
        static_cast<int>(status - statuses.begin());
    if (const auto caller = network_.node_caller[n]) {
      values[index(*caller)] = is_active(state.phases[n]) ? 1 : 0;
    }
  }
  for (std::size_t v = 0; v < tree_.variables.size(); ++v) {
    values[index(network_.state_variable[v])] =
        has_entries_ ? regions_.region_of(state.values[v])
                     : value_of(v, state.values[v]);
  }
}

}  // namespace btcheck
