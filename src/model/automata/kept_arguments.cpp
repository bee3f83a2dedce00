// SPDX-License-Identifier: MIT
//
// An action is started with its arguments and keeps them while it runs, though
// the variables they were made of may change. So the edge that ticks it is
// drawn twice, for one that runs and one that does not, and so is the edge that
// ends its tick, where the value goes back to its rest: what nobody may ask for
// must not tell states apart.
#include "model/automata/kept_arguments.hpp"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

namespace btcheck {
namespace {

class Keeper {
 public:
  Keeper(const BehaviorTree& tree, Network& network, NodeId node)
      : tree_(tree),
        network_(network),
        node_(node),
        status_(network.node_status[index(node)]) {}

  void keep(const std::set<std::size_t>& numbers) {
    for (const std::size_t number : numbers) add(number);
    if (!given_.empty()) redraw();
  }

 private:
  Automaton& automaton() {
    return network_.automata[index(network_.node_automaton[index(node_)])];
  }

  void add(std::size_t number) {
    const Argument& argument = tree_.node(node_).arguments[number];
    assert(argument.known);
    const ArgumentValue& known = *argument.known;
    const int rest = std::clamp(0, known.min, known.max);
    const VariableId variable{
        static_cast<std::uint32_t>(network_.variables.size())};
    network_.variables.push_back({VariableRole::Local, argument.key, known.min,
                                  known.max, rest, known.names,
                                  network_.node_automaton[index(node_)],
                                  Scale{1, known.decimals}});
    network_.arguments.push_back({node_, number, variable});
    automaton().locals.push_back(variable);
    if (known.min == known.max) return;
    given_.push_back({variable, over_network(network_, known.value)});
    rests_.push_back({variable, Expression::constant(rest)});
  }

  void redraw() {
    std::vector<Edge> edges;
    for (Edge& edge : std::exchange(automaton().edges, {})) {
      const LocationRole from = automaton().source(edge).role;
      const LocationRole to = automaton().target(edge).role;
      const bool begins =
          from == LocationRole::Start && to == LocationRole::Tick;
      const bool ends = from == LocationRole::Done && to == LocationRole::Start;
      if (!begins && !ends) {
        edges.push_back(std::move(edge));
        continue;
      }
      Edge other = edge;
      const auto& updates = begins ? given_ : rests_;
      other.updates.insert(other.updates.begin(), updates.begin(),
                           updates.end());
      if (automaton().find_location(LocationRole::Running)) {
        const int running = static_cast<int>(NodeStatus::Running);
        other.guard = both(other.guard, differs(status_, running));
        edge.guard = both(edge.guard, equals(status_, running));
        edges.push_back(std::move(edge));
      }
      edges.push_back(std::move(other));
    }
    automaton().edges = std::move(edges);
  }

  const BehaviorTree& tree_;
  Network& network_;
  NodeId node_;
  VariableId status_;
  std::vector<Assignment> given_;
  std::vector<Assignment> rests_;
};

}  // namespace

void keep_arguments(const BehaviorTree& tree, const AskedArguments& asked,
                    Network& network) {
  assert(network.arguments.empty());
  for (const auto& [node, numbers] : asked) {
    Keeper(tree, network, node).keep(numbers);
  }
  network.number_edges();
}

std::optional<VariableId> kept_argument(const Network& network, NodeId node,
                                        std::size_t number) {
  const auto found =
      std::ranges::find_if(network.arguments, [&](const KeptArgument& each) {
        return each.node == node && each.number == number;
      });
  if (found == network.arguments.end()) return std::nullopt;
  return found->variable;
}

Expression has_arguments(const Network& network, NodeId node) {
  const Automaton& automaton = network.automaton(node);
  const auto start = automaton.find_location(LocationRole::Start);
  assert(start);
  Expression has = differs(automaton.location, static_cast<int>(index(*start)));
  if (const auto failed = automaton.find_location(kNoArguments)) {
    has = both(std::move(has),
               differs(automaton.location, static_cast<int>(index(*failed))));
  }
  if (!automaton.find_location(LocationRole::Running)) return has;
  const VariableId status = network.node_status[index(node)];
  for (const NodeStatus held : {NodeStatus::Running, NodeStatus::HaltMe}) {
    has =
        Expression::binary(Operation::Or, std::move(has), equals(status, held));
  }
  return has;
}

}  // namespace btcheck
