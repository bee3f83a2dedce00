// SPDX-License-Identifier: MIT
//
// Random runs of random trees made shorter: each result is a run, still shows
// what it has to, and is not longer.
#include <doctest/doctest.h>

#include <string>

#include "check/replay/replay.hpp"
#include "check/replay/shorten.hpp"
#include "model/automata/network.hpp"
#include "model/lowering.hpp"
#include "reference/effort.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference::shorten_cross_check_test {
namespace {

// A walk that closes a loop at the first state that comes back, or ends after
// so many steps.
Run random_run(const Network& network, SplitMix64& random, int steps) {
  const NetworkInterpreter interpreter(network);
  Run run;
  run.initial = interpreter.initial();
  for (int i = 0; i < steps; ++i) {
    const Valuation& here = run.state(run.steps.size());
    std::vector<RunStep> options;
    for (std::uint32_t e = 0; e < network.edge_count(); ++e) {
      const bool is_free =
          network.owner_of_edge(e).kind == AutomatonKind::StateVariable;
      const Step step{e, 0, !is_free};
      if (auto after = interpreter.taken(here, step)) {
        options.push_back({step, *std::move(after)});
      }
    }
    if (auto after = interpreter.taken(here, kIdleStep)) {
      options.push_back({kIdleStep, *std::move(after)});
    }
    REQUIRE(!options.empty());
    run.steps.push_back(options[static_cast<std::size_t>(
        random.below(static_cast<int>(options.size())))]);
  }
  // The widest loop that makes progress, if there is one.
  for (std::size_t loop = 0; loop < run.steps.size(); ++loop) {
    bool makes_progress = false;
    for (std::size_t i = loop; i < run.steps.size(); ++i) {
      makes_progress |= run.steps[i].step.progress;
    }
    if (makes_progress && run.state(loop) == run.state(run.steps.size())) {
      run.loop = loop;
      break;
    }
  }
  return run;
}

// What a run has to show: that its last answer or value, picked at random
// among its variables, is there for ever after or at the end.
std::function<bool(const Run&)> claim(const Run& run, std::size_t variable) {
  const auto value = [variable](const Valuation& state) {
    return state.variables[variable];
  };
  const int last = value(run.state(run.steps.size()));
  const bool has_loop = run.loop != kNoLoop;
  return [=](const Run& candidate) {
    return (candidate.loop != kNoLoop) == has_loop &&
           value(candidate.state(candidate.steps.size())) == last;
  };
}

void check_run(const Network& network, const Run& run, const Run& shorter) {
  const NetworkInterpreter interpreter(network);
  REQUIRE(shorter.initial == interpreter.initial());
  REQUIRE(shorter.steps.size() <= run.steps.size());
  bool makes_progress = false;
  for (std::size_t i = 0; i < shorter.steps.size(); ++i) {
    const auto after =
        interpreter.taken(shorter.state(i), shorter.steps[i].step);
    REQUIRE(after == shorter.steps[i].after);
    makes_progress |= i >= shorter.loop && shorter.steps[i].step.progress;
  }
  if (run.loop == kNoLoop) return;
  REQUIRE(shorter.loop < shorter.steps.size());
  REQUIRE(shorter.state(shorter.loop) == shorter.state(shorter.steps.size()));
  REQUIRE(makes_progress);
}

}  // namespace

TEST_CASE("a run made shorter is a run and no longer") {
  const std::uint64_t seed = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(1000, 10000);
  std::size_t shorter_runs = 0, loops = 0;
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t here = seed * 1'000'000 + i;
    const std::string text = random_tree(here);
    CAPTURE(text);
    const auto tree = read_btf("t.btf", text);
    REQUIRE(tree.value);
    for (const TickSemantics ticks :
         {TickSemantics::Root, TickSemantics::Leaves, TickSemantics::None}) {
      const Network network = lower(*tree.value, ticks);
      SplitMix64 random(here);
      const Run run = random_run(network, random, 20 + random.below(60));
      const auto shows = claim(
          run, static_cast<std::size_t>(
                   random.below(static_cast<int>(network.variables.size()))));
      REQUIRE(shows(run));
      const Run shorter = shortened(network, run, shows);
      check_run(network, run, shorter);
      REQUIRE(shows(shorter));
      shorter_runs += shorter.steps.size() < run.steps.size();
      loops += run.loop != kNoLoop;
    }
  }
  CHECK_COVERED(shorter_runs > trees / 2);
  CHECK_COVERED(loops > trees / 5);
}

}  // namespace btcheck::reference::shorten_cross_check_test
