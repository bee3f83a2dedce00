// SPDX-License-Identifier: MIT
//
// Nodes that are skipped: told with the reason, shown as what they are, and
// written and read again.
#include "trace/run/skipping.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "check/asked.hpp"
#include "trace/pictures/pictures.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/record.hpp"
#include "trace/why/why.hpp"

namespace btcheck::skipping_test {
namespace {

// The run that breaks the rule over the tree, and why.
struct Broken {
  RecordedRun run;
  std::string why;
};

Broken broken(const std::string& tree, const std::string& rule) {
  const CheckResult result = checked({tree}, {{"p.ltl", rule}});
  const CheckedFile& file = result.files[0];
  const PropertyVerdict& verdict = file.verdicts[0];
  REQUIRE(verdict.verdict == Verdict::Violated);
  return {recorded(*result.tree, *file.network, *verdict.run, {}),
          why(*result.tree, *file.network, *verdict.run, verdict.subjects,
              verdict.trigger_state)};
}

// What is told of nodes that are skipped.
std::vector<std::string> skips(const RecordedRun& run) {
  std::vector<std::string> events;
  for (const RecordedState& state : run.states) {
    if (state.event.find("-> skipped") != std::string::npos) {
      events.push_back(state.event);
    }
  }
  return events;
}

using Events = std::vector<std::string>;

// The phase of a node in the last state.
std::string phase_of(const RecordedRun& run, const std::string& name) {
  const auto node = std::ranges::find(run.nodes, name, &RecordedNode::name);
  REQUIRE(node != run.nodes.end());
  return shown_phase(run.states.back(),
                     static_cast<std::size_t>(node - run.nodes.begin()));
}

const std::string kDocked = "<Script code=\"docked := true\"/>";

TEST_CASE("a node that is skipped says which condition did it") {
  const Broken found = broken(
      "<Sequence>" + kDocked +
          "<AlwaysSuccess name=\"a\" _skipIf=\"docked\"/>"
          "<AlwaysSuccess name=\"b\" _while=\"!docked\"/>"
          "<Sequence name=\"s\" _skipIf=\"docked\"><AlwaysSuccess/></Sequence>"
          "<AlwaysSuccess name=\"e\"/></Sequence>",
      "prove never e.success");
  CHECK(skips(found.run) == Events{"a -> skipped: `docked` is true",
                                   "b -> skipped: `!docked` is false",
                                   "s -> skipped: `docked` is true"});
  CHECK(phase_of(found.run, "a") == "skipped");
  CHECK(phase_of(found.run, "s") == "skipped");
}

TEST_CASE("a node is skipped because what is below it was") {
  const std::string skipped = "<AlwaysSuccess _skipIf=\"docked\"";
  const Broken found = broken(
      "<Sequence>" + kDocked + "<Inverter name=\"i\">" + skipped +
          "/></Inverter><Fallback name=\"f\">" + skipped + "/>" + skipped +
          "/></Fallback>"
          "<IfThenElse name=\"t\"><AlwaysSuccess/>" +
          skipped + " name=\"branch\"/></IfThenElse>" +
          "<AlwaysSuccess name=\"e\"/></Sequence>",
      "prove never e.success");
  Events told = skips(found.run);
  std::erase_if(told, [](const std::string& event) {
    return event.find("`") != std::string::npos;
  });
  CHECK(told == Events{"i -> skipped: its child was skipped",
                       "f -> skipped: all its children were skipped",
                       "t -> skipped: branch was skipped"});
}

TEST_CASE("a node that halts itself is skipped by its _while") {
  const Broken found = broken(
      "<ReactiveSequence><Script code=\"k := k + 1\"/>"
      "<Sleep name=\"a\" msec=\"1000\" _while=\"k &lt; 2\"/>"
      "</ReactiveSequence>",
      "prove never a.skipped");
  CHECK(skips(found.run) == Events{"a -> skipped: `k < 2` is false"});
}

TEST_CASE("a tree that is skipped as a whole tells it at its root") {
  const Broken found = broken("<AlwaysSuccess name=\"a\" _skipIf=\"1\"/>",
                              "prove never a.skipped");
  CHECK(skips(found.run) == Events{"a -> skipped: `1` is true"});
}

TEST_CASE("a skipped node has a look and a sign of its own, and comes back") {
  const Broken found = broken("<Sequence>" + kDocked +
                                  "<AlwaysSuccess name=\"a\""
                                  " _skipIf=\"docked\"/>"
                                  "<AlwaysSuccess name=\"e\"/></Sequence>",
                              "prove never e.success");
  const std::size_t last = found.run.states.size() - 1;
  const std::string fill(look_of(Phase::Skipped).fill);
  CHECK(dot_text(found.run, last).find("\"» a\"") != std::string::npos);
  CHECK(dot_text(found.run, last).find(fill) != std::string::npos);
  CHECK(mermaid_text(found.run, last).find(":::skipped") != std::string::npos);
  CHECK(svg_text(found.run, last).find(": skipped</title>") !=
        std::string::npos);
  const auto read = read_itf("run", itf_text(found.run));
  REQUIRE(read.value);
  CHECK(*read.value == found.run);
}

TEST_CASE("what is waited for and skipped is the reason") {
  const std::string rule =
      "prove whenever a.success then b.success within 2 ticks";
  const auto over = [&](const std::string& rest) {
    return broken("<Sequence><AlwaysSuccess name=\"a\"/>" + kDocked + rest +
                      "</Sequence>",
                  rule)
        .why;
  };
  CHECK(over("<AlwaysSuccess name=\"b\" _skipIf=\"docked\"/>") ==
        "b is skipped in tick 3 because `docked` is true.");
  CHECK(over("<Inverter name=\"i\" _skipIf=\"docked\">"
             "<AlwaysSuccess name=\"b\"/></Inverter>") ==
        "i, above b, is skipped in tick 3 because `docked` is true.");
}

}  // namespace
}  // namespace btcheck::skipping_test
