// SPDX-License-Identifier: MIT
//
// What a check answers: three-valued verdicts, and the runs that show them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "explore/limits.hpp"
#include "explore/transition_system.hpp"
#include "ltl/property.hpp"
#include "model/network.hpp"

namespace btcheck {

enum class Verdict : std::uint8_t { Holds, Violated, Undecided };

// One global state, unpacked.
struct Valuation {
  std::vector<int> variables;  // by VariableId
  std::vector<int> clocks;     // by AutomatonId; 0 where none runs

  friend bool operator==(const Valuation&, const Valuation&) = default;
};

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
};

// The answer for one property.
struct PropertyVerdict {
  const Property* property = nullptr;
  Verdict verdict = Verdict::Undecided;
  StopReason stopped = StopReason::None;  // why it is undecided
  SearchProgress progress;
  // The counterexample, or for `possible` the witness.
  std::optional<Run> run;
  // Response: the state of the run that is not answered.
  std::size_t trigger_state = 0;
  // Response that holds: the longest time an answer took, -1 for never asked.
  int longest_answer = -1;
  std::string error;  // set when a run could not be replayed: our mistake

  bool met_expectation() const {
    if (verdict == Verdict::Undecided) return true;
    const bool holds = verdict == Verdict::Holds;
    return holds == (property->expectation != Expectation::Violated);
  }
};

}  // namespace btcheck
