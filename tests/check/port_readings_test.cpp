// SPDX-License-Identifier: MIT
//
// A number that the engine's own nodes read by a port: what BehaviorTree.CPP
// 4.10.0 did of each, in three ticks.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "check/check.hpp"

namespace btcheck::port_readings_test {
namespace {

constexpr std::string_view kReaders[] = {
    R"(<Repeat num_cycles="{n}"><AlwaysSuccess/></Repeat>)",
    R"(<RetryUntilSuccessful num_attempts="{n}"><AlwaysSuccess/></RetryUntilSuccessful>)",
    R"(<Delay delay_msec="{n}"><AlwaysSuccess/></Delay>)",
    R"(<Timeout msec="{n}"><AlwaysSuccess/></Timeout>)",
    R"(<Sleep msec="{n}"/>)"};

// What comes before, and the readers that throw then, as `x`. The ports give
// the entry its type, so that some of the texts throw where they are written.
struct Recorded {
  std::string_view before;
  std::string_view throwing;
};
constexpr Recorded kRecorded[] = {
    {R"(<Script code="n := 2"/>)", "-----"},
    {R"(<Script code="n := 2.5"/>)", "xxxxx"},
    {R"(<Script code="n := -1"/>)", "--xxx"},
    {R"(<Script code="n := '3'"/>)", "-----"},
    {R"(<Script code="n := '2.5'"/>)", "-----"},
    {R"(<Script code="n := 'abc'"/>)", "xxxxx"},
    {R"(<Script code="n := 1 + 1"/>)", "-----"},
    {R"(<Script code="n := 3000000000"/>)", "xx---"},
    {R"(<Script code="n := 5000000000"/>)", "xxxxx"},
    {R"(<Script code="n := true"/>)", "-----"},
    {R"(<Script code="n := -0.5"/>)", "xxxxx"},
    {R"(<Script code="n := 0.5 * 3"/>)", "xxxxx"},
    {R"(<Script code="n := 1 - 3"/>)", "--xxx"},
    {R"(<Script code="n := 0"/>)", "-----"},
    {R"(<SetBlackboard value="2" output_key="n"/>)", "-----"},
    {R"(<SetBlackboard value="2.5" output_key="n"/>)", "-----"},
    {R"(<SetBlackboard value="-1" output_key="n"/>)", "--xxx"},
    {R"(<SetBlackboard value="abc" output_key="n"/>)", "xxxxx"},
    {R"(<SetBlackboard value="" output_key="n"/>)", "xxxxx"},
    {R"(<Sequence><Script code="n := 2"/><UnsetBlackboard key="n"/></Sequence>)",
     "xxxxx"},
    {R"(<AlwaysSuccess/>)", "xxxxx"},
    {R"(<Script code="n := 0.0/0"/>)", "xxxxx"},
    {R"(<Script code="n := 1.0/0"/>)", "xxxxx"},
};

std::string tree(std::string_view before, std::string_view reader,
                 std::string_view after = "") {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">"
         "<BehaviorTree ID=\"M\"><Sequence>" +
         std::string(before) + std::string(reader) + std::string(after) +
         "</Sequence></BehaviorTree></root>";
}

Verdict no_fault(const std::string& text) {
  const CheckResult result = check({"t.xml", text}, {}, {});
  REQUIRE(result.files.size() == 1);
  for (const TreeReport& answer : result.files[0].defaults->tree) {
    if (answer.question == TreeQuestion::InRange) return answer.verdict;
  }
  return Verdict::Holds;  // not asked where nothing can throw
}

TEST_CASE("ports of numbers throw where the engine's do") {
  for (const Recorded& each : kRecorded) {
    for (std::size_t i = 0; i < std::size(kReaders); ++i) {
      // A value that is written later is not there yet.
      const bool is_late = each.before == "<AlwaysSuccess/>";
      const std::string text = tree(each.before, kReaders[i],
                                    is_late ? "<Script code=\"n := 1\"/>" : "");
      CAPTURE(text);
      CHECK(no_fault(text) ==
            (each.throwing[i] == 'x' ? Verdict::Violated : Verdict::Holds));
    }
  }
}

TEST_CASE("a Sleep reads when it begins, others in each tick") {
  const std::string beside =
      "<Script code=\"n := 0 - 1\" _onSuccess=\"x := 1\"/>";
  const auto parallel = [&](std::string_view reader) {
    return tree(
        "<Script code=\"n := 1000\"/>",
        "<ParallelAll>" + std::string(reader) + beside + "</ParallelAll>");
  };
  CHECK(no_fault(parallel(kReaders[4])) == Verdict::Holds);
  CHECK(no_fault(parallel("<Delay delay_msec=\"{n}\"><AlwaysSuccess/>"
                          "</Delay>")) == Verdict::Violated);
}

TEST_CASE("what a leaf or the program writes is taken to suit") {
  const std::string models =
      "<TreeNodesModel><Action ID=\"Plan\"><output_port name=\"out\" "
      "type=\"int\"/></Action></TreeNodesModel></root>";
  std::string text = tree("<Plan out=\"{n}\"/>", kReaders[0]);
  text.replace(text.rfind("</root>"), 7, models);
  CHECK(no_fault(text) == Verdict::Holds);
  CHECK(no_fault(tree("", kReaders[0])) == Verdict::Holds);
  // Nor does what is counted up leave 32 bits.
  CHECK(no_fault(tree("<Script code=\"n := 1\"/>",
                      "<Repeat num_cycles=\"{n}\"><Script code=\"n += 1\"/>"
                      "</Repeat>")) == Verdict::Holds);
}

}  // namespace
}  // namespace btcheck::port_readings_test
