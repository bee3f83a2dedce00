// SPDX-License-Identifier: MIT
//
// Most steps of a run are the frame at work: a node is called, a child gives
// control back. What the leaves answered, what became of the variables, who was
// halted and how the tree ended is read off the edge's target and off the
// variables that differ. A caller who waits means that the node is ticked; what
// it did last is the outcome it entered last.
#include "trace/run/record.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "check/check.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"
#include "trace/run/skipping.hpp"

namespace btcheck {
namespace {

// ": battery := Low" for each state variable that a step changed; a SetSV or
// := that leaves its variable as it was is told as well, but not that an entry
// is still unknown.
std::string changes(const BehaviorTree& tree, const Network& network,
                    const Valuation& before, const RunStep& step) {
  std::string text;
  for (std::size_t v = 0; v < tree.variables.size(); ++v) {
    const std::size_t variable = index(network.state_variable[v]);
    const int value = step.after.variables[variable];
    const bool is_same = value == before.variables[variable];
    if (is_same && value == 0 && tree.programs) continue;
    bool is_assigned = !is_same;
    for (const Assignment& update : network.edge(step.step.edge).updates) {
      is_assigned |= update.variable == network.state_variable[v];
    }
    if (!is_assigned) continue;
    text += fmt::format("{} {} := {}", text.empty() ? ":" : ",",
                        tree.variables[v].name,
                        tree.variables[v].value_name(value));
  }
  return text;
}

// "z 6, mode Low": the arguments that a rule asks for, where the step hands
// them over.
std::string given_arguments(const Network& network, const RunStep& step) {
  const Edge& edge = network.edge(step.step.edge);
  std::string text;
  for (const KeptArgument& kept : network.arguments) {
    const bool is_given =
        std::ranges::any_of(edge.updates, [&](const Assignment& update) {
          return update.variable == kept.variable;
        });
    if (!is_given) continue;
    const Variable& variable = network.variable(kept.variable);
    const int value = step.after.variables[index(kept.variable)];
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", variable.name,
                        variable.value_name(value));
  }
  return text;
}

// "dock -> skipped: `docked` is true".
Event skipped_event(const BehaviorTree& tree, const Network& network,
                    const Valuation& before, const RunStep& step) {
  const NodeId id = network.owner_of_edge(step.step.edge).node;
  const Node& node = tree.node(id);
  const std::string name = node.is_root() ? node.name : short_name(tree, id);
  const std::string reason = reason_to_skip(tree, network, before, step);
  std::string effects = changes(tree, network, before, step);
  if (!reason.empty() && !effects.empty()) effects.front() = ',';
  return {fmt::format("{} -> skipped{}{}{}", name, reason.empty() ? "" : ": ",
                      reason, effects),
          is_choice(network, before.variables, step.step.edge)};
}

// What a node does, but for the effects of postconditions.
std::optional<Event> own_event(const BehaviorTree& tree, const Network& network,
                               const Valuation& before, const RunStep& step) {
  const Automaton& automaton = network.owner_of_edge(step.step.edge);
  const Edge& edge = network.edge(step.step.edge);
  if (automaton.kind == AutomatonKind::StateVariable) {
    return Event{edge.label, true};
  }
  const auto name = [&] { return short_name(tree, automaton.node); };
  if (automaton.kind == AutomatonKind::Timer) {
    return Event{"the time of " + name() + " is up",
                 edge.when.lower != edge.when.upper};
  }
  if (begins_to_skip(network, step)) {
    return skipped_event(tree, network, before, step);
  }
  const Node& node = tree.node(automaton.node);
  const Location& location = automaton.target(edge);
  const LocationRole role = location.role;
  if (role == LocationRole::Skipped) return std::nullopt;  // told before
  if (edge.asks_world && is_choice(network, before.variables, step.step.edge)) {
    const bool answers = is_leaf(node.type) && is_answer(role);
    return Event{fmt::format("{}{}{}: {}", name(), answers ? " -> " : "",
                             answers ? location.name : "", edge.label),
                 true};
  }
  if (role == LocationRole::Error) return Event{name() + ": " + edge.label};
  if (role == LocationRole::Tick && !network.arguments.empty()) {
    const std::string given = given_arguments(network, step);
    if (!given.empty()) return Event{name() + " is given " + given};
  }
  if (!is_leaf(node.type)) {
    const bool ends = is_end(role) && edge.source != edge.target;
    if (!node.is_root() || !ends) return std::nullopt;
    return Event{fmt::format("{} -> {}", node.name, location.name)};
  }
  if (role == LocationRole::Halted) return Event{name() + " is halted"};
  if (!is_answer(role)) return std::nullopt;
  const std::string assigned = changes(tree, network, before, step);
  const bool is_assignment = node.type == NodeType::SetSV ||
                             (node.type == NodeType::Eval && !assigned.empty());
  const std::string answer = is_assignment ? "" : " -> " + location.name;
  return Event{name() + answer + assigned,
               is_choice(network, before.variables, step.step.edge)};
}

RecordedStep recorded_step(const BehaviorTree& tree, const Network& network,
                           const Valuation& before, const RunStep& step) {
  const auto event = event_of(tree, network, before, step).value_or(Event{});
  return {step_text(network, step), event.text, event.is_chosen};
}

// What a node is left with when it has entered the location.
std::optional<Phase> outcome(std::string_view location) {
  if (location == "success") return Phase::Success;
  if (location == "failure") return Phase::Failure;
  if (location == "running") return Phase::Running;
  if (location == "halted") return Phase::Halted;
  if (location == "skipped") return Phase::Skipped;
  return std::nullopt;
}

}  // namespace

StateRecorder::StateRecorder(const BehaviorTree& tree, const Network& network)
    : tree_(tree),
      network_(network),
      last_(tree.nodes.size(), Phase::Unvisited),
      last_tick_(tree.nodes.size(), 0),
      ticks_(tree.nodes.size(), 0) {
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    root_of_.push_back(node.is_root() ? n : root_of_[index(node.parent)]);
  }
}

RecordedState StateRecorder::begin(const Valuation& state) const {
  RecordedState first;
  first.step = "start";
  show(state, first);
  return first;
}

RecordedState StateRecorder::take(const Valuation& before,
                                  const RunStep& step) {
  RecordedState state = take_step(before, step);
  show(step.after, state);
  return state;
}

RecordedState StateRecorder::take_step(const Valuation& before,
                                       const RunStep& step) {
  RecordedState state;
  time_ += step.step.elapsed;
  static_cast<RecordedStep&>(state) =
      recorded_step(tree_, network_, before, step);
  note(step, state);
  state.time = time_;
  state.tick = tick_;
  return state;
}

std::string_view StateRecorder::location(NodeId node,
                                         const Valuation& state) const {
  const Automaton& automaton =
      network_.automaton(network_.node_automaton[index(node)]);
  const int here = state.variables[index(automaton.location)];
  return automaton.locations[static_cast<std::size_t>(here)].name;
}

int StateRecorder::status(NodeId node, const Valuation& state) const {
  return state.variables[index(network_.node_status[index(node)])];
}

// Who has moved, and what the node is left with.
void StateRecorder::note(const RunStep& step, RecordedState& state) {
  if (step.step.edge == kTimeStep) return;
  const Automaton& automaton = network_.owner_of_edge(step.step.edge);
  if (automaton.kind != AutomatonKind::Node) return;
  const std::uint32_t node = index(automaton.node);
  state.mover = node;
  const std::string_view reached = location(automaton.node, step.after);
  if (tree_.node(automaton.node).is_root() && reached == "tick_node") {
    tick_ = std::max(tick_, ++ticks_[node]);
  }
  if (const auto left_with = outcome(reached)) {
    last_[node] = *left_with;
    last_tick_[node] = ticks_[root_of_[node]];
  }
}

void StateRecorder::show(const Valuation& state, RecordedState& shown) const {
  const std::size_t count = tree_.nodes.size();
  shown.statuses.reserve(count);
  shown.locations.reserve(count);
  shown.phases.reserve(count);
  shown.is_stale.reserve(count);
  for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
    const NodeId node{n};
    shown.statuses.emplace_back(status_names(
        tree_.profile)[static_cast<std::size_t>(status(node, state))]);
    shown.locations.emplace_back(location(node, state));
    shown.phases.push_back(phase(node, state));
    shown.is_stale.push_back(!is_ticked(node, state) &&
                             last_[n] != Phase::Unvisited &&
                             last_tick_[n] < ticks_[root_of_[n]]);
  }
  for (std::size_t v = 0; v < tree_.variables.size(); ++v) {
    const int value = state.variables[index(network_.state_variable[v])];
    shown.values.push_back(tree_.variables[v].value_name(value));
  }
}

bool StateRecorder::is_ticked(NodeId node, const Valuation& state) const {
  const auto caller = network_.node_caller[index(node)];
  if (caller) return state.variables[index(*caller)] != 0;
  const std::string_view here = location(node, state);
  return here != "start_" && !outcome(here);
}

bool StateRecorder::is_halting(NodeId node, const Valuation& state) const {
  const std::string_view here = location(node, state);
  return status(node, state) == static_cast<int>(NodeStatus::HaltMe) ||
         here == "halt" || here == "halted" ||
         (here == "done" && last_[index(node)] == Phase::Halted);
}

Phase StateRecorder::phase(NodeId node, const Valuation& state) const {
  if (!is_ticked(node, state)) return last_[index(node)];
  if (is_halting(node, state)) return Phase::Halting;
  const bool waits = std::ranges::any_of(
      tree_.node(node).children,
      [&](NodeId child) { return is_ticked(child, state); });
  return waits ? Phase::Waiting : Phase::Here;
}

namespace {

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

std::optional<Event> event_of(const BehaviorTree& tree, const Network& network,
                              const Valuation& before, const RunStep& step) {
  if (step.step.edge == kTimeStep) return std::nullopt;
  if (auto event = own_event(tree, network, before, step)) return event;
  const std::string effects = changes(tree, network, before, step);
  if (effects.empty()) return std::nullopt;
  const Automaton& mover = network.owner_of_edge(step.step.edge);
  return Event{short_name(tree, mover.node) + effects, false};
}

std::string step_text(const Network& network, const RunStep& step) {
  if (step.step.edge == kTimeStep) return std::string(kTimePasses);
  const Automaton& automaton = network.owner_of_edge(step.step.edge);
  const Edge& edge = network.edge(step.step.edge);
  std::string text =
      fmt::format("{}: {} -> {}", automaton.name, automaton.source(edge).name,
                  automaton.target(edge).name);
  for (const Assignment& update : edge.updates) {
    text += fmt::format(
        ", {} := {}", qualified_name(network, update.variable),
        network.variable(update.variable)
            .value_name(step.after.variables[index(update.variable)]));
  }
  return text;
}

// Of a file that is included, or that lies around the tree's.
const std::string* text_of(const TreeReading& reading,
                           const std::string& file) {
  for (const auto* files : {&reading.included, &reading.neighbours}) {
    const auto found = std::ranges::find(*files, file, &InputFile::name);
    if (found != files->end()) return &found->text.text();
  }
  return nullptr;
}

void add_sources(RunWords& words, const BehaviorTree& tree,
                 const TreeInput& input) {
  words.source = input.text;
  for (std::uint32_t i = 0; i < tree.included.size(); ++i) {
    const std::string& file = tree.included[i];
    const bool is_used = std::ranges::any_of(
        tree.nodes, [&](const Node& node) { return node.included == i + 1; });
    const std::string* text = text_of(input.reading, file);
    if (is_used && text != nullptr) words.included.push_back({file, *text});
  }
}

RecordedRun recorded_tree(const BehaviorTree& tree, const TreeInput& input) {
  RecordedRun run;
  run.tree = tree.file;
  run.nodes = recorded_nodes(tree);
  add_sources(run, tree, input);
  return run;
}

RecordedRun recorded_heading(const BehaviorTree& tree, const Network& network,
                             const RunWords& words) {
  RecordedRun record;
  static_cast<RunWords&>(record) = words;
  record.tree = tree.file;
  record.ticks = tick_name(network.ticks);
  record.nodes = recorded_nodes(tree);
  for (const StateVariable& variable : tree.variables) {
    record.variables.push_back(variable.name);
    record.is_number.push_back(!variable.is_enumeration());
  }
  return record;
}

namespace {

// Which states are told with what their nodes are in.
enum class StatesTold : std::uint8_t { All, Last };

RecordedRun recorded(const BehaviorTree& tree, const Network& network,
                     const Run& run, const RunHeading& heading,
                     StatesTold told) {
  RecordedRun record = recorded_heading(tree, network, heading);
  StateRecorder recorder(tree, network);
  record.states.push_back(recorder.begin(run.state(0)));
  // Where the loop closes, the run has the state it returns to once more.
  const std::size_t count = run.state_count() - (run.loop != kNoLoop);
  for (std::size_t i = 1; i < count; ++i) {
    look_at_budget();
    const Valuation& before = run.state(i - 1);
    const RunStep& step = run.steps[i - 1];
    record.states.push_back(told == StatesTold::All || i + 1 == count
                                ? recorder.take(before, step)
                                : recorder.take_step(before, step));
  }
  if (run.loop != kNoLoop) {
    record.loop = run.loop;
    const RunStep& back = run.steps.back();
    record.back =
        recorded_step(tree, network, run.state(run.state_count() - 2), back);
    record.back_elapsed = back.step.elapsed;
  }
  return record;
}

}  // namespace

RecordedRun recorded_steps(const BehaviorTree& tree, const Network& network,
                           const Run& run) {
  return recorded(tree, network, run, {}, StatesTold::Last);
}

RecordedRun recorded(const BehaviorTree& tree, const Network& network,
                     const Run& run, const RunHeading& heading) {
  RecordedRun record = recorded(tree, network, run, heading, StatesTold::All);
  for (const WatchedPart& part : heading.watched) {
    record.atoms.push_back(part.text);
    for (std::size_t i = 0; i < record.states.size(); ++i) {
      record.states[i].atoms.push_back(part.at[i]);
    }
  }
  const auto within = [&](std::optional<std::size_t> state) {
    return state ? std::min(*state, record.states.size() - 1) : kNoState;
  };
  record.trigger = within(heading.trigger);
  if (!heading.trigger) record.trigger_words.clear();
  record.lost = within(heading.lost);
  return record;
}

RecordedRun recorded_simulation(const BehaviorTree& tree,
                                const Network& network, const TreeInput& input,
                                const Run& run, const std::string& how) {
  RunHeading heading;
  heading.property = how;
  heading.formula = "one run of many; no property is checked";
  heading.verdict = "SIMULATED";
  add_sources(heading, tree, input);
  return recorded(tree, network, run, heading);
}

}  // namespace btcheck
