// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <regex>
#include <set>
#include <string>

#include "suites/made_suite.hpp"

namespace suite_test {

using namespace btcheck;
using namespace btcheck::suite_tests;

const std::string kMission = R"(<root BTCPP_format="4">
<BehaviorTree ID="Deliver">
<Fallback name="mission">
<Sequence name="deliver"><IsReady/><RetryUntilSuccessful name="again" num_attempts="2"><GoTo/></RetryUntilSuccessful><Drop/></Sequence>
<GoHome/>
</Fallback>
</BehaviorTree>
<TreeNodesModel><Condition ID="IsReady"/><Action ID="GoTo"/><Action ID="Drop"/><Action ID="GoHome"/></TreeNodesModel>
</root>)";

const std::string kGuarded = R"(<root BTCPP_format="4">
<BehaviorTree ID="Guarded">
<Sequence name="s">
<Act _skipIf="level &lt; 3" _while="mode == 'auto'"/>
<Fallback name="f"><ScriptCondition code="level >= 7" name="high"/><Act name="b"/></Fallback>
</Sequence>
</BehaviorTree>
<TreeNodesModel><Action ID="Act"/></TreeNodesModel>
</root>)";

const std::string kTimed = R"(<root BTCPP_format="4">
<BehaviorTree ID="Timed">
<Sequence name="s"><Act/><Sleep msec="1000" name="nap"/><Act name="b"/></Sequence>
</BehaviorTree>
<TreeNodesModel><Action ID="Act"/></TreeNodesModel>
</root>)";

const std::string kFree = R"(<root BTCPP_format="4">
<BehaviorTree ID="Free"><Sequence name="s"><Own name="own"><Act/><Act name="b"/></Own></Sequence></BehaviorTree>
<TreeNodesModel><Action ID="Act"/><Control ID="Own"/></TreeNodesModel>
</root>)";

void check_names(const Suite& suite) {
  std::set<std::string> names;
  static const std::regex kName("[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*");
  for (const SuiteTest& test : suite.tests) {
    CAPTURE(test.name);
    CHECK(std::regex_match(test.name, kName));
    CHECK(names.insert(test.name).second);
    CHECK_FALSE(test.about.empty());
  }
}

// Each test again, by the script that it is.
void check_played(const MadeSuite& made) {
  for (const SuiteTest& test : made.suite.tests) {
    CAPTURE(test.name);
    REQUIRE(test.has_script);
    CHECK(played(made, test) == expected(made, test));
  }
}

TEST_CASE("all that is possible is reached, by few tests") {
  const MadeSuite made(input_of(kMission));
  CHECK(suite_summary(made.suite, made.tree()) ==
        "6 tests reach 20 of 20 answers and halts that are proven possible "
        "(100 %)\n");
  CHECK(made.suite.is_complete);
  CHECK(made.suite.edges == made.suite.forced_edges);
  check_names(made.suite);
  check_played(made);
}

TEST_CASE("a guard on an entry of the program comes out both ways") {
  const MadeSuite made(input_of(kGuarded));
  REQUIRE(made.driven);
  CHECK(made.driven->contracts ==
        "(defsv level :states (2 3 4 6 7 8) :init 2 :moves free)\n"
        "(defsv mode :states (\"auto\" \"other\") :init \"auto\" :moves "
        "free)\n");
  CHECK(suite_summary(made.suite, made.tree()).find("(100 %)") !=
        std::string::npos);
  check_names(made.suite);
  check_played(made);
  const auto writes =
      std::ranges::count_if(made.suite.tests, [](const SuiteTest& test) {
        return std::ranges::any_of(test.ticks, [](const SuiteTick& tick) {
          return !tick.before.empty();
        });
      });
  CHECK(writes > 0);
}

TEST_CASE("what takes time is left out by name") {
  const MadeSuite made(input_of(kTimed));
  const std::string summary = suite_summary(made.suite, made.tree());
  CHECK(summary.find("left out by name:") != std::string::npos);
  CHECK(summary.find("  real time: nap: s success, nap success, b success, b "
                     "failure, b running\n") != std::string::npos);
  check_played(made);
}

TEST_CASE("what a control node of the program does is left out by name") {
  const MadeSuite made(input_of(kFree));
  CHECK(made.suite.tests.empty());
  CHECK(suite_summary(made.suite, made.tree()).find("  own: ") !=
        std::string::npos);
  CHECK(made.described.unknown == std::vector<std::string>{"Own"});
}

TEST_CASE("a run that is asked for is told with what it is about") {
  const MadeSuite made(input_of(kMission));
  const CompiledNetwork system(made.network());
  const ForcedNetwork forced(made.tree(), system);
  const DefaultReport defaults =
      check_defaults(made.tree(), system, Reduction::None, {});
  const auto failure =
      std::ranges::find_if(defaults.tree, [](const TreeReport& report) {
        return report.question == TreeQuestion::CanFail;
      });
  REQUIRE(failure != defaults.tree.end());
  const NamedRun run{"the mission can fail", "BT2105", failure->run->steps()};
  const Suite suite = make_suite(forced, forced, defaults, {run}, {});
  REQUIRE_FALSE(suite.tests.empty());
  CHECK(suite.tests[0].name == "the_mission_can_fail");
  CHECK(suite.tests[0].code == "BT2105");
  CHECK(suite.tests[0].ticks.back().root == "failure");
}

TEST_CASE("the tree is told with what it uses, and no more") {
  const std::string two =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Other\"><Gone/>"
      "</BehaviorTree><BehaviorTree ID=\"Sub\"><Act/></BehaviorTree>"
      "<BehaviorTree ID=\"Main\"><SubTree ID=\"Sub\"/></BehaviorTree></root>";
  TreeInput input = input_of(two);
  input.reading.main_tree = "Main";
  const MadeSuite made(input);
  CHECK(made.described.xml ==
        "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main\">\n"
        "  <BehaviorTree ID=\"Sub\"><Act/></BehaviorTree>\n"
        "  <BehaviorTree ID=\"Main\"><SubTree ID=\"Sub\"/></BehaviorTree>\n"
        "</root>\n");
  const MadeSuite unnamed(input_of(
      "<root BTCPP_format=\"4\"><BehaviorTree><Act/></BehaviorTree></root>"));
  CHECK(unnamed.described.xml ==
        "<root BTCPP_format=\"4\">\n"
        "  <BehaviorTree><Act/></BehaviorTree>\n</root>\n");
}

TEST_CASE("identifiers") {
  CHECK(identifier("[No] -> Find ball") == "No_Find_ball");
  CHECK(identifier("2nd try") == "t2nd_try");
  CHECK(identifier("über") == "ber");
  CHECK(identifier("") == "test");
}

TEST_CASE("the files say what the tests do") {
  const MadeSuite made(input_of(kTimed));
  const auto files = googletest_files(made.described, made.tree(), made.suite);
  REQUIRE(files.size() == 2);
  CHECK(files[0].name == "t_test.cpp");
  const std::string& text = files[0].text;
  CHECK(text.find("// s fails after Act failed\n"
                  "TEST(t, s_fails_after_Act_failed) {\n"
                  "  ScriptedRun run(kTree);\n"
                  "  run.leaf(\"Act\", \"failure\");\n"
                  "  EXPECT_EQ(run.tick(),\n"
                  "            \"root=failure s=failure Act=failure\") << "
                  "run.why();\n}\n") != std::string::npos);
  CHECK(text.find("left out by name: ") != std::string::npos);
  CHECK(files[1].name == "CMakeLists.txt");
  const SuiteFile python = pytest_file(made.described, made.tree(), made.suite,
                                       {"simulate", "t.xml"});
  CHECK(python.name == "test_t.py");
  CHECK(python.text.find("    \"s_fails_after_Act_failed\": (\n"
                         "        \"Act: failure\\n\"\n"
                         "        ,\n        [\n"
                         "            \"root=failure s=failure Act=failure\",\n"
                         "        ]),\n") != std::string::npos);
  const SuiteFile lines = jsonl_file(made.described, made.tree(), made.suite);
  CHECK(lines.name == "t.tests.jsonl");
  CHECK(std::ranges::count(lines.text, '\n') ==
        static_cast<std::ptrdiff_t>(made.suite.tests.size()) + 1);
}

}  // namespace suite_test
