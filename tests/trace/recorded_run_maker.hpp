// SPDX-License-Identifier: MIT
//
// Small runs that tests of several formats look at.
#pragma once

#include "trace/btcpp_engine.hpp"

namespace btcheck {

// The tree of data/btcpp4.10_sample.btlog, and the two ticks it logs.
inline BtcppEngine sample_execution() {
  BtcppEngine engine;
  const auto sequence = engine.add("Sequence", "Sequence", 0);
  const auto a = engine.add("Action", "a", sequence);
  const auto subtree = engine.add("SubTree", "Sub", sequence);
  const auto fallback = engine.add("Fallback", "Fallback", subtree);
  const auto s = engine.add("Action", "s", fallback);
  engine.add("Action", "AlwaysSuccess", fallback);
  engine.tick([](std::uint32_t) { return LogStatus::Running; });
  engine.tick([=](std::uint32_t leaf) {
    return leaf == a || leaf != s ? LogStatus::Success : LogStatus::Failure;
  });
  return engine;
}

// Three ticks of a ReactiveFallback whose condition fails and whose action
// runs, with two variables and an atom; the third tick repeats for ever, the
// property is lost in the second.
inline RecordedRun looping_run() {
  BtcppEngine engine;
  engine.run().variables = {"battery", "level"};
  engine.run().is_number = {false, true};
  const auto fallback = engine.add("ReactiveFallback", "ReactiveFallback2", 0);
  const auto good = engine.add("Condition", "good?", fallback);
  engine.add("Action", "go \"home\"", fallback);
  const BtcppEngine::World world = [=](std::uint32_t leaf) {
    return leaf == good ? LogStatus::Failure : LogStatus::Running;
  };
  for (int tick = 0; tick < 3; ++tick) engine.tick(world);
  RecordedRun run = engine.run();
  run.atoms = {"battery = Good"};
  for (RecordedState& state : run.states) {
    state.values = {state.tick < 2 ? "Good" : "Low",
                    std::to_string(10 * state.tick)};
    state.atoms = {state.tick < 2};
  }
  run.why = "nobody looks at the battery";
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    if (run.lost == kNoState && run.states[i].tick == 2) run.lost = i;
    if (run.loop == kNoState && run.states[i].tick == 3) run.loop = i;
  }
  run.back.step = "the root is ticked";
  return run;
}

}  // namespace btcheck
