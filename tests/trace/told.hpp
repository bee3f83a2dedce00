// SPDX-License-Identifier: MIT
//
// Runs made to measure: where a network has a choice, a script makes it.
#pragma once

#include <doctest/doctest.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "check/checked.hpp"
#include "check/replay/replay.hpp"
#include "trace/run/record.hpp"

namespace btcheck {

// What a step is called in a script: its event, else its text.
inline std::string script_name(const Lowered& model, const Valuation& before,
                               const RunStep& step) {
  const auto event = event_of(model.tree, model.network, before, step);
  return event ? event->text : step_text(model.network, step);
}

// Every step from a state, time last.
inline std::vector<RunStep> steps_from(const Lowered& model,
                                       const Valuation& state) {
  const NetworkInterpreter interpreter(model.network);
  std::vector<RunStep> steps;
  for (std::uint32_t edge = 0; edge < model.network.edge_count(); ++edge) {
    if (!interpreter.may_fire(state, edge)) continue;
    const bool is_free =
        model.network.owner_of_edge(edge).kind == AutomatonKind::StateVariable;
    steps.push_back(
        {{edge, 0, !is_free}, interpreter.after(state, {edge, 0, !is_free})});
  }
  if (interpreter.may_wait(state)) {
    steps.push_back({kIdleStep, interpreter.after(state, kIdleStep)});
  }
  return steps;
}

// The run that takes the one step there is, and asks the script where there
// are several. It ends with the last choice of the script.
inline Run scripted(const Lowered& model,
                    const std::vector<std::string>& script) {
  Run run;
  run.initial = NetworkInterpreter(model.network).initial();
  std::size_t next = 0;
  for (int guard = 0; next < script.size(); ++guard) {
    REQUIRE(guard < 20'000);
    const Valuation& here = run.state(run.steps.size());
    std::vector<RunStep> steps = steps_from(model, here);
    std::size_t chosen = 0;
    if (steps.size() > 1) {
      std::string options;
      while (chosen < steps.size() &&
             script_name(model, here, steps[chosen]) != script[next]) {
        options += script_name(model, here, steps[chosen++]) + "; ";
      }
      INFO(script[next]);
      INFO(options);
      REQUIRE(chosen < steps.size());
      ++next;
    }
    run.steps.push_back(steps[chosen]);
  }
  return run;
}

// Takes steps without a choice, so many.
inline void go_on(const Lowered& model, Run& run, std::size_t steps) {
  for (; steps > 0; --steps) {
    auto options = steps_from(model, run.state(run.steps.size()));
    REQUIRE(options.size() == 1);
    run.steps.push_back(options[0]);
  }
}

// Takes the only step there is until the tree has ended.
inline void go_to_end(const Lowered& model, Run& run) {
  const NetworkInterpreter interpreter(model.network);
  while (!interpreter.is_dead(run.state(run.steps.size()))) {
    go_on(model, run, 1);
  }
}

// Closes the loop at the earlier state that the last one equals.
inline void close_loop(Run& run) {
  const Valuation& last = run.state(run.steps.size());
  run.loop = 0;
  while (!(run.state(run.loop) == last)) ++run.loop;
  REQUIRE(run.loop < run.steps.size());
}

}  // namespace btcheck
