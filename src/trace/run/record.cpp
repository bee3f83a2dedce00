// SPDX-License-Identifier: MIT
//
// A phase is read off what the node's automaton does: a caller who waits means
// that the node is ticked, and what it did last is the outcome it entered last.
#include "trace/run/record.hpp"

#include <algorithm>

#include "model/tree/node_types.hpp"
#include "trace/run/event.hpp"

namespace btcheck {
namespace {

// What a node is left with when it has entered the location.
std::optional<Phase> outcome(std::string_view location) {
  if (location == "success") return Phase::Success;
  if (location == "failure") return Phase::Failure;
  if (location == "running") return Phase::Running;
  // Skipped, it is as if it had not been ticked.
  if (location == "skipped") return Phase::Unvisited;
  if (location == "halted") return Phase::Halted;
  return std::nullopt;
}

class Recorder {
 public:
  Recorder(const BehaviorTree& tree, const Network& network, const Run& run)
      : tree_(tree),
        network_(network),
        run_(run),
        last_(tree.nodes.size(), Phase::Unvisited),
        last_tick_(tree.nodes.size(), 0),
        ticks_(tree.nodes.size(), 0) {}

  std::vector<RecordedState> states() {
    std::vector<RecordedState> states;
    // Where the loop closes, the run has the state it returns to once more.
    const std::size_t count = run_.state_count() - (run_.loop != kNoLoop);
    for (std::size_t i = 0; i < count; ++i) {
      RecordedState state;
      if (i == 0) {
        state.step = "start";
      } else {
        take(run_.steps[i - 1], run_.state(i - 1), state);
      }
      show(run_.state(i), state);
      states.push_back(std::move(state));
    }
    return states;
  }

 private:
  NodeId root_of(NodeId node) const {
    while (!tree_.node(node).is_root()) node = tree_.node(node).parent;
    return node;
  }
  std::string_view location(NodeId node, const Valuation& state) const {
    const Automaton& automaton =
        network_.automaton(network_.node_automaton[index(node)]);
    const int here = state.variables[index(automaton.location)];
    return automaton.locations[static_cast<std::size_t>(here)].name;
  }

  void take(const RunStep& step, const Valuation& before,
            RecordedState& state) {
    time_ += step.step.elapsed;
    state.step = step_text(network_, step);
    if (const auto event = event_of(tree_, network_, before, step)) {
      state.event = event->text;
      state.is_chosen = event->is_chosen;
    }
    if (step.step.edge == kTimeStep) return;
    const Automaton& automaton = network_.owner_of_edge(step.step.edge);
    if (automaton.kind != AutomatonKind::Node) return;
    const std::uint32_t node = index(automaton.node);
    state.mover = node;
    const std::string_view reached = location(automaton.node, step.after);
    if (tree_.node(automaton.node).is_root() && reached == "tick_node") {
      ++ticks_[node];
    }
    if (const auto left_with = outcome(reached)) {
      last_[node] = *left_with;
      last_tick_[node] = ticks_[index(root_of(automaton.node))];
    }
  }

  void show(const Valuation& state, RecordedState& shown) const {
    shown.time = time_;
    shown.tick = *std::max_element(ticks_.begin(), ticks_.end());
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      const NodeId node{n};
      shown.statuses.emplace_back(
          status_names(tree_.profile)[static_cast<std::size_t>(
              state.variables[index(network_.node_status[n])])]);
      shown.locations.emplace_back(location(node, state));
      shown.phases.push_back(phase(node, state));
      shown.is_stale.push_back(!is_ticked(node, state) &&
                               last_[n] != Phase::Unvisited &&
                               last_tick_[n] < ticks_[index(root_of(node))]);
    }
    for (std::size_t v = 0; v < tree_.variables.size(); ++v) {
      const int value = state.variables[index(network_.state_variable[v])];
      shown.values.push_back(tree_.variables[v].value_name(value));
    }
  }

  bool is_ticked(NodeId node, const Valuation& state) const {
    const auto caller = network_.node_caller[index(node)];
    if (caller) return state.variables[index(*caller)] != 0;
    const std::string_view here = location(node, state);
    return here != "start_" && !outcome(here);
  }
  bool is_halting(NodeId node, const Valuation& state) const {
    const auto status = network_.node_status[index(node)];
    const std::string_view here = location(node, state);
    const bool was_halted =
        here == "done" && last_[index(node)] == Phase::Halted;
    return state.variables[index(status)] ==
               static_cast<int>(NodeStatus::HaltMe) ||
           here == "halt" || here == "halted" || was_halted;
  }
  Phase phase(NodeId node, const Valuation& state) const {
    if (!is_ticked(node, state)) return last_[index(node)];
    if (is_halting(node, state)) return Phase::Halting;
    const auto& children = tree_.node(node).children;
    const bool waits =
        std::any_of(children.begin(), children.end(),
                    [&](NodeId child) { return is_ticked(child, state); });
    return waits ? Phase::Waiting : Phase::Here;
  }

  const BehaviorTree& tree_;
  const Network& network_;
  const Run& run_;
  int time_ = 0;
  std::vector<Phase> last_;     // by node
  std::vector<int> last_tick_;  // of its root, when that was
  std::vector<int> ticks_;      // by root
};

std::vector<RecordedNode> recorded_nodes(const BehaviorTree& tree) {
  std::vector<RecordedNode> nodes;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    RecordedNode recorded;
    recorded.key = unique_name(tree, NodeId{n});
    recorded.type = type_name(node.type);
    recorded.name = node.name;
    if (node.included != 0) recorded.file = tree.file_of(NodeId{n});
    recorded.line = node.span.line;
    recorded.column = node.span.column;
    if (!node.is_root()) recorded.parent = index(node.parent);
    nodes.push_back(std::move(recorded));
  }
  return nodes;
}

}  // namespace

RecordedRun recorded(const BehaviorTree& tree, const Network& network,
                     const Run& run, const RunHeading& heading) {
  RecordedRun record;
  record.tree = tree.file;
  record.source = heading.source;
  record.ticks = tick_name(network.ticks);
  record.property = heading.property;
  record.formula = heading.formula;
  record.verdict = heading.verdict;
  record.why = heading.why;
  record.nodes = recorded_nodes(tree);
  for (const StateVariable& variable : tree.variables) {
    record.variables.push_back(variable.name);
    record.is_number.push_back(!variable.is_enumeration());
  }
  record.states = Recorder(tree, network, run).states();
  for (const WatchedPart& part : heading.watched) {
    record.atoms.push_back(part.text);
    for (std::size_t i = 0; i < record.states.size(); ++i) {
      record.states[i].atoms.push_back(part.at[i]);
    }
  }
  if (run.loop != kNoLoop) {
    record.loop = run.loop;
    const RunStep& back = run.steps.back();
    record.back = step_text(network, back);
    record.back_elapsed = back.step.elapsed;
    const Valuation& last = run.state(run.state_count() - 2);
    if (const auto event = event_of(tree, network, last, back)) {
      record.back_event = event->text;
      record.back_is_chosen = event->is_chosen;
    }
  }
  const auto within = [&](std::optional<std::size_t> state) {
    return state ? std::min(*state, record.states.size() - 1) : kNoState;
  };
  record.trigger = within(heading.trigger);
  if (heading.trigger) record.trigger_words = heading.trigger_words;
  record.end_words = heading.end_words;
  record.lost = within(heading.lost);
  return record;
}

}  // namespace btcheck
