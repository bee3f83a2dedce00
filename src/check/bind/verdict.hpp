// SPDX-License-Identifier: MIT
//
// What a check answers: three-valued verdicts, and the runs that show them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "explore/state/limits.hpp"
#include "explore/state/transition_system.hpp"
#include "explore/state/valuation.hpp"
#include "ltl/rules/property.hpp"
#include "model/automata/network.hpp"
#include "model/tree/expression.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

enum class Verdict : std::uint8_t { Holds, Violated, Undecided };

// A step of a run and the state it leads to.
struct RunStep {
  Step step;
  Valuation after;
};

inline constexpr std::size_t kNoLoop = static_cast<std::size_t>(-1);

// A run of the network, replayed from its tables. State 0 is `initial`, state
// k + 1 is steps[k].after. With a loop, the last state equals state `loop` and
// the run goes on from there for ever.
struct Run {
  Valuation initial;
  std::vector<RunStep> steps;
  std::size_t loop = kNoLoop;

  std::size_t state_count() const { return steps.size() + 1; }
  const Valuation& state(std::size_t i) const {
    return i == 0 ? initial : steps[i - 1].after;
  }
  std::span<const RunStep> loop_steps() const {
    return loop == kNoLoop ? std::span<const RunStep>()
                           : std::span(steps).subspan(loop);
  }
  // Calls visit(state before, step) for each step, in order.
  template <class Visit>
  void walk(Visit&& visit) const {
    for (std::size_t i = 0; i < steps.size(); ++i) visit(state(i), steps[i]);
  }
};

// What a property speaks of, for who explains a run to its author.
struct Subjects {
  std::vector<NodeId> nodes;    // whose events or status it names, ascending
  std::vector<NodeId> awaited;  // of these, those an answer is waited from
  std::vector<StateVariableId> variables;  // whose value it names, ascending
};

// A part of a property whose truth does not matter for its verdict.
struct VacuousPart {
  std::string text;         // as written
  bool as_if_true = false;  // it would hold if this were always so; else: never
  bool is_scope = false;    // it bounds the scope of a pattern
};

// A part of a property along a run: whether it is true, state by state. What is
// said of a step is said of the state it leads to.
struct WatchedPart {
  std::string text;
  std::vector<bool> at;
};

// An atom about blackboard entries that is not known in every state, because
// some stand for values it holds of and for others.
struct OpenComparison {
  Expression where;  // it is not known
  std::vector<StateVariableId> entries;
  Diagnostic refusal;  // "whether `y == 3` is not known where `y` is any"
};

// The answer for one property.
struct PropertyVerdict {
  const Property* property = nullptr;
  Verdict verdict = Verdict::Undecided;
  StopReason stopped = StopReason::None;  // why it is undecided
  SearchProgress progress;
  // The counterexample, or for `possible` the witness.
  std::optional<Run> run;
  std::vector<WatchedPart> watched;  // along that run
  // Branching: what no single run shows, said of the last state of `run`.
  std::string unshown;
  // While it is judged, under assumptions: the state of an infinite run by
  // which a rule is broken, or a `possible` shown. `check` ends the run there.
  std::optional<std::size_t> shown_at;
  // Timed: the state of the run with the occurrence that violates it.
  std::size_t trigger_state = 0;
  // Timed that holds: the longest time an answer took, -1 for none.
  int longest_answer = -1;
  // Holds: how many states have the trigger, the P of `P leadsto Q` or of
  // `[] (P => …)`; nothing where there is none.
  std::optional<std::uint64_t> triggers;
  // Holds: what never happens, so that nothing was asked; "" when it was.
  std::string idle;
  std::vector<VacuousPart> vacuous;  // holds whatever these are
  bool no_run = false;               // holds: no run satisfies the assumptions
  Subjects subjects;
  std::vector<OpenComparison> comparisons;  // of it and of the assumptions
  // Undecided, StopReason::OpenEntries: what is not known, in words.
  std::string open;
  std::string error;  // set when a run could not be replayed: our mistake

  // It holds because what it is about never happens.
  bool is_vacuous() const {
    const auto is_idle = [](const VacuousPart& part) {
      return !part.as_if_true && !part.is_scope;
    };
    return verdict == Verdict::Holds &&
           (no_run || !idle.empty() || std::ranges::any_of(vacuous, is_idle));
  }
  bool met_expectation() const {
    if (verdict == Verdict::Undecided) return true;
    const bool holds = verdict == Verdict::Holds;
    return holds == (property->expectation != Expectation::Violated);
  }
};

}  // namespace btcheck
