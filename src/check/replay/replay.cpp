// SPDX-License-Identifier: MIT
//
// A counterexample that cannot be executed is worse than none. So each run is
// executed from the tables, not from what was compiled from them, and every
// state is compared with the one that the search stored. Then the property is
// evaluated on the run (evidence.cpp). A disagreement is an internal error,
// never a verdict.
#include "check/replay/replay.hpp"

#include <algorithm>
#include <numeric>

namespace btcheck {
namespace {

std::string step_name(const Network& network, const Step& step) {
  if (step.edge == kTimeStep) return "a step of time";
  return "an edge of `" + network.owner_of_edge(step.edge).name + "`";
}

// Copies the numbers, and calls differs(place) for those that are new; the
// places are compared a few at a time.
template <class Differs>
void take_over(const std::vector<int>& from, std::vector<int>& to,
               Differs&& differs) {
  constexpr std::size_t kTogether = 32;
  const bool is_first = to.empty();
  to.resize(from.size());
  for (std::size_t begin = 0; begin < from.size(); begin += kTogether) {
    const std::size_t end = std::min(begin + kTogether, from.size());
    if (!is_first && std::equal(&from[begin], &from[end - 1] + 1, &to[begin])) {
      continue;
    }
    for (std::size_t i = begin; i < end; ++i) {
      if (!is_first && from[i] == to[i]) continue;
      to[i] = from[i];
      differs(i);
    }
  }
}

}  // namespace

NetworkInterpreter::NetworkInterpreter(const Network& network)
    : network_(network), located_(network.variables.size()) {
  for (std::size_t a = 0; a < network.automata.size(); ++a) {
    const Automaton& automaton = network.automata[a];
    located_[index(automaton.location)] = a;
    if (automaton.kind == AutomatonKind::Timer) timers_.push_back(&automaton);
    const bool is_clocked = std::ranges::any_of(
        automaton.edges,
        [](const Edge& edge) { return edge.when.needs_clock(); });
    if (is_clocked) clocked_.push_back(a);
    first_of_.push_back(first_.size());
    std::vector<std::size_t> count(automaton.locations.size() + 1, 0);
    for (const Edge& edge : automaton.edges) ++count[index(edge.source)];
    std::exclusive_scan(count.begin(), count.end(), count.begin(),
                        by_source_.size());
    first_.insert(first_.end(), count.begin(), count.end());
    by_source_.resize(count.back());
    for (const Edge& edge : automaton.edges) {
      by_source_[count[index(edge.source)]++] = &edge;
    }
  }
}

std::span<const Edge* const> NetworkInterpreter::leaving(
    const Automaton& automaton, const Valuation& state) const {
  const auto number =
      static_cast<std::size_t>(&automaton - network_.automata.data());
  const std::size_t here = index(location(automaton, state));
  if (here >= automaton.locations.size()) return {};
  const std::size_t* first = &first_[first_of_[number] + here];
  return {by_source_.data() + first[0], by_source_.data() + first[1]};
}

Valuation NetworkInterpreter::initial() const {
  Valuation state;
  for (const Variable& variable : network_.variables) {
    state.variables.push_back(variable.initial);
  }
  state.clocks.assign(network_.automata.size(), 0);
  return state;
}

std::int64_t NetworkInterpreter::value(const Expression& expression,
                                       const Valuation& state) const {
  return expression.evaluate([&](const Term& term) -> std::int64_t {
    return state.variables[static_cast<std::size_t>(term.operand)];
  });
}

bool NetworkInterpreter::is_true(const Expression& condition,
                                 const Valuation& state) const {
  return value(condition, state) != 0;
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

std::optional<int> NetworkInterpreter::clock_of_enabled(
    const Valuation& state, const Automaton& automaton,
    const Edge& edge) const {
  const int clock = state.clocks[static_cast<std::size_t>(
      &automaton - network_.automata.data())];
  const bool is_enabled = location(automaton, state) == edge.source &&
                          is_true(edge.guard, state) &&
                          clock >= edge.when.lower;
  return is_enabled ? std::optional(clock) : std::nullopt;
}

bool NetworkInterpreter::is_faulty(const Valuation& state) const {
  return network_.fault && state.variables[index(*network_.fault)] != 0;
}

bool NetworkInterpreter::some_timer_is_due(const Valuation& state) const {
  for (const Automaton* timer : timers_) {
    for (const Edge* edge : leaving(*timer, state)) {
      if (clock_of_enabled(state, *timer, *edge) == edge->when.upper) {
        return true;
      }
    }
  }
  return false;
}

bool NetworkInterpreter::may_fire(const Valuation& state,
                                  std::uint32_t number) const {
  const Automaton& automaton = network_.owner_of_edge(number);
  const Edge& edge = network_.edge(number);
  if (is_faulty(state)) return false;
  const auto clock = clock_of_enabled(state, automaton, edge);
  if (!clock) return false;
  return (automaton.kind == AutomatonKind::Timer && clock == edge.when.upper) ||
         !some_timer_is_due(state);
}

void NetworkInterpreter::assign(Valuation& state, VariableId variable,
                                std::int64_t to) const {
  state.variables[index(variable)] = static_cast<int>(to);
  if (const auto automaton = located_[index(variable)]) {
    state.clocks[*automaton] = 0;
  }
}

void NetworkInterpreter::fire(Valuation& state, std::uint32_t number) const {
  const Automaton& automaton = network_.owner_of_edge(number);
  const Edge& edge = network_.edge(number);
  for (const Assignment& update : edge.updates) {
    assign(state, update.variable, value(update.value, state));
  }
  assign(state, automaton.location,
         network_.variable(automaton.location).min +
             static_cast<int>(index(edge.target)));
}

bool NetworkInterpreter::may_wait(const Valuation& state) const {
  if (is_faulty(state)) return true;
  const bool is_untimed = network_.ticks == TickSemantics::None;
  for (const Automaton& automaton : network_.automata) {
    if (is_untimed && automaton.kind == AutomatonKind::StateVariable) continue;
    for (const Edge* edge : leaving(automaton, state)) {
      const auto clock = clock_of_enabled(state, automaton, *edge);
      if (clock && (is_untimed || clock == edge->when.upper)) return false;
    }
  }
  return true;
}

// The greatest clock of a location is told again and not asked of
// Interval::greatest_clock: were that one wrong, the search and its replay
// would agree on the mistake.
void NetworkInterpreter::wait(Valuation& state) const {
  if (is_faulty(state)) return;
  for (const std::size_t a : clocked_) {
    const Automaton& automaton = network_.automata[a];
    const LocationId here = location(automaton, state);
    int greatest = 0;
    for (const Edge& edge : automaton.edges) {
      const auto [lower, upper] = edge.when;
      if (edge.source != here || !edge.when.needs_clock()) continue;
      greatest = std::max(greatest, upper == kUnbounded ? lower : upper);
    }
    state.clocks[a] = std::min(state.clocks[a] + 1, greatest);
  }
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
  return may_take(state, step) ? std::optional(after(state, step))
                               : std::nullopt;
}

bool NetworkInterpreter::is_dead(const Valuation& state) const {
  for (std::uint32_t edge = 0; edge < network_.edge_count(); ++edge) {
    if (may_fire(state, edge)) return false;
  }
  return !may_wait(state) || after(state, kIdleStep) == state;
}

Replayer::Replayer(const Network& network, const CompiledNetwork& searched,
                   const std::vector<bool>& forgotten, const Composition* parts)
    : network_(network),
      interpreter_(network),
      searched_(searched),
      parts_(parts),
      is_compared_(network.variables.size(), true),
      compared_(searched.layout().words),
      packed_(searched.layout().words) {
  const StateLayout& layout = searched.layout();
  for (std::size_t v = 0; v < is_compared_.size(); ++v) {
    is_compared_[v] =
        !forgotten[v] && (parts == nullptr || !parts->hidden()[v]);
    const Field& field = layout.fields[v];
    if (is_compared_[v]) compared_[field.word] |= field.mask();
  }
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    const std::optional<Field>& clock = layout.clocks[a];
    if (clock) compared_[clock->word] |= clock->mask();
  }
}

Replayer::Replayer(const CompiledNetwork& system)
    : Replayer(system.network(), system,
               std::vector<bool>(system.network().variables.size())) {}

// The state is the one that the search saw, as far as it looked. What has not
// changed since the last one is packed already.
bool Replayer::is_seen(const StateVector& seen) {
  const StateLayout& layout = searched_.layout();
  const auto pack = [&](const std::optional<Field>& field, int value) {
    if (!field) return value == 0;
    field->put(packed_.data(), value);
    return field->get(packed_.data()) == value;
  };
  bool fits = true;
  take_over(state_.variables, packed_state_.variables, [&](std::size_t v) {
    if (!is_compared_[v]) return;
    fits = fits && pack(layout.fields[v], state_.variables[v]);
  });
  take_over(state_.clocks, packed_state_.clocks, [&](std::size_t a) {
    const AutomatonId id{static_cast<std::uint32_t>(a)};
    if (parts_ != nullptr && !parts_->stands(id)) return;
    fits = fits && pack(layout.clocks[a], state_.clocks[a]);
  });
  for (std::size_t w = 0; w < seen.size() && fits; ++w) {
    fits = ((packed_[w] ^ seen[w]) & compared_[w]) == 0;
  }
  return fits;
}

bool Replayer::begin(const StateVector& seen) {
  go_on_from(interpreter_.initial());
  steps_ = 0;
  if (is_seen(seen)) return true;
  error_ = "the run does not begin with the initial state";
  return false;
}

bool Replayer::take_single(const Step& step, const Taken& taken) {
  if (!interpreter_.may_take(state_, step)) return false;
  interpreter_.take(state_, step);
  taken(step, state_);
  return true;
}

ComponentTable::Fire Replayer::firing(const Taken& taken) {
  return [&](std::uint32_t edge) {
    const bool is_free =
        network_.owner_of_edge(edge).kind == AutomatonKind::StateVariable;
    return take_single({edge, 0, !is_free}, taken);
  };
}

// Timers inside of components are taken as soon as they can be.
bool Replayer::take_in_parts(const Step& step, const Taken& taken) {
  const auto fire = firing(taken);
  if (step.edge != kTimeStep) {
    return parts_->take(state_, step.edge, fire, standing_);
  }
  if (!parts_->settle(state_, fire, standing_) || !take_single(step, taken)) {
    return false;
  }
  for (bool fired = true; fired;) {
    fired = std::ranges::any_of(parts_->hidden_timers(), fire);
  }
  standing_.forget();
  return true;
}

void Replayer::settle(const Taken& taken) {
  if (parts_ != nullptr) parts_->settle(state_, firing(taken), standing_);
}

bool Replayer::take(const Step& step, const StateVector& seen,
                    const Taken& taken) {
  ++steps_;
  const bool is_possible =
      parts_ == nullptr ? take_single(step, taken) : take_in_parts(step, taken);
  if (!is_possible) return failed(step, "is not possible");
  return is_seen(seen) || failed(step, "leads elsewhere");
}

bool Replayer::failed(const Step& step, const char* how) {
  error_ = "step " + std::to_string(steps_) + ", " +
           step_name(searched_.network(), step) + ", " + how + " when replayed";
  return false;
}

// What was forgotten depends, after one round of a loop, on the steps of that
// round only: the second round ends where it began. What stands inside of parts
// may take some rounds more to come back to where it was.
std::optional<Run> replay(Replayer replayer, const Lasso& found,
                          std::string& error) {
  constexpr std::size_t kMostRounds = 64;
  Run run;
  const auto take = [&](const Step& step, const StateVector& words) {
    return replayer.take(step, words,
                         [&](const Step& single, const Valuation& after) {
                           run.steps.push_back({single, after});
                         });
  };
  const auto take_from_first = [&](const std::vector<RunState>& way) {
    return std::all_of(way.begin() + 1, way.end(), [&](const RunState& each) {
      return take(each.step, each.state);
    });
  };
  if (replayer.begin(found.prefix.front().state)) {
    run.initial = replayer.state();
    bool goes_on = take_from_first(found.prefix);
    if (goes_on && found.cycle.empty()) return run;
    goes_on =
        goes_on && take(found.cycle.front().step, found.cycle.front().state);
    std::vector<std::size_t> rounds;
    for (std::size_t round = 0; round < kMostRounds && goes_on; ++round) {
      rounds.push_back(run.steps.size());
      goes_on = take_from_first(found.cycle) &&
                take(found.closing, found.cycle.front().state);
      if (!goes_on) break;
      for (const std::size_t begin : rounds) {
        if (run.state(begin) != replayer.state()) continue;
        run.loop = begin;
        return run;
      }
    }
  }
  error = replayer.error().empty() ? "the loop does not close when replayed"
                                   : replayer.error();
  return std::nullopt;
}

}  // namespace btcheck
