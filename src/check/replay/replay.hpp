// SPDX-License-Identifier: MIT
//
// Runs executed again from the network's tables, before anyone sees them.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "check/bind/verdict.hpp"
#include "explore/components/composition.hpp"
#include "explore/reduce/labels.hpp"
#include "explore/state/step.hpp"

namespace btcheck {

// The network interpreted: its tables and expressions as they stand, one
// integer for each variable. Shares no code with the compiled successor
// function beyond the arithmetic of expressions.
class NetworkInterpreter {
 public:
  explicit NetworkInterpreter(const Network& network);

  Valuation initial() const;
  bool may_fire(const Valuation& state, std::uint32_t edge) const;
  // Time may pass by one unit.
  bool may_wait(const Valuation& state) const;
  bool may_take(const Valuation& state, const Step& step) const {
    return step.edge == kTimeStep ? may_wait(state)
                                  : may_fire(state, step.edge);
  }
  // Takes a step that is known to be possible.
  void take(Valuation& state, const Step& step) const;
  Valuation after(Valuation state, const Step& step) const {
    take(state, step);
    return state;
  }
  // The state a step leads to; nothing when it is not possible.
  std::optional<Valuation> taken(const Valuation& state,
                                 const Step& step) const;
  // No step but an idle one.
  bool is_dead(const Valuation& state) const;

  bool is_true(const Expression& condition, const Valuation& state) const;
  bool is_true(const StatePredicate& predicate, const Valuation& state) const;

 private:
  std::int64_t value(const Expression& expression,
                     const Valuation& state) const;
  LocationId location(const Automaton& automaton, const Valuation& state) const;
  // Those that leave the present location.
  std::span<const Edge* const> leaving(const Automaton& automaton,
                                       const Valuation& state) const;
  // The automaton's clock where the edge is enabled, priorities aside: the
  // source active, the guard true, the clock within the interval.
  std::optional<int> clock_of_enabled(const Valuation& state,
                                      const Automaton& automaton,
                                      const Edge& edge) const;
  bool is_faulty(const Valuation& state) const;
  bool some_timer_is_due(const Valuation& state) const;
  void assign(Valuation& state, VariableId variable, std::int64_t to) const;
  void fire(Valuation& state, std::uint32_t edge) const;
  void wait(Valuation& state) const;

  const Network& network_;
  std::vector<const Automaton*> timers_;
  std::vector<std::size_t> clocked_;  // automata: the clocks of others stay 0
  // By variable: the automaton whose location it is, if any.
  std::vector<std::optional<std::size_t>> located_;
  // The edges of each automaton by their sources: of location l of automaton a
  // they stand in by_source_ from first_[first_of_[a] + l] on.
  std::vector<std::size_t> first_of_;
  std::vector<std::size_t> first_;
  std::vector<const Edge*> by_source_;
};

// Executes what a search of a network found, step by step: every state on the
// way must be the one that the search saw.
class Replayer {
 public:
  // Told of each step of the network, and of the state behind it.
  using Taken = std::function<void(const Step&, const Valuation&)>;

  // `searched` may forget some of the network's values: those may differ. It
  // may be made of `parts`: then each of its steps is some of the network's,
  // or none. All must outlive this.
  Replayer(const Network& network, const CompiledNetwork& searched,
           const std::vector<bool>& forgotten,
           const Composition* parts = nullptr);
  // Nothing is forgotten.
  explicit Replayer(const CompiledNetwork& system);

  // False, and `error` says why, where the search has seen something else.
  bool begin(const StateVector& seen);
  bool take(const Step& step, const StateVector& seen, const Taken& taken);
  // What parts do by themselves, until time has to pass, if they come to that.
  void settle(const Taken& taken);
  const Valuation& state() const { return state_; }
  // Goes on from a state that has been executed before.
  void go_on_from(Valuation state) {
    state_ = std::move(state);
    standing_.forget();
  }
  const std::string& error() const { return error_; }

 private:
  bool is_seen(const StateVector& seen);
  bool take_single(const Step& step, const Taken& taken);
  bool take_in_parts(const Step& step, const Taken& taken);
  ComponentTable::Fire firing(const Taken& taken);
  bool failed(const Step& step, const char* how);

  const Network& network_;
  NetworkInterpreter interpreter_;
  const CompiledNetwork& searched_;
  const Composition* parts_;
  Standing standing_;              // of the parts
  std::vector<bool> is_compared_;  // by VariableId: not forgotten
  StateVector compared_;           // the bits of what is not
  Valuation state_;
  Valuation packed_state_;  // an earlier state
  StateVector packed_;      // that one as the search would have it
  std::size_t steps_ = 0;
  std::string error_;
};

// The run that a search found, executed; sets `error` when it cannot be. Where
// values are forgotten, a loop may be told one round later than it was found.
std::optional<Run> replay(Replayer replayer, const Lasso& found,
                          std::string& error);

}  // namespace btcheck
