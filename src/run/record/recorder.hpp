// SPDX-License-Identifier: MIT
//
// A run of an engine, kept and told while it goes on.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "check/bind/verdict.hpp"
#include "explore/state/step.hpp"
#include "model/tree/tree.hpp"
#include "run/engine/tree_engine.hpp"
#include "trace/formats/text.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

struct TreeInput;

// The state of a network as the replay has it.
Valuation unpacked(const CompiledNetwork& system, StateView state);

// Keeps the steps: eight bytes each.
class RunRecorder : public EngineObserver {
 public:
  void stepped(StateView, const Step& step) override { steps_.push_back(step); }

  const std::vector<Step>& steps() const { return steps_; }
  // The first `most` steps executed once more from the network's tables.
  // Nothing where they cannot be: our mistake.
  std::optional<Run> replayed(const Network& network,
                              std::size_t most = kNoLoop) const;

 private:
  std::vector<Step> steps_;
};

// What is said of a run beside its states.
RunWords run_words(const std::string& how);

// The run as it is kept: `how` it was made, "run by engine". Of a long one the
// first steps, as many as `trace` reads again. Nothing where they cannot be
// executed: our mistake.
std::optional<RecordedRun> kept_run(const BehaviorTree& tree,
                                    const Network& network,
                                    const TreeInput& input,
                                    const RunRecorder& recorder,
                                    const std::string& how);

// How a run has ended, in words: "the tree ended with success in tick 3".
std::string engine_end_text(const TreeEngine& engine);

// Tells the lines of ticks (trace/formats/text.hpp), each as soon as its tick
// is over.
class TickTeller : public EngineObserver {
 public:
  using Told = std::function<void(const std::string& line)>;
  TickTeller(const BehaviorTree& tree, const CompiledNetwork& system,
             Told told);

  void began(StateView state) override { last_ = unpacked(system_, state); }
  void stepped(StateView after, const Step& step) override;
  // The lines of ticks that have begun and not ended.
  std::string rest() const { return lines_.rest(last_); }

 private:
  const CompiledNetwork& system_;
  TickLines lines_;
  Told told_;
  Valuation last_;
};

}  // namespace btcheck
