// SPDX-License-Identifier: MIT
#include "run/record/recorder.hpp"

#include <algorithm>
#include <utility>

#include "check/replay/replay.hpp"

namespace btcheck {

Valuation unpacked(const CompiledNetwork& system, StateView state) {
  const Network& network = system.network();
  Valuation values;
  for (std::uint32_t v = 0; v < network.variables.size(); ++v) {
    values.variables.push_back(
        static_cast<int>(system.value(state, VariableId{v})));
  }
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    values.clocks.push_back(
        static_cast<int>(system.clock(state, AutomatonId{a})));
  }
  return values;
}

std::optional<Run> RunRecorder::replayed(const Network& network,
                                         std::size_t most) const {
  const NetworkInterpreter interpreter(network);
  Run run{interpreter.initial(), {}, kNoLoop};
  for (std::size_t i = 0; i < std::min(most, steps_.size()); ++i) {
    auto after = interpreter.taken(run.state(i), steps_[i]);
    if (!after) return std::nullopt;
    run.steps.push_back({steps_[i], std::move(*after)});
  }
  return run;
}

TickTeller::TickTeller(const BehaviorTree& tree, const CompiledNetwork& system,
                       Told told)
    : system_(system), lines_(tree, system.network()), told_(std::move(told)) {}

void TickTeller::stepped(StateView after, const Step& step) {
  last_ = unpacked(system_, after);
  const std::string line = lines_.take({step, last_});
  if (!line.empty()) told_(line);
}

}  // namespace btcheck
