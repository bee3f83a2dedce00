// SPDX-License-Identifier: MIT
//
// A counterexample that cannot be executed is worse than none. So each run is
// executed step by step from the tables (not from what was compiled from
// them), every state is compared with the one the search stored, and then the
// property itself is evaluated on the states of the run by its definition
// (evidence.cpp). If anything disagrees the answer is an internal error, never
// a verdict.
#include "check/replay/replay.hpp"

#include <algorithm>

namespace btcheck {

Valuation NetworkInterpreter::initial() const {
  Valuation state;
  for (const Variable& variable : network_.variables) {
    state.variables.push_back(variable.initial);
  }
  state.clocks.assign(network_.automata.size(), 0);
  return state;
}

bool NetworkInterpreter::is_true(const Expression& condition,
                                 const Valuation& state) const {
  return condition.evaluate([&](const Term& term) -> std::int64_t {
    return state.variables[static_cast<std::size_t>(term.operand)];
  }) != 0;
}

bool NetworkInterpreter::is_true(const StatePredicate& predicate,
                                 const Valuation& state) const {
  const bool counts_as_dead = predicate.when_dead && is_dead(state);
  return is_true(counts_as_dead ? *predicate.when_dead : predicate.expression,
                 state);
}

LocationId NetworkInterpreter::location(const Automaton& automaton,
                                        const Valuation& state) const {
  const std::size_t variable = index(automaton.location);
  return LocationId{static_cast<std::uint32_t>(
      state.variables[variable] - network_.variables[variable].min)};
}

bool NetworkInterpreter::is_enabled(const Valuation& state,
                                    const Automaton& automaton,
                                    const Edge& edge) const {
  const std::size_t number =
      static_cast<std::size_t>(&automaton - network_.automata.data());
  return location(automaton, state) == edge.source &&
         is_true(edge.guard, state) && state.clocks[number] >= edge.when.lower;
}

bool NetworkInterpreter::has_reached_deadline(const Valuation& state,
                                              const Automaton& automaton,
                                              const Edge& edge) const {
  const std::size_t number =
      static_cast<std::size_t>(&automaton - network_.automata.data());
  return is_enabled(state, automaton, edge) &&
         state.clocks[number] == edge.when.upper;
}

bool NetworkInterpreter::is_faulty(const Valuation& state) const {
  return network_.fault && state.variables[index(*network_.fault)] != 0;
}

bool NetworkInterpreter::some_timer_is_due(const Valuation& state) const {
  for (const Automaton& automaton : network_.automata) {
    if (automaton.kind != AutomatonKind::Timer) continue;
    for (const Edge& edge : automaton.edges) {
      if (has_reached_deadline(state, automaton, edge)) return true;
    }
  }
  return false;
}

bool NetworkInterpreter::may_fire(const Valuation& state,
                                  std::uint32_t number) const {
  const Automaton& automaton = network_.owner_of_edge(number);
  const Edge& edge = network_.edge(number);
  if (is_faulty(state) || !is_enabled(state, automaton, edge)) return false;
  if (!some_timer_is_due(state)) return true;
  return automaton.kind == AutomatonKind::Timer &&
         has_reached_deadline(state, automaton, edge);
}

void NetworkInterpreter::reset_clock_of(Valuation& state,
                                        VariableId location) const {
  for (std::size_t a = 0; a < network_.automata.size(); ++a) {
    if (network_.automata[a].location == location) state.clocks[a] = 0;
  }
}

void NetworkInterpreter::fire(Valuation& state, std::uint32_t number) const {
  const Automaton& automaton = network_.owner_of_edge(number);
  const Edge& edge = network_.edge(number);
  auto assign = [&](VariableId variable, std::int64_t value) {
    state.variables[index(variable)] = static_cast<int>(value);
    reset_clock_of(state, variable);
  };
  for (const Assignment& update : edge.updates) {
    assign(update.variable, update.value.evaluate([&](const Term& term) {
      return std::int64_t{
          state.variables[static_cast<std::size_t>(term.operand)]};
    }));
  }
  assign(automaton.location, network_.variable(automaton.location).min +
                                 static_cast<int>(index(edge.target)));
}

Valuation NetworkInterpreter::fired(const Valuation& state,
                                    std::uint32_t number) const {
  Valuation next = state;
  fire(next, number);
  return next;
}

bool NetworkInterpreter::may_wait(const Valuation& state) const {
  if (is_faulty(state)) return true;
  const bool is_untimed = network_.ticks == TickSemantics::None;
  for (const Automaton& automaton : network_.automata) {
    const bool is_free = automaton.kind == AutomatonKind::StateVariable;
    for (const Edge& edge : automaton.edges) {
      if (is_untimed ? !is_free && is_enabled(state, automaton, edge)
                     : has_reached_deadline(state, automaton, edge)) {
        return false;
      }
    }
  }
  return true;
}

// Told again and not asked of Interval::greatest_clock: were that one wrong,
// the search and its replay would agree on the mistake.
int NetworkInterpreter::greatest_clock(const Automaton& automaton,
                                       LocationId location) const {
  int greatest = 0;
  for (const Edge& edge : automaton.edges) {
    if (edge.source != location || !edge.when.needs_clock()) continue;
    greatest =
        std::max(greatest, edge.when.upper == kUnbounded ? edge.when.lower
                                                         : edge.when.upper);
  }
  return greatest;
}

void NetworkInterpreter::wait(Valuation& state) const {
  if (is_faulty(state)) return;
  for (std::size_t a = 0; a < network_.automata.size(); ++a) {
    const Automaton& automaton = network_.automata[a];
    const int greatest = greatest_clock(automaton, location(automaton, state));
    state.clocks[a] = std::min(state.clocks[a] + 1, greatest);
  }
}

Valuation NetworkInterpreter::waited(const Valuation& state) const {
  Valuation next = state;
  wait(next);
  return next;
}

void NetworkInterpreter::take(Valuation& state, const Step& step) const {
  if (step.edge == kTimeStep) {
    wait(state);
  } else {
    fire(state, step.edge);
  }
}

std::optional<Valuation> NetworkInterpreter::taken(const Valuation& state,
                                                   const Step& step) const {
  if (step.edge == kTimeStep) {
    return may_wait(state) ? std::optional(waited(state)) : std::nullopt;
  }
  return may_fire(state, step.edge) ? std::optional(fired(state, step.edge))
                                    : std::nullopt;
}

bool NetworkInterpreter::is_dead(const Valuation& state) const {
  for (std::uint32_t edge = 0; edge < network_.edge_count(); ++edge) {
    if (may_fire(state, edge)) return false;
  }
  return !may_wait(state) || waited(state) == state;
}

namespace {

std::string step_name(const Network& network, const Step& step) {
  if (step.edge == kTimeStep) return "a step of time";
  return "an edge of `" + network.owner_of_edge(step.edge).name + "`";
}

// Collects the run that is executed.
class Replay {
 public:
  explicit Replay(Replayer& replayer) : replayer_(replayer) {}

  std::optional<Run> of(const Lasso& found);

 private:
  bool take(const Step& step, const StateVector& words) {
    if (!replayer_.take(step, words)) return false;
    run_.steps.push_back({step, replayer_.state()});
    return true;
  }
  // From the first state of the cycle back to it.
  bool take_around(const Lasso& found) {
    for (std::size_t i = 1; i < found.cycle.size(); ++i) {
      if (!take(found.cycle[i].step, found.cycle[i].state)) return false;
    }
    return take(found.closing, found.cycle.front().state);
  }

  Replayer& replayer_;
  Run run_;
};

// What was forgotten depends, after one round, on the steps of that round only:
// the second round ends where it began.
std::optional<Run> Replay::of(const Lasso& found) {
  if (!replayer_.begin(found.prefix.front().state)) return std::nullopt;
  run_.initial = replayer_.state();
  for (std::size_t i = 1; i < found.prefix.size(); ++i) {
    if (!take(found.prefix[i].step, found.prefix[i].state)) return std::nullopt;
  }
  if (found.cycle.empty()) return std::move(run_);
  if (!take(found.cycle.front().step, found.cycle.front().state)) {
    return std::nullopt;
  }
  for (int round = 0; round < 2; ++round) {
    run_.loop = run_.steps.size();
    if (!take_around(found)) return std::nullopt;
    if (run_.state(run_.loop) == run_.steps.back().after) {
      return std::move(run_);
    }
  }
  return std::nullopt;
}

}  // namespace

// The state is the one that the search saw, as far as it looked.
bool Replayer::is_seen(const StateVector& words) const {
  for (std::uint32_t v = 0; v < state_.variables.size(); ++v) {
    const bool is_forgotten = forgotten_ && (*forgotten_)[v];
    if (!is_forgotten &&
        searched_.value(words, VariableId{v}) != state_.variables[v]) {
      return false;
    }
  }
  for (std::uint32_t a = 0; a < state_.clocks.size(); ++a) {
    if (searched_.clock(words, AutomatonId{a}) != state_.clocks[a])
      return false;
  }
  return true;
}

bool Replayer::begin(const StateVector& seen) {
  state_ = interpreter_.initial();
  steps_ = 0;
  if (is_seen(seen)) return true;
  error_ = "the run does not begin with the initial state";
  return false;
}

bool Replayer::take(const Step& step, const StateVector& seen) {
  ++steps_;
  auto next = interpreter_.taken(state_, step);
  const bool is_possible = next.has_value();
  if (next) state_ = std::move(*next);
  if (is_possible && is_seen(seen)) return true;
  error_ = "step " + std::to_string(steps_) + ", " + step_name(network_, step) +
           ", " + (is_possible ? "leads elsewhere" : "is not possible") +
           " when replayed";
  return false;
}

std::optional<Run> replay(Replayer replayer, const Lasso& found,
                          std::string& error) {
  auto run = Replay(replayer).of(found);
  if (!run) {
    error = replayer.error().empty() ? "the loop does not close when replayed"
                                     : replayer.error();
  }
  return run;
}

}  // namespace btcheck
