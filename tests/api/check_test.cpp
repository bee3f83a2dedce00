// SPDX-License-Identifier: MIT
//
// The door for programs: texts in, a report out, and nothing else touched.
#include "btcheck/check.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "api/comparable.hpp"
#include "file_text.hpp"
#include "shell.hpp"
#include "text/input_file.hpp"

namespace btcheck::api_test {
namespace {

namespace fs = std::filesystem;
namespace v1 = btcheck::v1;

v1::Request request_for(std::string tree) {
  v1::Request request;
  request.tree = std::move(tree);
  return request;
}

std::string tree_of(const std::string& body, const std::string& more = "") {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">" + more +
         "<BehaviorTree ID=\"M\">" + body + "</BehaviorTree></root>";
}

TEST_CASE("findings stand where they are, with runs and repairs") {
  v1::Files files;
  files.add(
      "a.xml",
      tree_of("<ReactiveSequence><IsOpen/>\n<OpenDoor/>\n"
              "<Sequence><Go/></Sequence></ReactiveSequence>",
              "<TreeNodesModel><Condition ID=\"IsOpen\"/></TreeNodesModel>"));
  const v1::Report report = v1::check(request_for("a.xml"), files);
  CHECK(report.outcome == v1::Outcome::Met);
  CHECK(report.node_count == 6);
  CHECK(report.states > 10);
  CHECK(report.stopped.empty());
  const auto found =
      std::ranges::find(report.findings, "BT2211", &v1::Finding::code);
  REQUIRE(found != report.findings.end());
  CHECK(found->level == v1::Level::Warning);
  CHECK(found->where.file == "a.xml");
  CHECK(found->where.line == 2);
  CHECK(found->where.column == 2);
  CHECK(found->message.find("Help") == std::string::npos);
  CHECK_FALSE(found->help.empty());
  REQUIRE(found->run);
  CHECK(std::ranges::any_of(found->run->steps, [](const v1::Step& step) {
    return step.text == "OpenDoor -> success";
  }));
  const auto node =
      std::ranges::find(report.nodes, "OpenDoor", &v1::Node::type);
  CHECK(node == report.nodes.end());  // its type is Action
  CHECK(report.answers.size() == 7);
}

TEST_CASE("a run is told and shown by its name") {
  v1::Files files;
  files.add("a.xml", tree_of("<Sequence><Go/><Stop/></Sequence>"));
  v1::Request request = request_for("a.xml");
  const v1::Report plain = v1::check(request, files);
  const auto answer =
      std::ranges::find(plain.answers, "can_fail", &v1::Answer::key);
  REQUIRE(answer != plain.answers.end());
  REQUIRE(answer->run);
  CHECK(answer->run->name == "can_fail");
  CHECK(plain.html("can_fail").find("</html>") != std::string::npos);
  request.typed_rules = {"never Go.failure"};
  const v1::Report report = v1::check(request, files);
  REQUIRE(report.rules[0].run);
  CHECK(report.rules[0].run->name == report.rules[0].name);
  const std::string page = report.html(report.rules[0].name);
  CHECK(page.find("never Go.failure") != std::string::npos);
  CHECK(page == report.html(report.rules[0].name));
  CHECK(report.html("can_fail").empty());
  CHECK(report.html("").empty());
  CHECK(v1::lint(request, files).html(report.rules[0].name).empty());
  // The finding of the rule is told with the rule's run.
  const auto found =
      std::ranges::find(report.findings, "BT2001", &v1::Finding::code);
  REQUIRE(found != report.findings.end());
  REQUIRE(found->run);
  CHECK(found->run->name == report.rules[0].name);
  const auto runs = nlohmann::json::parse(report.runs_json())["runs"];
  REQUIRE(runs.size() == 2);
  CHECK(runs[0]["finding"].is_null());
  CHECK(runs[1]["finding"] == found - report.findings.begin());
  CHECK(runs[0]["steps"] == runs[1]["steps"]);
}

TEST_CASE("each text is parsed once, whatever is asked") {
  v1::Files files;
  files.add("a.xml", tree_of("<Sequence><Go/><SubTree ID=\"B\"/></Sequence>",
                             "<include path=\"b.xml\"/>"));
  files.add("b.xml",
            "<root BTCPP_format=\"4\"><BehaviorTree ID=\"B\"><Stop/>"
            "</BehaviorTree></root>");
  files.add("r.ltl", "property p: never Go.failure\n");
  v1::Request request = request_for("a.xml");
  const auto counted = [&](const auto& call) {
    const ParseCount count;
    call();
    CHECK(count.of_texts().size() == 2 + request.rules.size());
    for (const auto& [text, times] : count.of_texts()) {
      INFO(text);
      CHECK(times == 1);
    }
  };
  counted([&] { v1::describe(request, files); });
  counted([&] { v1::lint(request, files); });
  request.rules = {"r.ltl"};
  counted([&] { v1::lint(request, files); });
  counted([&] { v1::check(request, files); });
}

TEST_CASE("includes, neighbours, packages, models, contracts and rules") {
  v1::Files files;
  files.add("trees/a.xml",
            tree_of("<Sequence><SubTree ID=\"Inside\"/><SubTree ID=\"Near\"/>"
                    "<SubTree ID=\"Packed\"/></Sequence>",
                    "<include path=\"b.xml\"/>"
                    "<include ros_pkg=\"robot\" path=\"trees/p.xml\"/>"));
  files.add("trees/b.xml",
            "<root BTCPP_format=\"4\"><BehaviorTree "
            "ID=\"Inside\"><A/></BehaviorTree></root>");
  files.add("near.xml",
            "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Near\">"
            "<B/></BehaviorTree></root>");
  files.add("share/robot/trees/p.xml",
            "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Packed\"><C/>"
            "</BehaviorTree></root>");
  files.add_package("robot", "share/robot");
  files.add("c.leaves",
            "(defaction A :returns (success))\n"
            "(defaction B :returns (success))\n"
            "(defaction C :returns (success))\n");
  files.add("r.ltl", "property goes: never root.failure\n");
  v1::Request request = request_for("trees/a.xml");
  request.leaves = {"c.leaves"};
  request.rules = {"r.ltl"};
  request.typed_rules = {"never A.failure", "never C.success"};
  const v1::Report report = v1::check(request, files);
  for (const v1::Finding& each : report.findings) INFO(each.message);
  REQUIRE(report.rules.size() == 3);
  CHECK(report.rules[0].name == "goes");
  CHECK(report.rules[0].verdict == v1::Verdict::Holds);
  CHECK(report.rules[1].verdict == v1::Verdict::Holds);
  CHECK(report.rules[2].verdict == v1::Verdict::Violated);
  CHECK(report.rules[2].run);
  CHECK(report.outcome == v1::Outcome::Missed);
}

TEST_CASE("what is wrong is a finding, and nothing is checked") {
  v1::Files files;
  files.add("a.xml", tree_of("<Sequence><A/>"));
  const v1::Report torn = v1::check(request_for("a.xml"), files);
  CHECK(torn.outcome == v1::Outcome::BadInput);
  REQUIRE_FALSE(torn.findings.empty());
  CHECK(torn.findings[0].level == v1::Level::Error);
  const v1::Report gone = v1::check(request_for("b.xml"), files);
  CHECK(gone.outcome == v1::Outcome::BadInput);
  REQUIRE(gone.findings.size() == 1);
  CHECK(gone.findings[0].code == "BT0002");
  CHECK(gone.findings[0].where.file == "b.xml");
  v1::Request odd = request_for("a.xml");
  odd.profile = "btcpp-99";
  CHECK_THROWS_AS(v1::check(odd, files), std::invalid_argument);
}

TEST_CASE("who has no command line is told of fields of the request") {
  v1::Files files;
  files.add("a.btf", "(BehaviorTree :name t (Sequence (Action :ID A)))");
  files.add("two.xml",
            R"(<root BTCPP_format="4"><BehaviorTree ID="m"><A/></BehaviorTree>
               <BehaviorTree ID="n"><B/></BehaviorTree></root>)");
  v1::Request request = request_for("a.btf");
  request.main_tree = "t";
  const v1::Report refused = v1::check(request, files);
  REQUIRE(refused.findings.size() == 1);
  CHECK(refused.findings[0].message == "`main_tree` is for XML trees.");
  const v1::Report several = v1::check(request_for("two.xml"), files);
  REQUIRE(several.outcome == v1::Outcome::BadInput);
  CHECK(several.json().find("name one by `main_tree`, or in") !=
        std::string::npos);
  for (const std::string& text : {refused.json(), several.json()}) {
    CAPTURE(text);
    CHECK(text.find("--") == text.npos);
  }
}

TEST_CASE("lint reads and searches nothing, and codes are explained") {
  v1::Files files;
  files.add("a.xml", tree_of("<Fallback><AlwaysSuccess/><A/></Fallback>"));
  const v1::Report report = v1::lint(request_for("a.xml"), files);
  CHECK(report.outcome == v1::Outcome::Missed);
  CHECK(report.states == 0);
  CHECK(std::ranges::count(report.findings, "BT1629", &v1::Finding::code) == 1);
  const auto told = v1::explain("bt1629");
  REQUIRE(told);
  CHECK(told->code == "BT1629");
  CHECK_FALSE(told->description.empty());
  CHECK_FALSE(v1::explain("BT0000"));
}

// Counts how often it is asked, and ends the call.
class Ends final : public v1::Monitor {
 public:
  explicit Ends(double after) : after_(after) {}
  bool goes_on(const v1::Progress& progress) override {
    return progress.seconds < after_;
  }

 private:
  double after_;
};

std::string wide(int count) {
  std::string text = "(BehaviorTree :name t :loop 1 (ParallelAll";
  for (int i = 0; i < count; ++i)
    text += " (Action :ID a" + std::to_string(i) + ")";
  return text + "))";
}

double seconds_of(const auto& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin)
      .count();
}

TEST_CASE("a monitor ends a search, and reading") {
  v1::Files files;
  files.add("wide.btf", wide(16));
  std::string large = "<Sequence>";
  for (int i = 0; i < 4000; ++i) large += "<A/><B/>";
  files.add("large.xml", tree_of(large + "</Sequence>"));
  v1::Report report;
  Ends soon(0.2);
  // Generous, for a machine that does other things as well.
  CHECK(seconds_of([&] {
          report = v1::check(request_for("wide.btf"), files, &soon);
        }) < 10);
  CHECK(report.outcome == v1::Outcome::Undecided);
  CHECK(report.stopped == "interrupted");
  CHECK(report.states > 0);
  Ends at_once(0);
  const v1::Report unread =
      v1::check(request_for("large.xml"), files, &at_once);
  CHECK(unread.outcome == v1::Outcome::Undecided);
  REQUIRE(unread.findings.size() == 1);
  CHECK(unread.findings[0].code == "BT9003");
  CHECK(unread.stopped == "interrupted");
  v1::Request limited = request_for("wide.btf");
  limited.seconds = 0.2;
  CHECK(v1::check(limited, files).stopped == "timeout");
  limited = request_for("wide.btf");
  limited.states = 5000;
  CHECK(v1::check(limited, files).stopped == "max-states");
}

TEST_CASE("reports are those of the program") {
  for (const std::string name : {"drone1.btf", "nav2.btf"}) {
    CAPTURE(name);
    const fs::path folder = BTCHECK_EXAMPLES;
    v1::Files files;
    files.add(name, file_text(folder / name));
    const v1::Report report = v1::check(request_for(name), files);
    const Outcome told =
        run_in(folder, "'" BTCHECK_PROGRAM "' " + name +
                           " --no-config --format json 2>/dev/null");
    const bool are_same = comparable(report.json()) == comparable(told.text);
    CHECK(are_same);
    CHECK(static_cast<int>(report.outcome) == told.code);
  }
}

TEST_CASE("calls in several threads know nothing of each other") {
  const std::string name = "drone1.btf";
  v1::Files files;
  files.add(name, file_text(fs::path(BTCHECK_EXAMPLES) / name));
  files.add("a.xml",
            tree_of("<ReactiveSequence><IsOpen/><A/><B/></ReactiveSequence>"));
  const auto whole = [&](const std::string& tree) {
    return comparable(v1::check(request_for(tree), files).json());
  };
  const std::vector<nlohmann::json> alone = {whole(name), whole("a.xml")};
  const int rounds = std::getenv("BTCHECK_LONG") != nullptr ? 200 : 20;
  std::vector<int> different(8, 0);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < different.size(); ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < rounds; ++i) {
        const std::size_t which = (t + static_cast<std::size_t>(i)) % 2;
        different[t] += whole(which == 0 ? name : "a.xml") != alone[which];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const int count : different) CHECK(count == 0);
}

}  // namespace
}  // namespace btcheck::api_test
