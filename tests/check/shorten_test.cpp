// SPDX-License-Identifier: MIT
//
// What is left out of a run and what stays.
#include "check/replay/shorten.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "check/checked.hpp"
#include "check/replay/replay.hpp"

namespace btcheck::shorten_test {
namespace {

// What a step is called: "w := Storm" for a free move, "time", else the node
// and the location that it reaches.
std::string name_of(const Network& network, const RunStep& step) {
  if (step.step.edge == kTimeStep) return "time";
  const Automaton& owner = network.owner_of_edge(step.step.edge);
  const Edge& edge = network.edge(step.step.edge);
  if (owner.kind == AutomatonKind::StateVariable) return edge.label;
  return owner.name.substr(0, owner.name.find("_btn")) + "." +
         owner.target(edge).name;
}

// Free moves and answers of leaves happen when the script says so; what a tree
// does by itself happens by itself.
Run led(const Lowered& model, const std::vector<std::string>& script) {
  const NetworkInterpreter interpreter(model.network);
  Run run;
  run.initial = interpreter.initial();
  std::size_t next = 0;
  for (int guard = 0; next < script.size(); ++guard) {
    INFO(script[next]);
    REQUIRE(guard < 1000);
    const Valuation& here = run.state(run.steps.size());
    std::optional<RunStep> chosen;
    for (std::uint32_t edge = 0; edge <= model.network.edge_count(); ++edge) {
      const bool is_time = edge == model.network.edge_count();
      Step step = is_time ? kIdleStep : Step{edge, 0, true};
      step.progress = is_time || model.network.owner_of_edge(edge).kind !=
                                     AutomatonKind::StateVariable;
      auto after = interpreter.taken(here, step);
      if (!after) continue;
      const RunStep option{step, *std::move(after)};
      const bool is_wanted = name_of(model.network, option) == script[next];
      if (is_wanted || (!chosen && step.progress)) chosen = option;
      if (!is_wanted) continue;
      ++next;
      break;
    }
    REQUIRE(chosen.has_value());
    run.steps.push_back(*std::move(chosen));
  }
  return run;
}

void close_loop(Run& run, std::size_t at) {
  REQUIRE(run.state(at) == run.state(run.steps.size()));
  run.loop = at;
}

std::vector<std::string> free_moves(const Lowered& model, const Run& run) {
  std::vector<std::string> names;
  for (const RunStep& step : run.steps) {
    if (!step.step.progress) names.push_back(name_of(model.network, step));
  }
  return names;
}

using Moves = std::vector<std::string>;

constexpr std::string_view kWeather =
    "(defsv w :states (Calm Wind Storm) :transitions :all)"
    "(defsv v :states (Dry Wet) :transitions :all)"
    "(BehaviorTree :name t :loop 1 (Sequence :name s"
    " (Eval :name e (= w Storm)) (Action :ID a :SF)))";

// Some state satisfies the predicate.
auto shows(const Lowered& model, const std::string& text) {
  const StatePredicate sought = predicate(model, text);
  return [&model, sought](const Run& run) {
    const NetworkInterpreter interpreter(model.network);
    for (std::size_t i = 0; i < run.state_count(); ++i) {
      if (interpreter.is_true(sought, run.state(i))) return true;
    }
    return false;
  };
}

TEST_CASE("free moves that do not matter go, others stay") {
  const Lowered model(kWeather);
  const Run run = led(model, {"v := Wet", "w := Storm", "v := Dry", "e.success",
                              "w := Calm", "w := Wind", "a.success"});
  CHECK(free_moves(model, run).size() == 5);
  const Run shorter = shortened(model.network, run, shows(model, "a.success"));
  CHECK(free_moves(model, shorter) == Moves{"w := Storm"});
  CHECK(shorter.steps.size() == run.steps.size() - 4);
}

TEST_CASE("moves that bring a value back go together") {
  const Lowered model(kWeather);
  const Run run = led(model, {"w := Wind", "w := Storm", "w := Calm",
                              "w := Storm", "e.success", "a.success"});
  const Run shorter = shortened(model.network, run, shows(model, "a.success"));
  CHECK(free_moves(model, shorter) == Moves{"w := Wind", "w := Storm"});
  const Run calm =
      led(model, {"w := Wind", "w := Storm", "w := Calm", "e.failure"});
  CHECK(free_moves(model, shortened(model.network, calm,
                                    shows(model, "e.failure"))) == Moves{});
}

TEST_CASE("a move that is what the run is about stays") {
  const Lowered model(kWeather);
  const Run run =
      led(model, {"w := Storm", "e.success", "w := Wind", "a.success"});
  CHECK(free_moves(model, shortened(model.network, run, [&](const Run& r) {
                     return shows(model, "a.success")(r) &&
                            shows(model, "w == Wind")(r);
                   })) == Moves{"w := Storm", "w := Wind"});
}

TEST_CASE("a loop stays a loop without its weather") {
  const Lowered model(kWeather);
  Run run = led(model, {"e.failure"});
  const std::size_t loop = run.steps.size();
  run = led(model, {"e.failure", "w := Wind", "v := Wet", "e.failure",
                    "w := Calm", "v := Dry", "e.failure"});
  while (run.state(loop) != run.state(run.steps.size())) run.steps.pop_back();
  close_loop(run, loop);
  const Run shorter = shortened(model.network, run,
                                [](const Run& r) { return r.loop != kNoLoop; });
  CHECK(free_moves(model, shorter) == Moves{});
  CHECK(shorter.state(shorter.loop) == shorter.state(shorter.steps.size()));
  CHECK(shorter.steps.size() < run.steps.size());
}

TEST_CASE("a loop of free moves alone is never made") {
  const Lowered model(
      "(defsv w :states (Calm Storm) :transitions :all)"
      "(BehaviorTree :name t (Action :ID a :SF))");
  Run run = led(model, {"t.success", "time"});
  const std::size_t loop = run.steps.size();
  run = led(model, {"t.success", "time", "w := Storm", "time", "w := Calm"});
  close_loop(run, loop);
  const auto in_loop = shows(model, "w == Storm");
  const Run shorter = shortened(model.network, run, in_loop);
  CHECK(free_moves(model, shorter).size() >= 1);
  CHECK(std::any_of(
      shorter.steps.begin() + static_cast<std::ptrdiff_t>(shorter.loop),
      shorter.steps.end(),
      [](const RunStep& step) { return step.step.progress; }));
}

TEST_CASE("a loop that the stem has gone through already begins earlier") {
  const Lowered model("(BehaviorTree :name t (Action :ID a))");
  const Run once = led(model, {"a.running", "a.running"});
  const Run twice = led(model, {"a.running", "a.running", "a.running"});
  Run run = twice;
  close_loop(run, once.steps.size());
  const Run shorter = shortened(model.network, run,
                                [](const Run& r) { return r.loop != kNoLoop; });
  CHECK(shorter.steps.size() < twice.steps.size());
  CHECK(shorter.loop < once.steps.size());
  CHECK(shorter.state(shorter.loop) == shorter.state(shorter.steps.size()));
}

TEST_CASE("rounds that lead nowhere are left out") {
  const Lowered model("(BehaviorTree :name t (Action :ID a))");
  const Run run =
      led(model, {"a.running", "a.running", "a.running", "a.success"});
  const Run direct = led(model, {"a.running", "a.success"});
  const auto ends = shows(model, "a.success");
  CHECK(shortened(model.network, run, [&](const Run& r) {
          return ends(r) && shows(model, "a.running")(r);
        }).steps.size() == direct.steps.size());
}

TEST_CASE("what may not be shorter stays as it is") {
  const Lowered model(kWeather);
  const Run run = led(model, {"v := Wet", "w := Storm", "e.success"});
  const Run same = shortened(model.network, run, [&](const Run& r) {
    return r.steps.size() >= run.steps.size();
  });
  CHECK(same.steps.size() == run.steps.size());
}

}  // namespace
}  // namespace btcheck::shorten_test
