// SPDX-License-Identifier: MIT
//
// A run is executed again from the tables: one that was tampered with is
// refused, and one that does not show what it should is seen through.
#include "check/replay/replay.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/checked.hpp"
#include "explore/search/reachability.hpp"

namespace btcheck::replay_test {
namespace {

std::string complaint_about(const Lowered& model, const Lasso& run) {
  std::string error;
  const auto replayed = replay(Replayer(model.system), run, error);
  CHECK(replayed.has_value() == error.empty());
  return error;
}

TEST_CASE("a run is replayed step by step") {
  const Lowered model(kWaitingTree);
  const StatePredicate goal = predicate(model, "a.running");
  const Lasso found = found_run(model, goal);
  std::string error;
  const auto run = replay(Replayer(model.system), found, error);
  REQUIRE(run.has_value());
  CHECK(error == "");
  CHECK(run->loop == kNoLoop);
  CHECK(run->state_count() == found.prefix.size());
  for (std::size_t i = 0; i < run->state_count(); ++i) {
    for (std::uint32_t v = 0; v < model.network.variables.size(); ++v) {
      CHECK(run->state(i).variables[v] ==
            model.system.value(found.prefix[i].state, VariableId{v}));
    }
  }
}

TEST_CASE("a run that begins elsewhere is refused") {
  const Lowered model(kWaitingTree);
  Lasso run = found_run(model, predicate(model, "a.running"));
  run.prefix.erase(run.prefix.begin());
  CHECK(complaint_about(model, run) ==
        "the run does not begin with the initial state");
}

TEST_CASE("a run with a step left out is refused") {
  const Lowered model(kWaitingTree);
  const Lasso run = found_run(model, predicate(model, "a.running"));
  for (std::size_t at = 1; at < run.prefix.size(); ++at) {
    Lasso shorter = run;
    shorter.prefix.erase(shorter.prefix.begin() +
                         static_cast<std::ptrdiff_t>(at));
    // Leaving out the last step leaves a run, only a shorter one.
    if (at + 1 == run.prefix.size()) {
      CHECK(complaint_about(model, shorter) == "");
    } else {
      CAPTURE(at);
      CHECK(complaint_about(model, shorter) != "");
    }
  }
}

TEST_CASE("a run with any variable changed in any state is refused") {
  const Lowered model(kWaitingTree);
  const Lasso run = found_run(model, predicate(model, "a.running"));
  for (std::size_t at = 0; at < run.prefix.size(); ++at) {
    for (std::uint32_t v = 0; v < model.network.variables.size(); ++v) {
      const Variable& variable = model.network.variables[v];
      if (variable.domain_size() == 1) continue;
      Lasso changed = run;
      const Field& field = model.system.layout().fields[v];
      Word* state = changed.prefix[at].state.data();
      field.put(state, field.get(state) == variable.min ? variable.min + 1
                                                        : variable.min);
      CAPTURE(at);
      CAPTURE(variable.name);
      CHECK(complaint_about(model, changed) != "");
    }
  }
}

TEST_CASE("a run with a step named wrongly is refused") {
  const Lowered model(kWaitingTree);
  const Lasso run = found_run(model, predicate(model, "a.running"));
  for (std::size_t at = 1; at < run.prefix.size(); ++at) {
    Lasso changed = run;
    Step& step = changed.prefix[at].step;
    step.edge = step.edge == kTimeStep ? 0 : kTimeStep;
    CAPTURE(at);
    const std::string complaint = complaint_about(model, changed);
    CHECK(complaint.starts_with("step " + std::to_string(at) + ", "));
    CHECK(complaint.ends_with(" when replayed"));
  }
}

TEST_CASE("a loop that does not close is refused") {
  const Lowered model(kWaitingTree);
  Lasso lasso = found_run(model, predicate(model, "a.running"));
  lasso.cycle = {lasso.prefix.back()};
  lasso.prefix.pop_back();
  lasso.closing = kIdleStep;
  CHECK(complaint_about(model, lasso) != "");
}

TEST_CASE("a finished tree stays as it is while time passes") {
  const Lowered model(kWaitingTree);
  const StatePredicate ended = predicate(model, "(root.ended and w == Calm)");
  Lasso lasso = found_run(model, ended);
  const RunState last = lasso.prefix.back();
  lasso.cycle = {{last.state, kIdleStep}};
  lasso.closing = kIdleStep;
  std::string error;
  const auto run = replay(Replayer(model.system), lasso, error);
  REQUIRE(run.has_value());
  CHECK(run->loop == lasso.prefix.size());
  CHECK(run->state(run->steps.size()) == run->state(run->loop));
}

TEST_CASE("the interpreter takes the steps that the search sees") {
  for (const TickSemantics ticks :
       {TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes,
        TickSemantics::None}) {
    CAPTURE(tick_name(ticks));
    const Lowered model(kWaitingTree, ticks);
    struct Counter : ReachabilityVisitor {
      GoOn expanded(StateId id, StateView, bool) {
        last = id;
        return GoOn::Yes;
      }
      StateId last{};
    } counter;
    const Limits limits;
    BreadthFirst search(model.system, limits);
    search.run(counter);
    for (std::uint32_t id = 0; id <= index(counter.last); ++id) {
      CHECK(complaint_about(model, {search.path_to(StateId{id}), {}, {}}) ==
            "");
    }
  }
}

}  // namespace
}  // namespace btcheck::replay_test
