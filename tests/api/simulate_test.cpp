// SPDX-License-Identifier: MIT
//
// One run by the door is the run that the program makes of the same words.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "btcheck/check.hpp"
#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace btcheck::api_simulate_test {
namespace {

namespace fs = std::filesystem;
namespace v1 = btcheck::v1;

v1::Files example(const std::string& name) {
  v1::Files files;
  files.add(name, file_text(fs::path(BTCHECK_EXAMPLES) / name));
  return files;
}

v1::Request request_for(const std::string& tree) {
  v1::Request request;
  request.tree = tree;
  return request;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

constexpr const char* kDoor =
    "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">\n"
    "<BehaviorTree ID=\"M\"><Fallback>\n"
    "  <Push/><Pull/>\n"
    "</Fallback></BehaviorTree></root>\n";

TEST_CASE("the same seed gives the lines and the file of the program") {
  for (const std::string name : {"drone1.btf", "nav2.btf", "roundrobin.btf"}) {
    for (const std::uint64_t seed : {1, 7}) {
      CAPTURE(name);
      CAPTURE(seed);
      v1::Files files = example(name);
      v1::Plan plan;
      plan.seed = seed;
      plan.ticks = 20;
      const v1::Simulation run = v1::simulate(request_for(name), plan, files);
      const TemporaryFolder folder;
      const fs::path kept = folder.path() / "run.itf.json";
      const Outcome told =
          run_in(BTCHECK_EXAMPLES, "'" BTCHECK_PROGRAM "' simulate " + name +
                                       " --no-config --ticks 20 --seed " +
                                       std::to_string(seed) + " -o " +
                                       quoted(kept) + " 2>/dev/null");
      CHECK(joined(run.lines) == told.text);
      CHECK(run.itf() == file_text(kept));
      CHECK(static_cast<int>(run.outcome) == told.code);
      REQUIRE(run.run);
      CHECK_FALSE(run.run->steps.empty());
    }
  }
}

TEST_CASE("a script answers, and the last state is told") {
  v1::Files files;
  files.add("d.xml", kDoor);
  files.add("answers.txt", "Push: running failure\nPull: success\n");
  v1::Plan plan;
  plan.script = "answers.txt";
  const v1::Simulation run = v1::simulate(request_for("d.xml"), plan, files);
  CHECK(run.outcome == v1::Outcome::Met);
  CHECK(run.ending == v1::Ending::Ended);
  CHECK(run.end == "M ended with success in tick 2");
  CHECK(run.ticks == 2);
  CHECK(run.profile == "btcpp-4");
  REQUIRE(run.lines.size() == 2);
  CHECK(run.lines[0].starts_with("tick 1: root=running"));
  CHECK(run.statuses.size() == 4);
  CHECK(std::ranges::any_of(run.run->steps, [](const v1::Step& step) {
    return step.text == "Pull -> success" && step.is_chosen &&
           step.where.line == 3;
  }));
}

TEST_CASE("without seed and script the first answers are taken") {
  v1::Files files;
  files.add("d.xml", kDoor);
  const v1::Simulation run = v1::simulate(request_for("d.xml"), {}, files);
  CHECK(run.end == "M ended with success in tick 1");
  CHECK_FALSE(run.itf().empty());
}

TEST_CASE("a script that asks for what cannot be is refused") {
  v1::Files files;
  files.add("d.xml", kDoor);
  files.add("wrong.txt", "Puhs: success\n");
  files.add("late.btf", "(BehaviorTree :name t (Condition :ID c))");
  files.add("late.txt", "c: running\n");
  v1::Plan plan;
  plan.script = "wrong.txt";
  const v1::Simulation wrong = v1::simulate(request_for("d.xml"), plan, files);
  CHECK(wrong.outcome == v1::Outcome::BadInput);
  CHECK_FALSE(wrong.run);
  REQUIRE_FALSE(wrong.findings.empty());
  CHECK(wrong.findings.back().code == "BT1401");
  CHECK(wrong.findings.back().where.file == "wrong.txt");
  plan.script = "late.txt";
  CHECK(v1::simulate(request_for("late.btf"), plan, files)
            .findings.back()
            .code.starts_with("BT140"));
  plan.script = "gone.txt";
  CHECK(v1::simulate(request_for("d.xml"), plan, files).findings.back().code ==
        "BT0002");
  CHECK(v1::simulate(request_for("gone.xml"), plan, files).outcome ==
        v1::Outcome::BadInput);
  CHECK(v1::Simulation().itf().empty());
}

TEST_CASE("ticks, a monitor and the clock end a run, which is kept") {
  v1::Files files = example("nav2.btf");
  v1::Request request = request_for("nav2.btf");
  request.loops = true;
  v1::Plan plan;
  plan.seed = 3;
  plan.ticks = 5;
  CHECK(v1::simulate(request, plan, files).ending == v1::Ending::Ticks);
  class Ends final : public v1::Monitor {
   public:
    bool goes_on(const v1::Progress& progress) override {
      return progress.seconds < 0.1;
    }
  } soon;
  plan.ticks = 100'000'000;
  const v1::Simulation run = v1::simulate(request, plan, files, &soon);
  CHECK(run.outcome == v1::Outcome::Undecided);
  CHECK((run.ending == v1::Ending::Stopped || run.findings.size() > 0));
  request.seconds = 0.1;
  CHECK(v1::simulate(request, plan, files).outcome == v1::Outcome::Undecided);
}

TEST_CASE("runs and descriptions in several threads") {
  v1::Files files = example("drone1.btf");
  files.add("d.xml", kDoor);
  v1::Plan plan;
  plan.seed = 5;
  plan.ticks = 30;
  const auto lines = [&] {
    return joined(v1::simulate(request_for("drone1.btf"), plan, files).lines);
  };
  const auto names = [&] {
    std::string text;
    for (const auto& node : v1::describe(request_for("d.xml"), files).nodes) {
      text += node.name + node.about;
    }
    return text;
  };
  const std::string alone = lines() + names();
  std::vector<int> different(8, 0);
  std::vector<std::thread> threads;
  for (int& count : different) {
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) count += lines() + names() != alone;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const int count : different) CHECK(count == 0);
}

}  // namespace
}  // namespace btcheck::api_simulate_test
