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

Valuation NetworkInterpreter::fired(const Valuation& state,
                                    std::uint32_t number) const {
  const Automaton& automaton = network_.owner_of_edge(number);
  const Edge& edge = network_.edge(number);
  Valuation next = state;
  auto assign = [&](VariableId variable, std::int64_t value) {
    next.variables[index(variable)] = static_cast<int>(value);
    reset_clock_of(next, variable);
  };
  for (const Assignment& update : edge.updates) {
    assign(update.variable, update.value.evaluate([&](const Term& term) {
      return std::int64_t{
          next.variables[static_cast<std::size_t>(term.operand)]};
    }));
  }
  assign(automaton.location, network_.variable(automaton.location).min +
                                 static_cast<int>(index(edge.target)));
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

Valuation NetworkInterpreter::waited(const Valuation& state) const {
  Valuation next = state;
  if (is_faulty(state)) return next;
  for (std::size_t a = 0; a < network_.automata.size(); ++a) {
    const Automaton& automaton = network_.automata[a];
    const int greatest = greatest_clock(automaton, location(automaton, state));
    next.clocks[a] = std::min(next.clocks[a] + 1, greatest);
  }
  return next;
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

Valuation unpacked(const CompiledNetwork& system, const StateVector& words) {
  Valuation state;
  const Network& network = system.network();
  for (std::uint32_t v = 0; v < network.variables.size(); ++v) {
    state.variables.push_back(
        static_cast<int>(system.value(words, VariableId{v})));
  }
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    state.clocks.push_back(
        static_cast<int>(system.clock(words, AutomatonId{a})));
  }
  return state;
}

// Executes a run that was found step by step.
class Replay {
 public:
  Replay(const Network& network, const CompiledNetwork& searched,
         const std::vector<bool>& forgotten, std::string& error)
      : network_(network),
        interpreter_(network),
        searched_(searched),
        forgotten_(forgotten),
        error_(error) {}

  std::optional<Run> of(const Lasso& found);

 private:
  bool is_seen(const Valuation& state, const StateVector& words) const;
  bool take(const Step& step, const StateVector& words);
  bool take_around(const Lasso& found);

  const Network& network_;
  NetworkInterpreter interpreter_;
  const CompiledNetwork& searched_;
  const std::vector<bool>& forgotten_;
  std::string& error_;
  Run run_;
};

// The state is the one that the search saw, as far as it looked.
bool Replay::is_seen(const Valuation& state, const StateVector& words) const {
  Valuation seen = unpacked(searched_, words);
  for (std::size_t v = 0; v < forgotten_.size(); ++v) {
    if (forgotten_[v]) seen.variables[v] = state.variables[v];
  }
  return seen == state;
}

std::string step_name(const Network& network, const Step& step) {
  if (step.edge == kTimeStep) return "a step of time";
  return "an edge of `" + network.owner_of_edge(step.edge).name + "`";
}

bool Replay::take(const Step& step, const StateVector& words) {
  auto next = interpreter_.taken(run_.state(run_.steps.size()), step);
  if (!next || !is_seen(*next, words)) {
    error_ = "step " + std::to_string(run_.steps.size() + 1) + ", " +
             step_name(network_, step) + ", " +
             (next ? "leads elsewhere" : "is not possible") + " when replayed";
    return false;
  }
  run_.steps.push_back({step, std::move(*next)});
  return true;
}

// From the first state of the cycle back to it.
bool Replay::take_around(const Lasso& found) {
  for (std::size_t i = 1; i < found.cycle.size(); ++i) {
    if (!take(found.cycle[i].step, found.cycle[i].state)) return false;
  }
  return take(found.closing, found.cycle.front().state);
}

// What was forgotten depends, after one round, on the steps of that round only:
// the second round ends where it began.
std::optional<Run> Replay::of(const Lasso& found) {
  run_.initial = interpreter_.initial();
  if (!is_seen(run_.initial, found.prefix.front().state)) {
    error_ = "the run does not begin with the initial state";
    return std::nullopt;
  }
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
  error_ = "the loop does not close when replayed";
  return std::nullopt;
}

}  // namespace

std::optional<Run> replay(const CompiledNetwork& system, const Lasso& found,
                          std::string& error) {
  return replay(system.network(), system, {}, found, error);
}

std::optional<Run> replay(const Network& network,
                          const CompiledNetwork& searched,
                          const std::vector<bool>& forgotten,
                          const Lasso& found, std::string& error) {
  return Replay(network, searched, forgotten, error).of(found);
}

}  // namespace btcheck
