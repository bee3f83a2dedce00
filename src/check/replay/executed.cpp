// SPDX-License-Identifier: MIT
#include "check/replay/executed.hpp"

#include <utility>

#include "check/replay/replay.hpp"

namespace btcheck {

std::optional<Run> executed(const Network& network,
                            std::span<const Step> steps) {
  const NetworkInterpreter interpreter(network);
  Run run;
  run.initial = interpreter.initial();
  Valuation state = run.initial;
  for (const Step& step : steps) {
    auto next = interpreter.taken(state, step);
    if (!next) return std::nullopt;
    state = *next;
    run.steps.push_back({step, std::move(*next)});
  }
  return run;
}

}  // namespace btcheck
