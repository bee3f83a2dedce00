// SPDX-License-Identifier: MIT
//
// A run shown while it goes on is the run that is kept of it.
#include <doctest/doctest.h>

#include <chrono>
#include <string>

#include "check/check.hpp"
#include "explore/state/step.hpp"
#include "run/driven.hpp"
#include "run/leaves/scripted_leaves.hpp"
#include "run/view/view_teller.hpp"
#include "trace/live/live_run.hpp"
#include "trace/viewer/packed.hpp"

namespace btcheck::view_teller_test {
namespace {

using namespace std::chrono_literals;

constexpr const char* kTree = R"((defsv battery
  :states (Good Low) :init Good :transitions :all)
(BehaviorTree :name t
  (KeepRunningUntilFailure (ForceSuccess
    (Sequence (SetSV :ID measure :sv battery) (Condition :ID clear)
      (ParallelAll (Action :ID act) (Action :ID rest)))))))";

// So many ticks at random, shown and kept.
struct Shown {
  Shown(int ticks, std::size_t most_steps,
        std::chrono::milliseconds patience = 60s)
      : lowered(kTree),
        system(lowered.network),
        input{"tree.btf", kTree},
        run(beginning_of_run(lowered.tree, lowered.network, input, "a test")) {
    RandomLeaves leaves(lowered.tree, system, 7);
    TreeEngine engine(lowered.tree, system, leaves, OnBreach::Stop);
    ViewTeller view(lowered.tree, lowered.network, run, most_steps);
    engine.add(recorder);
    engine.add(view);
    engine.begin();
    for (int t = 0; t < ticks && engine.state() == EngineState::Ready; ++t) {
      engine.tick();
    }
    view.finish("the end", patience);
  }

  // All that was told, one message after the other.
  std::string told() const {
    std::string text;
    LiveRun::Place place{1, 0};
    while (const auto message = run.next(place)) text += *message;
    return text;
  }

  LoweredTree lowered;
  CompiledNetwork system;
  TreeInput input;
  LiveRun run;
  RunRecorder recorder;
};

}  // namespace

TEST_CASE("what is shown of a run is what is kept of it") {
  const Shown shown(30, 1 << 20);
  const auto kept = kept_run(shown.lowered.tree, shown.lowered.network,
                             shown.input, shown.recorder, "a test");
  REQUIRE(kept.has_value());
  REQUIRE(kept->states.size() > 500);
  // The same, told in one piece.
  RecordedRun beginning = *kept;
  beginning.states.resize(1);
  LiveRun expected(beginning);
  const std::string page = shown.run.page("");
  CHECK(page == expected.page(""));
  std::size_t states = 1;
  std::size_t at = 0;
  const std::string told = shown.told();
  while ((at = told.find("\"states\":[", at)) != std::string::npos) {
    at += 10;
    bool is_count = false;
    for (std::size_t end = at; told[end - 1] != ']'; at = end + 1) {
      end = told.find_first_of(",]", at);
      if (is_count) states += std::stoul(told.substr(at, end - at));
      is_count = !is_count;
      if (told[end] == ']') break;
    }
  }
  CHECK(states == kept->states.size());
  CHECK(told.ends_with("event: end\ndata: \"the end\"\n\n"));
}

TEST_CASE("an engine that is too fast for its view is not held up") {
  const Shown shown(3000, 100);
  CHECK(shown.told().ends_with(
      "data: \"the run goes on faster than it can be shown\"\n\n"));
  CHECK(shown.recorder.steps().size() > 10'000);
}

TEST_CASE("a view that cannot keep up is cut off at the end of the run") {
  const Shown shown(30'000, 1 << 22, 0ms);
  CHECK(
      shown.told().ends_with("data: \"the end; its last steps came too fast "
                             "to be shown\"\n\n"));
}

}  // namespace btcheck::view_teller_test
