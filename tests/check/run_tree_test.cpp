// SPDX-License-Identifier: MIT
//
// Runs that are kept together are told one by one as they were.
#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "check/checked.hpp"
#include "check/replay/run_tree.hpp"

namespace btcheck::run_tree_test {
namespace {

// All runs of so many steps, at most `most`, with their states.
std::vector<Run> some_runs(const Network& network, std::size_t length,
                           std::size_t most) {
  const NetworkInterpreter interpreter(network);
  std::vector<Run> open{Run{interpreter.initial(), {}, kNoLoop}};
  for (std::size_t i = 0; i < length; ++i) {
    std::vector<Run> longer;
    for (const Run& run : open) {
      const auto go = [&](const Step& step) {
        const auto next = interpreter.taken(run.state(run.steps.size()), step);
        if (!next || longer.size() == most) return;
        longer.push_back(run);
        longer.back().steps.push_back({step, *next});
      };
      for (std::uint32_t edge = 0; edge < network.edge_count(); ++edge) {
        go({edge, 0, true});
      }
      go({kTimeStep, 1, true});
    }
    open = std::move(longer);
  }
  return open;
}

TEST_CASE("each run comes out of the tree as it went in, and is kept once") {
  const Lowered model(
      "(BehaviorTree :name t :loop 1 (ReactiveSequence :halt 1"
      " (Condition :ID c) (Parallel :success 1 :halt 1"
      " (Action :ID a) (Wait :duration [1,2]))))");
  const std::vector<Run> runs = some_runs(model.network, 200, 40);
  REQUIRE(runs.size() == 40);
  const auto tree = std::make_shared<RunTree>(model.network);
  std::vector<RunTree::Place> ends;
  for (int round = 0; round < 2; ++round) {
    for (const Run& run : runs) {
      RunTree::Place place = 0;
      for (const RunStep& step : run.steps) {
        place = tree->follow(place, step.step, step.after);
      }
      ends.push_back(place);
    }
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    CHECK(ends[i] == ends[i + runs.size()]);
    const Run told = KeptRun(tree, ends[i]).told();
    REQUIRE(told.steps.size() == runs[i].steps.size());
    int ticks = 0;
    for (std::size_t k = 0; k < told.steps.size(); ++k) {
      CHECK(told.steps[k].step == runs[i].steps[k].step);
      CHECK(told.state(k) == runs[i].state(k));
      ticks += told.steps[k].step.elapsed;
    }
    CHECK(KeptRun(tree, ends[i]).ticks() == ticks);
    CHECK(tree->state(ends[i]) == runs[i].state(runs[i].steps.size()));
  }
  CHECK(KeptRun(tree, 0).is_empty());
  // As well once it is closed; and in a tree that is only added to.
  tree->close();
  const auto copy = std::make_shared<RunTree>(model.network);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    CHECK(tree->state(ends[i]) == run.state(run.steps.size()));
    RunTree::Place place = 0;
    for (const Step& step : KeptRun(tree, ends[i]).steps()) {
      place = copy->add(place, step);
    }
    CHECK(copy->state(place) == run.state(run.steps.size()));
    CHECK(KeptRun(copy, place).ticks() == KeptRun(tree, ends[i]).ticks());
    CHECK(copy->before(place) < place);
  }
}

}  // namespace
}  // namespace btcheck::run_tree_test
