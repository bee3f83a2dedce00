// SPDX-License-Identifier: MIT
//
// A tick is a unit of time and all steps that take none. A leaf is asked when
// its automaton has come to where the model leaves the answer open; answers.cpp
// says what becomes of the reply.
#include "run/engine/tree_engine.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "model/tree/node_types.hpp"

namespace btcheck {

TreeEngine::TreeEngine(const BehaviorTree& tree, const CompiledNetwork& system,
                       Leaves& leaves, OnBreach policy)
    : tree_(tree),
      system_(system),
      leaves_(leaves),
      policy_(policy),
      table_(tree, system),
      ticks_of_(tree.nodes.size(), 0),
      flights_(tree.nodes.size()),
      order_(post_order(tree)) {
  assert(system.network().ticks == TickSemantics::Root);
  system.initial_states(
      [&](StateView state) { state_.assign(state.begin(), state.end()); });
  std::size_t most = 0;
  for (const Automaton& automaton : system.network().automata) {
    most = std::max(most, automaton.edges.size());
  }
  enabled_.reserve(most);
  candidate_.reserve(most);
  possible_.reserve(most);
}

void TreeEngine::begin() {
  for (EngineObserver* observer : observers_) observer->began(now());
  settle();
}

EngineState TreeEngine::tick() {
  assert(end_ == EngineState::Ready);
  let_time_pass();
  settle();
  return end_;
}

void TreeEngine::stop() {
  for (const NodeId node : order_) {
    if (!std::exchange(flights_[index(node)].runs, false)) continue;
    leaves_.halt(node);
    for (EngineObserver* observer : observers_) observer->stopped(node);
  }
  leaves_.await_halted();
  hear_complaints();
}

// Takes all steps that take no time.
void TreeEngine::settle() {
  while (end_ == EngineState::Ready && step()) {
  }
  if (end_ == EngineState::Ready && is_over()) end_ = EngineState::Ended;
}

// False where no node can go on before time passes.
bool TreeEngine::step() {
  if (const auto timer = due_timer()) {
    fire(*timer);
    return true;
  }
  const auto mover = first_mover();
  if (!mover) return false;
  const EdgeFacts& first = table_.edge(enabled_[0]);
  if (first.is_root && first.source == LocationRole::Tick) {
    begin_tick(enabled_[0]);
  } else if (first.is_answer) {
    decide(system_.network().automaton(*mover).node);
  } else {
    fire(enabled_[0]);
  }
  return true;
}

// A timer that has reached its deadline goes before everything else.
std::optional<std::uint32_t> TreeEngine::due_timer() {
  for (const AutomatonId timer : table_.timers()) {
    collect(timer, candidate_);
    for (const std::uint32_t place : candidate_) {
      if (system_.clock(now(), timer) == table_.edge(place).when.upper) {
        return place;
      }
    }
  }
  return std::nullopt;
}

// The node with the least process number that can go on; enabled_ has its
// edges.
std::optional<AutomatonId> TreeEngine::first_mover() {
  std::optional<AutomatonId> first;
  system_.for_each_open(now(), [&](AutomatonId open) {
    if (first && index(*first) < index(open)) return GoOn::Yes;
    if (system_.network().automaton(open).kind != AutomatonKind::Node) {
      return GoOn::Yes;
    }
    collect(open, candidate_);
    if (!candidate_.empty()) {
      first = open;
      std::swap(candidate_, enabled_);
    }
    return GoOn::Yes;
  });
  return first;
}

// Its edges that may be taken now.
void TreeEngine::collect(AutomatonId automaton,
                         std::vector<std::uint32_t>& places) const {
  places.clear();
  const std::int64_t clock = system_.clock(now(), automaton);
  system_.open_edges(now(), automaton, [&](std::uint32_t place) {
    if (table_.edge(place).when.lower <= clock) places.push_back(place);
  });
}

void TreeEngine::begin_tick(std::uint32_t place) {
  const Automaton& root = system_.network().automaton(table_.edge(place).owner);
  if (root.node == tree_.roots.front()) {
    hear_complaints();
    move_variables();
  }
  if (end_ != EngineState::Ready) return;
  int& ticks = ticks_of_[index(root.node)];
  ticks_ = std::max(ticks_, ++ticks);
  fire(place);
}

void TreeEngine::move_variables() {
  while (end_ == EngineState::Ready) {
    const auto wanted = leaves_.next_move(ticks_ + 1, now());
    if (!wanted) return;
    if (move(*wanted)) continue;
    const StateVariable& variable = tree_.variable(wanted->variable);
    const VariableId id =
        system_.network().state_variable[index(wanted->variable)];
    const int now_at = static_cast<int>(system_.value(now(), id));
    report({BreachKind::Forbidden, std::nullopt, ticks_ + 1,
            "`" + variable.name + "` became " +
                variable.value_name(wanted->value) +
                ", which :transitions exclude from " +
                variable.value_name(now_at) + " at this time; it stays"});
    if (policy_ == OnBreach::Stop) end_ = EngineState::Breached;
  }
}

// False where no edge leads there.
bool TreeEngine::move(const VariableMove& wanted) {
  const auto automaton =
      system_.network().state_automaton[index(wanted.variable)];
  const VariableId id =
      system_.network().state_variable[index(wanted.variable)];
  if (system_.value(now(), id) == wanted.value) return true;
  if (!automaton) return false;
  collect(*automaton, candidate_);
  for (const std::uint32_t place : candidate_) {
    if (table_.edge(place).result != wanted.value) continue;
    fire(place);
    return true;
  }
  return false;
}

void TreeEngine::fire(std::uint32_t place) {
  const EdgeFacts& edge = table_.edge(place);
  const Automaton& owner = system_.network().automaton(edge.owner);
  const bool is_node = owner.kind == AutomatonKind::Node;
  if (is_node && is_started(edge, owner.node)) {
    table_.give_arguments(owner.node, now());
  }
  system_.fire(place, state_);
  const Step step{edge.number, 0, owner.kind != AutomatonKind::StateVariable};
  for (EngineObserver* observer : observers_) observer->stepped(now(), step);
  if (is_node) note(edge);
}

// A leaf is ticked that does not run: it gets its arguments, and keeps them.
bool TreeEngine::is_started(const EdgeFacts& edge, NodeId node) const {
  const VariableId status = system_.network().node_status[index(node)];
  return edge.target == LocationRole::Tick && table_.has_leaf(node) &&
         system_.value(now(), status) !=
             static_cast<std::int64_t>(NodeStatus::Running);
}

void TreeEngine::note(const EdgeFacts& edge) {
  if (edge.target == LocationRole::Error) end_ = EngineState::Fault;
  const NodeId node = system_.network().automaton(edge.owner).node;
  const bool is_halted =
      edge.source == LocationRole::Start && edge.target == LocationRole::Halt;
  if (!is_halted || !table_.has_leaf(node)) return;
  if (flights_[index(node)].runs) leaves_.halt(node);
  flights_[index(node)] = {};
}

// A variable that has lasted as long as it may moves, along its first
// transition, though nobody has told that it has.
void TreeEngine::move_overdue() {
  for (const auto& automaton : system_.network().state_automaton) {
    if (!automaton || !system_.layout().clocks[index(*automaton)]) continue;
    collect(*automaton, candidate_);
    const std::int64_t clock = system_.clock(now(), *automaton);
    const bool is_due =
        std::ranges::any_of(candidate_, [&](std::uint32_t place) {
          return table_.edge(place).when.upper == clock;
        });
    if (!is_due) continue;
    const std::uint32_t place = candidate_[0];
    if (!leaves_.lets_variables_move()) {
      const StateVariable& variable = tree_.variable(
          system_.network().automaton(*automaton).state_variable);
      report({BreachKind::TooLate, std::nullopt, ticks_,
              "`" + variable.name + "` has lasted longer than :transitions " +
                  "allow; it becomes " +
                  variable.value_name(table_.edge(place).result)});
      if (policy_ == OnBreach::Stop) {
        end_ = EngineState::Breached;
        return;
      }
    }
    fire(place);
  }
}

// Where time changes nothing either, nothing ever will.
void TreeEngine::let_time_pass() {
  move_overdue();
  if (end_ != EngineState::Ready) return;
  bool is_idle = true;
  system_.successors(now(), [&](StateView target, const Step& step) {
    if (step.edge != kTimeStep) return;
    is_idle = std::equal(target.begin(), target.end(), state_.begin());
    if (!is_idle) candidate_words_.assign(target.begin(), target.end());
  });
  if (is_idle) {
    end_ = EngineState::Stuck;
    return;
  }
  std::swap(state_, candidate_words_);
  for (EngineObserver* observer : observers_) {
    observer->stepped(now(), kIdleStep);
  }
}

// Every root has answered for ever.
bool TreeEngine::is_over() const {
  return std::ranges::all_of(tree_.roots, [&](NodeId root) {
    const AutomatonId automaton = system_.network().node_automaton[index(root)];
    return table_.is_over(automaton, system_.location(now(), automaton));
  });
}

void TreeEngine::hear_complaints() {
  while (auto heard = leaves_.complaint()) {
    report({heard->kind, heard->node, ticks_, std::move(heard->text)});
    if (policy_ == OnBreach::Stop) end_ = EngineState::Breached;
  }
}

void TreeEngine::report(Breach breach) {
  ++breaches_;
  for (EngineObserver* observer : observers_) observer->breached(breach);
}

}  // namespace btcheck
