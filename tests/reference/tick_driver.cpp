// SPDX-License-Identifier: MIT
//
// A network ticked from left to right, as a TickInterpreter ticks its tree.
//
// The interpreter goes first; a random script answers its questions and keeps
// them with what was allowed. The network then has to ask the same questions
// and to have an edge for every answer that was allowed, no more and no fewer.
// After each tick both sides tell all they know; an edge that leads elsewhere,
// an update that is missing, a guard that is too weak shows at once or some
// ticks later.
#include "reference/tick_driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "model/tree/node_types.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference {
namespace {

constexpr int kMostSteps = 5000;  // in one tick

constexpr std::array<std::string_view, 5> kEventLocations = {
    "tick_node", "success", "failure", "running", "halted"};

std::optional<EventKind> event_at(std::string_view location) {
  const auto found = std::ranges::find(kEventLocations, location);
  if (found == kEventLocations.end()) return std::nullopt;
  return static_cast<EventKind>(found - kEventLocations.begin());
}

std::optional<NodeStatus> answer_at(std::string_view location) {
  if (location == "success") return NodeStatus::Success;
  if (location == "failure") return NodeStatus::Failure;
  if (location == "running") return NodeStatus::Running;
  return std::nullopt;
}

// The next decision about a node; there must be one.
template <class Choice>
Choice next_of(std::map<NodeId, std::deque<Choice>>& decisions, NodeId node) {
  std::deque<Choice>& left = decisions[node];
  if (left.empty()) {
    throw Disagreement(fmt::format(
        "node {} of the network asks for more than the tree", index(node)));
  }
  Choice next = left.front();
  left.pop_front();
  return next;
}

}  // namespace

const Automaton& TickDriver::root() const {
  return network().automaton(
      network().node_automaton[index(tree_.roots.at(0))]);
}

std::string_view TickDriver::location(const Automaton& automaton) const {
  const int value = state_.value(automaton.location);
  return automaton.locations.at(static_cast<std::size_t>(value)).name;
}

void TickDriver::fire(std::uint32_t number) {
  const Automaton& owner = network().owner_of_edge(number);
  const Edge& edge = network().edge(number);
  state_ = naive_.after(state_, owner, edge);
  if (owner.kind != AutomatonKind::Node) return;
  const auto event = event_at(owner.target(edge).name);
  if (event) events_.push_back({owner.node, *event});
}

// Fires a timer at its deadline, or one within its window if it was decided
// so. False when there is nothing to fire.
bool TickDriver::fire_timer(Decisions& decisions) {
  for (std::size_t a = 0; a < network().automata.size(); ++a) {
    const Automaton& timer = network().automata[a];
    if (timer.kind != AutomatonKind::Timer) continue;
    if (location(timer) != "counting") asked_.erase(timer.node);
    for (std::uint32_t e = 0; e < timer.edges.size(); ++e) {
      if (!naive_.may_fire(state_, timer, timer.edges[e])) continue;
      bool fires = naive_.is_at_deadline(state_, timer, timer.edges[e]);
      if (!asked_.insert(timer.node).second && !fires) continue;
      if (!fires) fires = next_of(decisions.due, timer.node);
      if (!fires) continue;
      fire(timer.first_edge + e);
      return true;
    }
  }
  return false;
}

// One step towards the value, along a shortest way that the edges allow.
bool TickDriver::move_one_step(const Automaton& automaton, int target) {
  const int present = state_.value(automaton.location);
  if (present == target) return false;
  std::set<int> near = {target};
  for (std::size_t before = 0; before != near.size();) {
    before = near.size();
    std::set<int> farther = near;
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      const Edge& edge = automaton.edges[e];
      if (!near.contains(static_cast<int>(index(edge.target)))) continue;
      if (naive_.may_fire(state_, automaton, edge)) {
        fire(automaton.first_edge + e);
        return true;
      }
      farther.insert(static_cast<int>(index(edge.source)));
    }
    near = std::move(farther);
  }
  throw Disagreement("a free variable cannot move where it should");
}

void TickDriver::move_free_variables(const Decisions& decisions) {
  if (decisions.moved.empty()) return;
  for (const Automaton& automaton : network().automata) {
    if (automaton.kind != AutomatonKind::StateVariable) continue;
    const int target = decisions.moved[index(automaton.state_variable)];
    while (move_one_step(automaton, target)) continue;
  }
}

// The edge for the answer that was decided. An outcome whose effects leave a
// range leads to `error`, whatever the answer was.
std::uint32_t TickDriver::answered(NodeId leaf,
                                   const std::vector<std::uint32_t>& enabled,
                                   Decisions& decisions) const {
  const auto decision = next_of(decisions.answers, leaf);
  const Automaton& owner = network().owner_of_edge(enabled[0]);
  std::optional<std::uint32_t> error;
  std::optional<std::uint32_t> found;
  for (const std::uint32_t edge : enabled) {
    const auto answer = answer_at(owner.target(network().edge(edge)).name);
    if (!answer) error = edge;
    if (answer == decision.chosen) found = edge;
    if (answer && std::ranges::find(decision.allowed, *answer) ==
                      decision.allowed.end()) {
      throw Disagreement(owner.name + " may not answer that");
    }
  }
  if (enabled.size() != decision.allowed.size()) {
    throw Disagreement(fmt::format("{} may answer {} things, not {}",
                                   owner.name, decision.allowed.size(),
                                   enabled.size()));
  }
  if (!found) found = error;
  if (!found) throw Disagreement(owner.name + " cannot answer that");
  return *found;
}

std::uint32_t TickDriver::written(NodeId set_sv,
                                  const std::vector<std::uint32_t>& enabled,
                                  Decisions& decisions) const {
  const auto decision = next_of(decisions.values, set_sv);
  const VariableId variable =
      network().state_variable[index(tree_.node(set_sv).variable)];
  const Automaton& owner = network().owner_of_edge(enabled[0]);
  std::map<int, std::uint32_t> offered;
  for (const std::uint32_t edge : enabled) {
    const NaiveState next = naive_.after(state_, owner, network().edge(edge));
    offered[next.value(variable)] = edge;
  }
  for (const int value : decision.allowed) {
    if (!offered.contains(value)) {
      throw Disagreement(owner.name + " cannot choose a value");
    }
  }
  if (enabled.size() != decision.allowed.size()) {
    throw Disagreement(owner.name + " can choose another value");
  }
  return offered.at(decision.chosen);
}

// Which of the enabled edges of one automaton is taken.
std::uint32_t TickDriver::decided(const std::vector<std::uint32_t>& enabled,
                                  Decisions& decisions) const {
  const Automaton& owner = network().owner_of_edge(enabled[0]);
  const NodeType type = tree_.node(owner.node).type;
  const std::string& target = owner.target(network().edge(enabled[0])).name;
  // A leaf whose requirement divides by zero is not asked for an answer.
  const bool faults =
      target == "error" && decisions.answers[owner.node].empty();
  const bool answers = !faults && (answer_at(target) || target == "error");
  if (answers && (type == NodeType::Action || type == NodeType::Condition)) {
    return answered(owner.node, enabled, decisions);
  }
  if (answers && type == NodeType::SetSV) {
    return written(owner.node, enabled, decisions);
  }
  if (enabled.size() > 1) {
    throw Disagreement(fmt::format("{} can take {} edges from {}", owner.name,
                                   enabled.size(), location(owner)));
  }
  return enabled[0];
}

// The first enabled node takes an edge. False when there is none.
bool TickDriver::step_nodes(Decisions& decisions) {
  std::vector<std::uint32_t> first;
  for (const std::uint32_t number : naive_.enabled(state_)) {
    const Automaton& owner = network().owner_of_edge(number);
    if (owner.kind != AutomatonKind::Node) continue;
    if (!first.empty() && &network().owner_of_edge(first[0]) != &owner) break;
    first.push_back(number);
  }
  if (first.empty()) return false;
  fire(decided(first, decisions));
  return true;
}

TickResult TickDriver::tick(Decisions decisions) {
  events_.clear();
  int steps = 0;
  const auto one_more = [&steps] {
    if (++steps > kMostSteps) throw Disagreement("a tick never ends");
  };
  while (step_nodes(decisions)) one_more();
  if (!naive_.may_wait(state_)) throw Disagreement("time cannot pass");
  state_ = naive_.waited(state_);
  asked_.clear();
  while (fire_timer(decisions)) one_more();
  move_free_variables(decisions);
  const std::string_view before = location(root());
  if (before != "tick_node" || naive_.is_faulty(state_)) return result();
  while (!answer_at(location(root())) && !naive_.is_faulty(state_)) {
    one_more();
    if (fire_timer(decisions)) continue;
    if (!step_nodes(decisions)) throw Disagreement("the tick gets stuck");
  }
  return result();
}

TickResult TickDriver::result() const {
  TickResult told;
  told.events = events_;
  told.fault = naive_.is_faulty(state_);
  for (const VariableId variable : network().state_variable) {
    told.variables.push_back(state_.value(variable));
  }
  for (const VariableId status : network().node_status) {
    told.statuses.push_back(static_cast<NodeStatus>(state_.value(status)));
  }
  told.root = told.statuses[index(tree_.roots.at(0))];
  for (std::size_t a = 0; a < network().automata.size(); ++a) {
    const Automaton& automaton = network().automata[a];
    for (const VariableId local : automaton.locals) {
      told.locals.push_back({automaton.node, network().variable(local).name,
                             state_.value(local)});
    }
    if (automaton.kind != AutomatonKind::Timer) continue;
    told.timers.push_back(
        {automaton.node,
         static_cast<TimerPhase>(state_.value(automaton.location)),
         state_.clocks[a]});
  }
  return told;
}

// --- The comparison ------------------------------------------------------

namespace {

// Decides at random, and remembers what.
Script random_script(const BehaviorTree& tree, SplitMix64& random,
                     Decisions& decisions) {
  const auto one_of = [&random](const auto& allowed) {
    const int count = static_cast<int>(allowed.size());
    return allowed[static_cast<std::size_t>(random.below(count))];
  };
  Script script;
  script.action = [&decisions, one_of](NodeId leaf, auto allowed) {
    const NodeStatus chosen = one_of(allowed);
    decisions.answers[leaf].push_back(
        {{allowed.begin(), allowed.end()}, chosen});
    return chosen;
  };
  script.set_sv = [&decisions, one_of](NodeId node, auto allowed) {
    const int chosen = one_of(allowed);
    decisions.values[node].push_back(
        {{allowed.begin(), allowed.end()}, chosen});
    return chosen;
  };
  script.due = [&decisions, &random](NodeId node, int) {
    decisions.due[node].push_back(random.percent(40));
    return decisions.due[node].back();
  };
  script.free_moves = [&](std::span<int> values) {
    for (std::uint32_t i = 0; i < values.size(); ++i) {
      if (!moves_freely(tree, StateVariableId{i})) continue;
      if (!tree.variables[i].lasting.empty()) continue;
      for (const auto& [from, to] : tree.variables[i].transitions) {
        if (values[i] == from && random.percent(25)) values[i] = to;
      }
    }
    decisions.moved.assign(values.begin(), values.end());
  };
  script.timely_move = [one_of](StateVariableId, auto allowed) {
    return one_of(allowed);
  };
  return script;
}

using NamedValues = std::map<std::string, int>;

// The interpreter's locals under the network's names.
NamedValues expected_locals(const BehaviorTree& tree, const TickResult& told) {
  NamedValues locals;
  for (const LocalValue& local : told.locals) {
    const Node& node = tree.node(local.node);
    const std::string name = unique_name(tree, local.node) + ".";
    if (local.name == "decision") {
      if (node.wait && !node.halt) locals[name + "deciding"] = local.value != 0;
    } else if (local.name == "finished") {
      const bool active =
          told.statuses[index(local.node)] == NodeStatus::Running;
      locals[name + "active"] = active;
      locals[name + "finished"] = local.value;
    } else {
      locals[name + std::string(local.name)] = local.value;
    }
  }
  for (const TimerValue& timer : told.timers) {
    const Node& node = tree.node(timer.node);
    if (node.duration && node.duration->max == 0) continue;
    const std::string name = unique_name(tree, timer.node) + ".";
    locals[name + "timer"] = static_cast<int>(timer.phase);
    locals[name + "elapsed"] = timer.elapsed;
  }
  return locals;
}

NamedValues network_locals(const BehaviorTree& tree, const TickResult& told) {
  NamedValues locals;
  for (const LocalValue& local : told.locals) {
    const std::string name = unique_name(tree, local.node) + ".";
    locals[name + std::string(local.name)] = local.value;
    if (local.name != "active") continue;
    int finished = 0;
    const Node& node = tree.node(local.node);
    for (std::size_t i = 0; i < node.children.size() && local.value; ++i) {
      if (told.statuses[index(node.children[i])] != NodeStatus::Running) {
        finished |= 1 << i;
      }
    }
    locals[name + "finished"] = finished;
  }
  for (const TimerValue& timer : told.timers) {
    const std::string name = unique_name(tree, timer.node) + ".";
    locals[name + "timer"] = static_cast<int>(timer.phase);
    locals[name + "elapsed"] = timer.elapsed;
  }
  return locals;
}

std::string shown(const BehaviorTree& tree,
                  const std::vector<TickEvent>& events) {
  std::string text;
  for (const TickEvent& event : events) {
    text += fmt::format(" {}.{}", unique_name(tree, event.node),
                        event_name(event.kind));
  }
  return text;
}

std::string shown(const NamedValues& values) {
  std::string text;
  for (const auto& [name, value] : values) {
    text += fmt::format(" {}={}", name, value);
  }
  return text;
}

std::string shown(const BehaviorTree& tree,
                  const std::vector<NodeStatus>& statuses) {
  std::string text;
  for (std::uint32_t n = 0; n < statuses.size(); ++n) {
    const auto word = static_cast<std::size_t>(statuses[n]);
    text += fmt::format(
        " {}={}", unique_name(tree, NodeId{n}),
        word < kStatusNames.size() ? kStatusNames[word] : "nothing known");
  }
  return text;
}

// What differs after a tick, "" for nothing.
std::string difference(const BehaviorTree& tree, const TickResult& expected,
                       const TickResult& found) {
  const auto both = [](std::string_view what, const std::string& tree_has,
                       const std::string& network_has) {
    return fmt::format("{}\n  tree:   {}\n  network:{}\n", what, tree_has,
                       network_has);
  };
  if (expected.events != found.events) {
    return both("events", shown(tree, expected.events),
                shown(tree, found.events));
  }
  if (expected.fault != found.fault) return "only one of them has a fault";
  if (expected.variables != found.variables) return "the variables differ";
  if (expected.statuses != found.statuses) {
    return both("statuses", shown(tree, expected.statuses),
                shown(tree, found.statuses));
  }
  if (expected.root != found.root) return "the root's status differs";
  if (expected.fault) return {};
  const NamedValues locals = expected_locals(tree, expected);
  const NamedValues network = network_locals(tree, found);
  return locals == network ? "" : both("locals", shown(locals), shown(network));
}

}  // namespace

std::optional<std::string> first_difference(const BehaviorTree& tree,
                                            const Network& network,
                                            std::uint64_t seed, int ticks,
                                            TickCensus& census) {
  SplitMix64 random(seed);
  Decisions decisions;
  TickInterpreter interpreter(tree, random_script(tree, random, decisions));
  TickDriver driver(tree, network);
  for (int tick = 1; tick <= ticks && !interpreter.fault(); ++tick) {
    decisions = {};
    const TickResult expected = interpreter.tick();
    std::string differs;
    try {
      differs = difference(tree, expected, driver.tick(decisions));
    } catch (const Disagreement& disagreement) {
      differs = disagreement.what();
    }
    if (!differs.empty()) return fmt::format("tick {}: {}", tick, differs);
    ++census.ticks;
    census.events += static_cast<int>(expected.events.size());
    census.faults += expected.fault ? 1 : 0;
    census.halts += static_cast<int>(std::ranges::count(
        expected.events, EventKind::Halted, &TickEvent::kind));
  }
  return std::nullopt;
}

}  // namespace btcheck::reference
