// SPDX-License-Identifier: MIT
#include "run/record/recorder.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "check/check.hpp"
#include "check/replay/replay.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/record.hpp"

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

RunWords run_words(const std::string& how) {
  RunWords words;
  words.property = how;
  words.formula = "a run of the tree; no property is checked";
  words.verdict = "RUN";
  return words;
}

namespace {

// What `trace` reads, less a tenth for what an estimate may miss.
constexpr std::size_t kMostBytes = (std::size_t{64} << 20) / 10 * 9;

std::optional<RecordedRun> beginning_of(
    const BehaviorTree& tree, const Network& network, const TreeInput& input,
    const RunRecorder& recorder, const std::string& how, std::size_t most) {
  const auto run = recorder.replayed(network, most);
  if (!run) return std::nullopt;
  RunHeading heading{run_words(how)};
  add_sources(heading, tree, input);
  return recorded(tree, network, *run, heading);
}

}  // namespace

// All steps are much of a size: that of a sample tells how many fit.
std::optional<RecordedRun> kept_run(const BehaviorTree& tree,
                                    const Network& network,
                                    const TreeInput& input,
                                    const RunRecorder& recorder,
                                    const std::string& how) {
  constexpr std::size_t kSample = 64;
  std::size_t most = recorder.steps().size();
  if (most > kSample) {
    auto sample = beginning_of(tree, network, input, recorder, how, kSample);
    if (!sample) return std::nullopt;
    const std::size_t whole = itf_text(*sample).size();
    sample->states.resize(1);
    const std::size_t begin = itf_text(*sample).size();
    const std::size_t step = (whole - begin) / kSample + 1;
    most = std::min(most, (kMostBytes - std::min(kMostBytes, begin)) / step);
  }
  return beginning_of(tree, network, input, recorder, how, most);
}

std::string engine_end_text(const TreeEngine& engine) {
  const BehaviorTree& tree = engine.tree();
  std::string text;
  switch (engine.state()) {
    case EngineState::Ready:
      return fmt::format("stopped after tick {}", engine.ticks());
    case EngineState::Fault:
      return fmt::format(
          "a fault ended the run in tick {}: an assignment out of range, or a "
          "division by zero",
          engine.ticks());
    case EngineState::Stuck:
      return fmt::format("the tree is stuck in tick {}: no node can go on",
                         engine.ticks());
    case EngineState::Breached:
      return fmt::format("a breach ended the run in tick {}{}{}",
                         engine.ticks(), engine.reason().empty() ? "" : ": ",
                         engine.reason());
    case EngineState::Ended:
      break;
  }
  for (const NodeId root : tree.roots) {
    text += fmt::format(
        "{}{} ended with {}", text.empty() ? "" : ", ", tree.node(root).name,
        kStatusNames[static_cast<std::size_t>(engine.status(root))]);
  }
  return text + fmt::format(" in tick {}", engine.ticks());
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
