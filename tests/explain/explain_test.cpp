// SPDX-License-Identifier: MIT
//
// Logs whose reason is known: one for each kind of answer.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "explain/scripted_log.hpp"

namespace btcheck::explain_log_test {
namespace {

// A mission that docks, three times if need be, and then charges.
const std::string kDock = R"(<Sequence name="mission">
  <RetryUntilSuccessful name="retry" num_attempts="3">
    <Dock name="dock"/>
  </RetryUntilSuccessful>
  <Charge name="charge"/>
</Sequence>)";
constexpr std::string_view kActions =
    "(defaction Dock)\n(defaction Charge)\n(defaction Undock)\n";

std::string leaves(const std::string& more = "") {
  return std::string(kActions) + more;
}

std::vector<std::string> words(const Suspect& suspect) {
  std::vector<std::string> all;
  for (const InjectedFault& each : suspect.faults) {
    all.emplace_back(facts_of(each.fault.kind).word);
  }
  return all;
}

using Words = std::vector<std::string>;

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a leaf that fails whenever it is asked") {
  ScriptedTreeLog log(kDock, leaves(), "Dock: failure\ncharge: success\n");
  const Explanation found = log.explained();
  REQUIRE(found.suspects.single.size() == 1);
  CHECK(found.suspects.is_needed());
  const Suspect& suspect = found.suspects.single[0];
  CHECK(short_name(log.tree(), suspect.leaf) == "dock");
  CHECK(words(suspect) == Words{"fails", "fails-for-ever"});
  CHECK(suspect.at.size() == 3);
  const std::string text = log.text(found);
  CAPTURE(text);
  CHECK(has(text, "t.btlog: the mission failed in tick"));
  CHECK(has(text, "  `mission` failed"));
  CHECK(has(text, "    because `retry` failed"));
  CHECK(has(text, "      because `dock` failed in ticks"));
  CHECK(has(text, "The fault: `dock` fails whenever it is asked: in ticks"));
  CHECK(has(text, "of `btcheck whatif`, fails: the mission always fails"));
  // The third attempt decides it; a success of it would not have.
  REQUIRE(found.last_way.has_value());
  REQUIRE(found.last_way->moment.has_value());
  CHECK(has(text, "`dock` failed\n"));
  CHECK(has(text, "`dock` succeeds, then `charge` succeeds"));
  CHECK(found.is_hopeless_with_fault);
}

TEST_CASE("a leaf that runs before it fails") {
  ScriptedTreeLog log(
      kDock, leaves(),
      "Dock: running failure running failure running failure\n");
  const Explanation found = log.explained();
  REQUIRE(found.suspects.single.size() == 1);
  CHECK(words(found.suspects.single[0]) == Words{"fails", "fails-for-ever"});
  CHECK(has(log.text(found),
            "`dock` fails whenever it is asked: in ticks 2, 3 and 4"));
}

TEST_CASE("once, for ever from a tick on, and what does not tell them apart") {
  const std::string twice = R"(<Sequence name="mission">
    <Dock name="first"/><Charge/><Dock name="dock"/><Undock/></Sequence>)";
  {
    ScriptedTreeLog log(twice, leaves(), "first: success\ndock: failure\n");
    const Explanation found = log.explained();
    REQUIRE(found.suspects.single.size() == 1);
    CHECK(words(found.suspects.single[0]) ==
          Words{"fails", "fails-once", "fails-for-ever"});
    CHECK(has(log.text(found), "once or for ever: it was asked once"));
  }
  const std::string again = R"(<Repeat num_cycles="4" name="again">
    <Fallback name="way"><Dock name="dock"/><Charge name="charge"/></Fallback>
    </Repeat>)";
  {
    ScriptedTreeLog log(again, leaves(),
                        "dock: success failure success success\n"
                        "charge: success\n");
    const Explanation found = log.explained();
    REQUIRE(found.suspects.single.size() == 1);
    CHECK(words(found.suspects.single[0]) == Words{"fails-once"});
    CHECK(has(log.text(found), "`dock` fails once, in tick"));
    CHECK(has(log.text(found), "the mission succeeded"));
    CHECK(!found.last_way.has_value());
  }
  {
    ScriptedTreeLog log(again, leaves(),
                        "dock: success failure failure failure\n"
                        "charge: success\n");
    const Explanation found = log.explained();
    REQUIRE(found.suspects.single.size() == 1);
    CHECK(words(found.suspects.single[0]) == Words{"fails-for-ever"});
    CHECK(has(log.text(found), "`dock` fails for ever from tick"));
  }
  {
    ScriptedTreeLog log(again, leaves(),
                        "dock: success success success failure\n"
                        "charge: success\n");
    const Explanation found = log.explained();
    REQUIRE(found.suspects.single.size() == 1);
    CHECK(words(found.suspects.single[0]) ==
          Words{"fails-once", "fails-for-ever"});
    CHECK(has(log.text(found), "once or for ever: it was not asked again"));
  }
}

TEST_CASE("a leaf that does not end") {
  ScriptedTreeLog log(kDock, leaves(), "Dock: success\ncharge: running\n", 12);
  const Explanation found = log.explained();
  CHECK(!found.suspects.is_needed());
  REQUIRE(found.suspects.single.size() == 1);
  CHECK(words(found.suspects.single[0]) == Words{"never-ends", "late"});
  const std::string text = log.text(found);
  CAPTURE(text);
  CHECK(has(text, "the log ends in tick"));
  CHECK(has(text, "because `charge` runs since tick"));
  CHECK(has(text, "No fault is needed for it"));
  CHECK(has(text,
            "If one: `charge` never ends, or ends late: it runs since tick"));
  CHECK(has(text, "where the log ends it can still succeed"));
}

TEST_CASE("a leaf that takes longer than its contract says") {
  const std::string timed =
      "(defaction Dock :duration [1,2])\n(defaction Charge)\n";
  const std::string tree = R"(<Sequence name="mission"><Dock name="dock"/>
    <Charge name="charge"/></Sequence>)";
  // A log of another contract, which does not say so.
  ScriptedTreeLog late(tree, leaves(), "Dock: running*5 success\n");
  ScriptedTreeLog log(tree, timed, "Dock: running*1 success\n");
  log.log() = late.log();
  const Explanation found = log.explained();
  CHECK(found.followed.refused.has_value());
  CHECK(!found.is_refused());
  REQUIRE(!found.suspects.single.empty());
  CHECK(words(found.suspects.single[0]) == Words{"late"});
  CHECK(has(log.text(found), "The fault: `dock` ends late, in tick"));
}

TEST_CASE("conditions that answer so are no fault") {
  const std::string tree = R"(<Sequence name="mission">
    <Condition ID="Charged" name="charged"/><Dock name="dock"/></Sequence>)";
  ScriptedTreeLog log(tree, leaves("(defcondition Charged)\n"),
                      "charged: failure\n");
  const Explanation found = log.explained();
  CHECK(!found.suspects.is_needed());
  const std::string text = log.text(found);
  CAPTURE(text);
  CHECK(has(text, "No fault: it ended so by what conditions answered"));
  CHECK(has(text, "If one: `charged` fails"));
  CHECK(has(text, "Decided in tick 1: `charged` failed"));
}

TEST_CASE("two leaves that fail are told together") {
  const std::string tree = R"(<Fallback name="mission"><Dock name="dock"/>
    <Charge name="charge"/></Fallback>)";
  ScriptedTreeLog log(tree, leaves(), "dock: failure\ncharge: failure\n");
  const Explanation found = log.explained();
  CHECK(found.suspects.single.empty());
  CHECK(found.suspects.together.size() == 2);
  const std::string text = log.text(found);
  CAPTURE(text);
  CHECK(has(text, "No single fault explains it; these do together:\n"));
  CHECK(has(text, "  `dock` fails in tick 1"));
  CHECK(has(text, "  `charge` fails in tick 1"));
}

TEST_CASE("a log that another tree has written, an empty one, and a limit") {
  ScriptedTreeLog log(kDock, leaves(), "Dock: failure\n");
  const Explanation whole = log.explained();
  {
    // Without its second attempt.
    auto& records = log.log().transitions;
    const auto failure = std::ranges::find_if(records, [](const auto& each) {
      return each.after == LogStatus::Failure;
    });
    REQUIRE(failure != records.end());
    records.erase(failure);
    const Explanation found = log.explained();
    CHECK(found.is_refused());
    CHECK(has(log.text(found),
              "The tree cannot have written this log: not its "
              "record"));
  }
  log.log().transitions.clear();
  const Explanation nothing = log.explained();
  CHECK(nothing.causes.empty());
  CHECK(has(log.text(nothing), "nothing has happened (0 records)"));

  ScriptedTreeLog other(kDock, leaves(), "Dock: failure\n");
  Limits limits;
  limits.max_states = 1;
  const Explanation stopped = other.explained(limits);
  CHECK(stopped.stopped == StopReason::MaxStates);
  CHECK(has(other.text(stopped), "Undecided: "));
  CHECK(whole.stopped == StopReason::None);
}

TEST_CASE("an exception is put down to the leaf that was asked") {
  ScriptedTreeLog log(kDock, leaves(), "Dock: success\ncharge: running\n", 1);
  // What an observer has written of a Dock that throws.
  BehaviorLog& thrown = log.log();
  thrown.begin = 1;
  thrown.transitions.clear();
  LogMarks& marks = thrown.marks.emplace();
  marks.texts = {"no laser"};
  marks.events = {{.kind = MarkKind::TickBegins}};
  for (const LogNode& node : thrown.nodes) {
    if (node.name == "charge") continue;
    marks.events.push_back({.kind = MarkKind::NodeBegins, .uid = node.uid});
    if (node.name == "dock") continue;
    marks.events.push_back({.kind = MarkKind::Record});
    thrown.transitions.push_back(
        {0, node.uid, LogStatus::Idle, LogStatus::Running});
  }
  marks.events.push_back({.kind = MarkKind::TickIsLeft, .number = 0});
  const Explanation found = log.explained();
  const std::string text = log.text(found);
  CAPTURE(text);
  REQUIRE(found.suspects.single.size() == 1);
  CHECK(words(found.suspects.single[0]) == Words{"throws"});
  CHECK(has(text, "an exception left the tree in tick 1: no laser"));
  CHECK(has(text, "The fault: `dock` throws an exception in tick 1"));
}

TEST_CASE("a finding of the check is told where the log shows it") {
  // Whether it could arm or not, it takes off.
  const std::string tree = R"(<Sequence name="mission">
    <Fallback name="arm"><ArmNozzles/><WarnPilot/></Fallback>
    <TakeOff/></Sequence>)";
  const std::string known =
      "(defaction ArmNozzles)\n(defaction WarnPilot)\n(defaction TakeOff)\n";
  ScriptedTreeLog shown(tree, known,
                        "ArmNozzles: failure\nWarnPilot: success\n"
                        "TakeOff: success\n");
  const Explanation found = shown.explained();
  REQUIRE(found.findings.size() == 1);
  CHECK(found.findings[0].code == "BT2207");
  CHECK(found.findings[0].tick == 1);
  CHECK(has(shown.text(found),
            "The log shows what a check of the tree finds:\n"
            "  BT2207 in tick 1, line 4: "));
  ScriptedTreeLog well(tree, known, "ArmNozzles: success\nTakeOff: success\n");
  CHECK(well.explained().findings.empty());
}

TEST_CASE("the whole text, and the same as JSON") {
  ScriptedTreeLog log(kDock, leaves(), "Dock: failure\n");
  const Explanation found = log.explained();
  CHECK(log.text(found) == R"(t.btlog: the mission failed in tick 3 (12 records)
  `mission` failed in tick 3
    because `retry` failed in tick 3
      because `dock` failed in ticks 1, 2 and 3

The fault: `dock` fails whenever it is asked: in ticks 1, 2 and 3
  row 5 of `btcheck whatif`, fails: the mission always fails
  row 6 of `btcheck whatif`, fails-for-ever: the mission always fails

Decided in tick 3: `dock` failed
  the nearest way to success from there: `dock` succeeds, then `charge` succeeds
With this fault, and all else working, it could not have succeeded
)");
  const std::string json = log.json(found);
  CHECK(has(json, "\"schema\": \"btcheck-run-explanation/1\""));
  CHECK(has(json, "\"outcome\": \"failure\""));
  CHECK(has(json, "\"fails-for-ever\""));
}

}  // namespace btcheck::explain_log_test
