// SPDX-License-Identifier: MIT
//
// Trees as LTSmin is given them: as many states and steps as are counted here,
// and the labels of rules. That LTSmin counts them as well is compared by
// script/compare-ltsmin.
#include "pins/model.hpp"

#include <doctest/doctest.h>

#include <queue>
#include <set>
#include <string>
#include <vector>

#include "check/space/space.hpp"
#include "pins/trace.hpp"

namespace btcheck::model_test {
namespace {

const std::string kExamples = BTCHECK_EXAMPLES;

std::unique_ptr<PinsModel> loaded(const std::string& file,
                                  const std::string& also = "") {
  auto model = load_model(kExamples + "/" + file, also);
  REQUIRE(model);
  return model;
}

struct Counts {
  std::uint64_t states = 0;
  std::uint64_t steps = 0;

  friend bool operator==(const Counts&, const Counts&) = default;
};

// As an engine does it: by all groups, or by one after the other.
Counts counted(const PinsModel& model, bool by_group) {
  Counts counts;
  std::set<std::vector<int>> known = {model.initial()};
  std::queue<std::vector<int>> waiting;
  waiting.push(model.initial());
  while (!waiting.empty()) {
    const std::vector<int> state = waiting.front();
    waiting.pop();
    const auto told = [&](std::uint32_t, const int* target) {
      std::vector<int> next(target, target + state.size());
      if (known.insert(next).second) waiting.push(next);
    };
    if (!by_group) {
      counts.steps +=
          static_cast<std::uint64_t>(model.steps(state.data(), told));
      continue;
    }
    for (std::uint32_t group = 0; group < model.groups().size(); ++group) {
      counts.steps +=
          static_cast<std::uint64_t>(model.steps_of(group, state.data(), told));
    }
  }
  counts.states = known.size();
  return counts;
}

Counts measured(const Network& network, Reduction reduction) {
  SpaceOptions options;
  options.reduce = reduction;
  const auto report = measure_space(network, options, {});
  return {report.result.progress.states, report.result.progress.transitions};
}

TEST_CASE("as many states and steps as the space has") {
  for (const char* file : {"drone1.btf", "recovery.btf", "roundrobin.btf",
                           "train.btf", "mars_rover.btf"}) {
    CAPTURE(file);
    const auto model = loaded(file);
    const Counts all = measured(model->network(), Reduction::None);
    if (all.states > 20'000) continue;
    CHECK(counted(*model, false) == all);
    CHECK(counted(*model, true) == all);
    CHECK(counted(*loaded(file, "--packed"), false) == all);
    CHECK(counted(*loaded(file, "--forget"), false) ==
          measured(model->network(), Reduction::Live));
  }
}

TEST_CASE("idle steps are told where they are asked for") {
  const auto quiet = loaded("recovery.btf");
  const auto idle = loaded("recovery.btf", "--idle");
  const Counts before = counted(*quiet, false);
  const Counts after = counted(*idle, false);
  CHECK(after.states == before.states);
  CHECK(after.steps > before.steps);
}

TEST_CASE("rules are labels, and labels are what rules say") {
  const auto model =
      loaded("drone1.btf", "-e 'always not dead' -e 'never land@10.success'");
  REQUIRE(model->labels().size() == 2);
  CHECK(model->labels()[0].name.ends_with("_p0"));
  const auto first = model->initial();
  CHECK(model->label(0, first.data()));
  CHECK(!model->label(1, first.data()));
}

TEST_CASE("a file that is not there, or not right, is no model") {
  CHECK(!load_model(kExamples + "/nowhere.btf", ""));
  CHECK(!load_model(kExamples + "/drone1.btf", "--prop nowhere.ltl"));
  CHECK(!load_model(kExamples + "/drone1.btf", "-e 'never nobody.ticked'"));
  CHECK(!load_model(kExamples + "/drone1.btf", "--no-such-option"));
  CHECK(!load_model(kExamples + "/drone1.btf", "'open"));
  CHECK(!load_model(kExamples + "/drone1.btf", "--guards --idle"));
  CHECK(!load_model(kExamples + "/drone1.btf", "--to dot"));
}

// A walk of so many steps, written as ltsmin-printtrace does.
std::string printed_walk(const PinsModel& model, int steps) {
  const auto actions = action_names(model.system().network());
  std::string text;
  for (std::size_t slot = 0; slot < model.slots().size(); ++slot) {
    text += model.slot_name(slot) + ":type,";
  }
  text += "action:action\n";
  std::vector<int> state = model.initial();
  for (int i = 0; i <= steps; ++i) {
    for (std::size_t slot = 0; slot < state.size(); ++slot) {
      const auto names = model.value_names(slot);
      const auto value = static_cast<std::size_t>(state[slot]);
      text += names.empty() ? std::to_string(state[slot])
                            : '"' + names[value] + '"';
      text += ',';
    }
    std::vector<int> next;
    std::string action;
    model.steps(state.data(), [&](std::uint32_t group, const int* target) {
      next.assign(target, target + state.size());
      action = actions[group];
    });
    text += i == steps ? "\n" : '"' + action + "\"\n";
    state = next;
  }
  return text;
}

TEST_CASE("a printed trace is executed again") {
  for (const char* also : {"", "--packed", "--forget"}) {
    CAPTURE(also);
    const auto model = loaded("drone1.btf", also);
    const auto trace = read_trace("run.csv", printed_walk(*model, 30), *model);
    REQUIRE(trace.value);
    std::string error;
    const auto run = replayed(*model, *trace.value, error);
    CAPTURE(error);
    REQUIRE(run);
    CHECK(run->steps.size() == 30);
  }
}

TEST_CASE("a trace that the tree cannot take is refused") {
  const auto model = loaded("drone1.btf");
  std::string text = printed_walk(*model, 30);
  // Without its fourth state.
  std::size_t line = 0;
  for (int i = 0; i < 4; ++i) line = text.find('\n', line) + 1;
  text.erase(line, text.find('\n', line) + 1 - line);
  const auto trace = read_trace("run.csv", text, *model);
  REQUIRE(!trace.value);
  CHECK(trace.diagnostics[0].code == "BT1310");
}

TEST_CASE("what is no trace of the model says why") {
  const auto model = loaded("drone1.btf");
  const std::string whole = printed_walk(*model, 3);
  for (const std::string& text : {std::string(), std::string("a:b,c:d\n1,2\n"),
                                  whole.substr(0, whole.size() - 40),
                                  printed_walk(*loaded("train.btf"), 3)}) {
    const auto trace = read_trace("run.csv", text, *model);
    REQUIRE(!trace.value);
    CHECK(trace.diagnostics[0].code == "BT1309");
  }
}

}  // namespace
}  // namespace btcheck::model_test
