// SPDX-License-Identifier: MIT
//
// What a tree is suspected of, and what a search makes of it. (All kinds, on
// whole trees: tests/regress/findings_test.cpp.)
#include "check/findings/findings.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include "check/check.hpp"
#include "check/findings/judgement.hpp"
#include "file_text.hpp"
#include "model/tree/leaf_names.hpp"

namespace btcheck::findings_test {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : " ") + word;
  return text;
}

enum class Told : std::uint8_t { Findings, Questions };

// "BT2208 checks: A B": the code, the node and the others of each.
std::string found_in(const std::string& body, const std::string& models,
                     CheckOptions options = {}, Told wanted = Told::Findings) {
  const std::string text =
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"T\">"
      "<BehaviorTree ID=\"T\">\n" +
      body + "\n</BehaviorTree><TreeNodesModel>" + models +
      "</TreeNodesModel></root>";
  const CheckResult result = check({"t.xml", text}, {}, options);
  REQUIRE(result.files.size() == 1);
  std::string found;
  for (const TreeFinding& each : result.files[0].findings) {
    CHECK((each.run.has_value() || each.code != "BT2207"));
    if (is_question(each) != (wanted == Told::Questions)) continue;
    found += (found.empty() ? "" : "; ") + std::string(each.code) + " " +
             result.tree->node(each.node).name;
    if (each.severity == Severity::Error) found += "!";
    if (each.severity == Severity::Note) found += "?";
  }
  return found;
}

std::string asked_in(const std::string& body, const std::string& models) {
  return found_in(body, models, {}, Told::Questions);
}

// The message and the mechanism of the first finding.
std::string first_words(const std::string& body, const std::string& models) {
  const std::string text =
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"T\">"
      "<BehaviorTree ID=\"T\">\n" +
      body + "\n</BehaviorTree><TreeNodesModel>" + models +
      "</TreeNodesModel></root>";
  const CheckResult result = check({"t.xml", text}, {}, {});
  REQUIRE(result.files.size() == 1);
  REQUIRE(!result.files[0].findings.empty());
  const TreeFinding& first = result.files[0].findings[0];
  return first.message + "; " + first.why;
}

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != text.npos;
}

constexpr const char* kThree =
    "<Action ID=\"A\"/><Action ID=\"B\"/><Action ID=\"C\"/>"
    "<Condition ID=\"IsOpen\"/><Condition ID=\"BatteryOk\"/>";

TEST_CASE("names fall into words") {
  CHECK(joined(words_in("IsBatteryLow")) == "is battery low");
  CHECK(joined(words_in("is_battery_low")) == "is battery low");
  CHECK(joined(words_in("GPSLinkOK")) == "gps link ok");
  CHECK(joined(words_in("PubNav2Goal")) == "pub nav 2 goal");
  CHECK(joined(words_in("")) == "");
}

TEST_CASE("a condition brings good or bad tidings") {
  CHECK(tidings_of("BatteryOk") == Tidings::Good);
  CHECK(tidings_of("WindBelowLimit") == Tidings::Good);
  CHECK(tidings_of("IsBatteryLow") == Tidings::Bad);
  CHECK(tidings_of("is_mission_aborted") == Tidings::Bad);
  CHECK(tidings_of("IsNotStuck") == Tidings::Good);
  CHECK(tidings_of("NeedsCharge") == Tidings::Neither);
}

TEST_CASE("what is begun is undone by a name of the same words") {
  CHECK(joined(words_of_undoing("StartVacuum")) == "stop vacuum");
  CHECK(joined(words_of_undoing("Switch_On")) == "switch off");
  CHECK(words_of_undoing("Drive").empty());
}

TEST_CASE("a condition is asked once, before what may last") {
  CHECK(asked_in("<Sequence><IsOpen/><A/></Sequence>", kThree) ==
        "BT2501 IsOpen?");
  CHECK(asked_in("<ReactiveSequence><IsOpen/><A/></ReactiveSequence>",
                 kThree) == "");
  // Told as a finding.
  CHECK(asked_in("<Sequence><BatteryOk/><A/></Sequence>", kThree) == "");
  // It is asked until it is so, and then nothing is left to do.
  CHECK(asked_in("<Fallback><IsOpen/><A/></Fallback>", kThree) == "");
  CHECK(asked_in("<Fallback><Sequence><IsOpen/><A/></Sequence><B/></Fallback>",
                 kThree) == "BT2501 IsOpen?");
  // Another one asks the same all the time.
  CHECK(asked_in("<ReactiveSequence><IsOpen/><Sequence><IsOpen/><A/></Sequence>"
                 "</ReactiveSequence>",
                 kThree) == "");
  // It does not matter, or is asked anew in each round.
  CHECK(asked_in("<Sequence><ForceSuccess><IsOpen/></ForceSuccess><A/>"
                 "</Sequence>",
                 kThree) == "");
  CHECK(asked_in("<KeepRunningUntilFailure><Sequence><IsOpen/><A/></Sequence>"
                 "</KeepRunningUntilFailure>",
                 kThree) == "");
}

TEST_CASE("what a Parallel may cut off is asked") {
  const std::string two = "<Sequence><A/><B/></Sequence>";
  CHECK(asked_in("<Parallel>" + two + "<C/></Parallel>", kThree) ==
        "BT2502 Parallel?");
  CHECK(asked_in("<Parallel>" + two +
                     "<ForceSuccess><C/></ForceSuccess>"
                     "</Parallel>",
                 kThree) == "");
  CHECK(asked_in("<Parallel><A/><B/></Parallel>", kThree) == "");
}

TEST_CASE("a failure that nobody hears of is asked about") {
  CHECK(asked_in("<RetryUntilSuccessful num_attempts=\"2\"><ForceSuccess><A/>"
                 "</ForceSuccess></RetryUntilSuccessful>",
                 kThree) == "BT2503 ForceSuccess?");
  CHECK(asked_in("<Sequence><ForceSuccess><A/></ForceSuccess><B/></Sequence>",
                 kThree) == "BT2503 ForceSuccess?");
  CHECK(asked_in("<KeepRunningUntilFailure><ForceSuccess><A/></ForceSuccess>"
                 "</KeepRunningUntilFailure>",
                 kThree) == "");
}

TEST_CASE("a limit, a loop without time, an answer that calls work off") {
  const std::string models =
      std::string(kThree) +
      "<Condition ID=\"Read\">"
      "<output_port name=\"x\" type=\"int\"/></Condition>";
  const auto limited = [&](const std::string& code, const std::string& done) {
    return "<ReactiveSequence><Read x=\"{x}\"/><ReactiveFallback>"
           "<ReactiveSequence><ScriptCondition code=\"" +
           code + "\"/>" + done +
           "</ReactiveSequence><B/></ReactiveFallback></ReactiveSequence>";
  };
  CHECK(asked_in(limited("x &lt; 20", "<A/>"), models) ==
        "BT2504 ScriptCondition?");
  // It remembers that it has begun.
  CHECK(asked_in("<Sequence><Script code=\"on := false\"/>" +
                     limited("x &lt; 20 || (on &amp;&amp; x &lt; 80)",
                             "<Sequence><Script code=\"on := true\"/><A/>"
                             "</Sequence>") +
                     "</Sequence>",
                 models) == "");
  CHECK(asked_in("<Repeat num_cycles=\"-1\"><A/></Repeat>", kThree) ==
        "BT2511 Repeat?; BT2505 Repeat?");
  CHECK(asked_in("<Repeat num_cycles=\"-1\"><Sequence><A/><Sleep msec=\"500\"/>"
                 "</Sequence></Repeat>",
                 kThree) == "BT2511 Repeat?");
  CHECK(asked_in("<ReactiveFallback><IsOpen/><A/></ReactiveFallback>",
                 kThree) == "BT2506 IsOpen?");
  CHECK(asked_in("<Fallback><IsOpen/><A/></Fallback>", kThree) == "");
}

// What is told and asked where a file of contracts says this.
std::string said_with(const std::string& contracts, const std::string& body,
                      const std::string& models) {
  const std::string text =
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"T\">"
      "<BehaviorTree ID=\"T\">\n" +
      body + "\n</BehaviorTree><TreeNodesModel>" + models +
      "</TreeNodesModel></root>";
  TreeInput input{"t.xml", text};
  input.reading.leaves.push_back({"t.leaves", contracts});
  const CheckResult result = check(input, {}, {});
  CHECK(result.diagnostics.empty());
  REQUIRE(result.files.size() == 1);
  std::string said;
  for (const TreeFinding& each : result.files[0].findings) {
    said += (said.empty() ? "" : "; ") + std::string(each.code);
    if (each.severity == Severity::Note) said += "?";
  }
  return said;
}

TEST_CASE("two commands, a guard that runs, a loop that ends, one child") {
  const std::string arm =
      "<Action ID=\"Arm\"><input_port name=\"to\"/></Action>";
  const auto both = [](const std::string& one, const std::string& other) {
    return "<Parallel><Arm to=\"" + one + "\"/><Arm to=\"" + other +
           "\"/></Parallel>";
  };
  CHECK(asked_in(both("a", "b"), arm) == "BT2509 Arm?");
  CHECK(asked_in(both("a", "a"), arm) == "");
  const std::string look =
      "<ReactiveFallback><Sequence><A/><IsOpen/></Sequence>";
  CHECK(asked_in(look + "<B/></ReactiveFallback>", kThree) == "BT2510 A?");
  // It is asked first whether that is to be done.
  CHECK(asked_in("<ReactiveFallback><Sequence><IsOpen/><A/></Sequence><B/>"
                 "</ReactiveFallback>",
                 kThree) == "BT2501 IsOpen?");
  CHECK(asked_in("<Repeat num_cycles=\"3\"><A/></Repeat>", kThree) ==
        "BT2511 Repeat?");
  CHECK(asked_in("<Repeat num_cycles=\"1\"><A/></Repeat>", kThree) == "");
  // Something is done about it.
  CHECK(asked_in("<Fallback><Repeat num_cycles=\"3\"><A/></Repeat><B/>"
                 "</Fallback>",
                 kThree) == "");
  CHECK(asked_in("<Repeat num_cycles=\"3\"><Fallback><A/><AlwaysSuccess/>"
                 "</Fallback></Repeat>",
                 kThree) == "");
  CHECK(asked_in("<Fallback name=\"f\"><A/></Fallback>", kThree) ==
        "BT2512 f?");
  CHECK(asked_in("<Fallback><AlwaysSuccess/></Fallback>", kThree) == "");
}

TEST_CASE("what nothing in the tree writes") {
  const std::string models =
      "<Action ID=\"Plan\"><output_port name=\"way\"/></Action>"
      "<Action ID=\"Follow\"><input_port name=\"way\"/></Action>"
      "<Action ID=\"Drive\"><input_port name=\"way\"/></Action>";
  const auto tree = [](const std::string& more) {
    return "<Sequence><Plan way=\"{there}\"/><Follow way=\"{there}\"/>" + more +
           "</Sequence>";
  };
  CHECK(asked_in(tree("<Follow way=\"{way}\"/>"), models) == "BT2514 Follow?");
  CHECK(asked_in(tree("<Follow way=\"{there}\"/>"), models) == "");
  // Another port, or one of several that read it: the program may well write
  // it.
  CHECK(asked_in(tree("<Drive way=\"{way}\"/>"), models) == "");
  CHECK(asked_in(tree("<Follow way=\"{way}\"/><Drive way=\"{way}\"/>"),
                 models) == "");
}

TEST_CASE("a guard that takes time, and what can never go on") {
  const std::string body =
      "<ReactiveSequence name=\"r\"><A/><B/></ReactiveSequence>";
  CHECK(said_with("(defaction A :returns (success failure running))", body,
                  kThree) == "BT2211");
  CHECK(said_with("(defaction A :duration [2,2] :returns (success running))",
                  body, kThree) == "BT2210; BT2211");
  // A reactive node begins the left one before it halts the other.
  const std::string arm =
      std::string(kThree) +
      "<Action ID=\"Arm\"><input_port name=\"to\"/></Action>";
  CHECK(has(asked_in("<ReactiveFallback><ReactiveSequence><IsOpen/>"
                     "<Arm to=\"a\"/></ReactiveSequence><Arm to=\"b\"/>"
                     "</ReactiveFallback>",
                     arm),
            "BT2509 Arm?"));
}

TEST_CASE("what is left at a value") {
  const std::string hand =
      std::string(kThree) +
      "<Action ID=\"Hand\"><input_port name=\"to\"/></Action>";
  const auto moved = [](const std::string& first, const std::string& second,
                        const std::string& last) {
    return "<Sequence>" +
           (first.empty() ? "" : "<Hand to=\"" + first + "\"/>") +
           "<Hand to=\"" + second + "\"/><A/><Hand to=\"" + last +
           "\"/></Sequence>";
  };
  CHECK(asked_in(moved("x", "y", "x"), hand) == "BT2513 Hand?");
  CHECK(asked_in(moved("", "1", "0"), hand) == "BT2513 Hand?");
  // From one place to another.
  CHECK(asked_in(moved("", "y", "x"), hand) == "");
  CHECK(asked_in(moved("z", "y", "x"), hand) == "");
  // By what a script says of it.
  const auto set = [](const std::string& last) {
    return "<Sequence><Script code=\"up := false\"/>"
           "<A _onSuccess=\"up := true\"/><B/><C _onSuccess=\"up := " +
           last + "\"/></Sequence>";
  };
  CHECK(asked_in(set("false"), kThree) == "BT2513 A?");
  CHECK(asked_in(set("true"), kThree) == "");
}

TEST_CASE("answers silence what fits them, and warn of the rest") {
  const std::string guard = "<Sequence><IsOpen/><A/></Sequence>";
  CHECK(said_with("", guard, kThree) == "BT2501?");
  CHECK(said_with("(defcondition IsOpen :asked-once)", guard, kThree) == "");
  CHECK(said_with("(defcondition IsOpen :asked-once no)", guard, kThree) ==
        "BT2205");
  CHECK(said_with("(defcondition IsOpen :holds-while (A))", guard, kThree) ==
        "BT2205");
  CHECK(said_with("(defcondition IsOpen :holds-while B)", guard, kThree) ==
        "BT2501?");
  // What its name tells is overruled.
  const std::string battery = "<Sequence><BatteryOk/><A/></Sequence>";
  CHECK(said_with("", battery, kThree) == "BT2205");
  CHECK(said_with("(defcondition BatteryOk :asked-once)", battery, kThree) ==
        "");
  // Asked all along, whatever stands before the action.
  CHECK(said_with("(defcondition IsOpen :holds-while (A))",
                  "<ReactiveSequence><IsOpen/><Sequence><IsOpen/><A/>"
                  "</Sequence></ReactiveSequence>",
                  kThree) == "");

  const std::string forgiven =
      "<Sequence><ForceSuccess><A/></ForceSuccess><B/></Sequence>";
  CHECK(said_with("", forgiven, kThree) == "BT2503?");
  CHECK(said_with("(defaction A :may-be-lost)", forgiven, kThree) == "");
  CHECK(said_with("(defaction A :may-be-lost no)", forgiven, kThree) ==
        "BT2503");

  const std::string cut =
      "<Parallel><Sequence><A/><B/></Sequence><C/></Parallel>";
  CHECK(said_with("", cut, kThree) == "BT2502?");
  const std::string a = "(defaction A :may-be-cut-off)";
  CHECK(said_with(a, cut, kThree) == "BT2502?");
  CHECK(said_with(a + "(defaction B :may-be-cut-off)", cut, kThree) == "");
  CHECK(said_with(a + "(defaction B :may-be-cut-off no)", cut, kThree) ==
        "BT2502");

  const std::string again =
      "<ReactiveSequence><A/><Sleep msec=\"500\"/><B/></ReactiveSequence>";
  CHECK(said_with("", again, kThree) == "BT2211");
  CHECK(said_with("(defaction A :idempotent)(defaction B :returns (success))",
                  again, kThree) == "");

  const std::string left = "<Sequence><Fetch/><A/><Put/></Sequence>";
  const std::string models =
      std::string(kThree) + "<Action ID=\"Fetch\"/><Action ID=\"Put\"/>";
  CHECK(said_with("", left, models) == "");
  CHECK(said_with("(defaction Fetch :undone-by Put)", left, models) ==
        "BT2206");
  CHECK(said_with("(defaction Fetch :undone-by Put :may-stay)", left, models) ==
        "");
  const std::string vacuum = "<Sequence><StartPump/><A/><StopPump/></Sequence>";
  const std::string pumps =
      std::string(kThree) +
      "<Action ID=\"StartPump\"/><Action ID=\"StopPump\"/>";
  CHECK(said_with("", vacuum, pumps) == "BT2206");
  CHECK(said_with("(defaction StartPump :may-stay)", vacuum, pumps) == "");
  const std::string turned =
      "<Sequence><Inverter><A/></Inverter><B/></Sequence>";
  CHECK(said_with("", turned, kThree) == "BT2507?");
  CHECK(said_with("(defaction A :may-be-lost)", turned, kThree) == "");
  CHECK(said_with("(defaction A :may-be-lost no)", turned, kThree) == "BT2207");
  // What only tells somebody is no work.
  CHECK(said_with("(defaction A :tells-only)", forgiven, kThree) == "");
}

TEST_CASE("a node that has one answer where the other one is waited for") {
  CHECK(found_in("<Sequence><Fallback><IsOpen/><AlwaysSuccess/></Fallback><A/>"
                 "</Sequence>",
                 kThree) == "BT2213 Fallback");
  CHECK(found_in("<Sequence><Sequence name=\"inner\"><A/><AlwaysFailure/>"
                 "</Sequence><B/></Sequence>",
                 kThree) == "BT2213 inner");
  // It waits, or does something, where the condition fails.
  CHECK(found_in("<Sequence><Fallback><IsOpen/><Sleep msec=\"500\"/></Fallback>"
                 "<A/></Sequence>",
                 kThree) == "");
}

TEST_CASE("a Parallel of which one is enough cuts off the other") {
  CHECK(found_in("<Parallel success_count=\"1\"><A/><B/></Parallel>", kThree) ==
        "BT2214 Parallel");
  CHECK(found_in("<Parallel success_count=\"2\"><A/><B/></Parallel>", kThree) ==
        "");
}

TEST_CASE("an endless loop is meant where the mission is the loop") {
  CHECK(found_in("<KeepRunningUntilFailure><ForceSuccess><A/></ForceSuccess>"
                 "</KeepRunningUntilFailure>",
                 kThree) == "");
  CHECK(found_in("<Sequence><A/><KeepRunningUntilFailure><ForceSuccess><B/>"
                 "</ForceSuccess></KeepRunningUntilFailure></Sequence>",
                 kThree) == "");
  CHECK(found_in("<Sequence><KeepRunningUntilFailure><ForceSuccess><A/>"
                 "</ForceSuccess></KeepRunningUntilFailure><B/></Sequence>",
                 kThree) == "BT2215 KeepRunningUntilFailure");
}

TEST_CASE("a step that is not needed fails the whole") {
  const std::string step =
      "<Sequence><Inverter><IsOpen/></Inverter><A/></Sequence>";
  CHECK(found_in("<Sequence>" + step + "<B/></Sequence>", kThree) ==
        "BT2208 Inverter");
  CHECK(found_in("<Sequence><ForceSuccess>" + step +
                     "</ForceSuccess><B/></Sequence>",
                 kThree) == "");
}

TEST_CASE("words and run agree where an Inverter stands between") {
  const std::string go = "<Sequence><A/><B/></Sequence>";
  CHECK(first_words("<Fallback><Sequence><Inverter><BatteryOk/></Inverter><C/>"
                    "</Sequence>" +
                        go + "</Fallback>",
                    kThree) ==
        "the mission goes on although `BatteryOk` failed, when what follows it "
        "fails; `Fallback` takes this failure for a `BatteryOk` that "
        "succeeded");
  CHECK(first_words("<Fallback><Sequence><IsBatteryLow/><C/></Sequence>" + go +
                        "</Fallback>",
                    std::string(kThree) + "<Condition ID=\"IsBatteryLow\"/>") ==
        "the mission goes on although `IsBatteryLow` succeeded, when what "
        "follows it fails; `Fallback` takes this failure for a `IsBatteryLow` "
        "that failed");
}

// The next in a list is there for what those before it cannot do.
TEST_CASE("in a list of priorities a branch that fails is a question") {
  const auto list = [](const std::string& more) {
    return "<ReactiveFallback><Sequence><Inverter><BatteryOk/></Inverter><C/>"
           "</Sequence>" +
           more + "<A/></ReactiveFallback>";
  };
  CHECK(found_in(list(""), kThree) == "BT2207 Sequence");
  CHECK(found_in(list("<Sequence><IsOpen/><B/></Sequence>"), kThree) == "");
  CHECK(has(asked_in(list("<Sequence><IsOpen/><B/></Sequence>"), kThree),
            "BT2507 Sequence?"));
}

TEST_CASE("a value that is set again in each tick, and asked for, is asked") {
  const auto tree = [](const std::string& first, const std::string& asks) {
    return "<Sequence><" + asks + "/><ReactiveSequence><" + first +
           "/><B/></ReactiveSequence></Sequence>";
  };
  const std::string models =
      std::string(kThree) +
      "<Action ID=\"M7\"><input_port name=\"flag\"/><input_port "
      "name=\"value\"/></Action><Condition ID=\"M9\"><input_port "
      "name=\"flag\"/><input_port name=\"expected\"/></Condition>";
  const std::string sets = "M7 flag=\"begun\" value=\"no\"";
  CHECK(found_in(tree(sets, "M9 flag=\"begun\" expected=\"no\""), models) ==
        "");
  CHECK(has(asked_in(tree(sets, "M9 flag=\"begun\" expected=\"no\""), models),
            "BT2510 M7?"));
  // Another flag is asked for, a value nobody gives it, or nothing at all.
  CHECK(found_in(tree(sets, "M9 flag=\"ended\" expected=\"no\""), models) ==
        "BT2211 M7");
  CHECK(found_in(tree(sets, "M9 flag=\"begun\" expected=\"yes\""), models) ==
        "BT2211 M7");
  CHECK(found_in(tree(sets, "C"), models) == "BT2211 M7");
  CHECK(found_in(tree("M7 flag=\"{f}\" value=\"no\"",
                      "M9 flag=\"begun\" expected=\"no\""),
                 models) == "BT2211 M7");
}

TEST_CASE("the if of a Precondition is looked at once, as _failureIf is") {
  const auto tree = [](const std::string& act, const std::string& above) {
    return "<" + above + "><Measure out=\"{ok}\"/>" + act + "</" + above + ">";
  };
  const std::string models =
      std::string(kThree) +
      "<Condition ID=\"Measure\"><output_port name=\"out\" "
      "type=\"int\"/></Condition>";
  const std::string by_if = "<Precondition if=\"ok == 1\"><A/></Precondition>";
  CHECK(found_in(tree(by_if, "ReactiveSequence"), models) ==
        "BT2209 Precondition");
  CHECK(found_in(tree("<A _failureIf=\"ok != 1\"/>", "ReactiveSequence"),
                 models) == "BT2209 A");
  CHECK(found_in(tree(by_if, "Sequence"), models) == "");
}

TEST_CASE("a guard that has to hold is asked again, or told") {
  CHECK(found_in("<Sequence><BatteryOk/><A/></Sequence>", kThree) ==
        "BT2205 BatteryOk");
  CHECK(found_in("<Sequence><IsOpen/><A/></Sequence>", kThree) == "");
  CHECK(found_in("<ReactiveSequence><BatteryOk/><A/></ReactiveSequence>",
                 kThree) == "");
}

TEST_CASE("what a loop never sets back is told, but not what is done once") {
  const auto loop = [](const std::string& body) {
    return "<Sequence><Script code=\"x := false\"/><Repeat num_cycles=\"3\">"
           "<Sequence>" +
           body + "</Sequence></Repeat></Sequence>";
  };
  const std::string set = "<Script code=\"x := true\"/>";
  CHECK(found_in(loop("<ForceSuccess><Sequence><IsOpen/>" + set +
                      "</Sequence></ForceSuccess><A _skipIf=\"!x\"/><B/>"),
                 kThree) == "BT2216 A");
  CHECK(found_in(loop("<Fallback><ScriptCondition code=\"x\"/><Sequence><A/>" +
                      set + "</Sequence></Fallback><B/>"),
                 kThree) == "");
  CHECK(found_in(loop("<Sequence _skipIf=\"x\"><A/>" + set + "</Sequence><B/>"),
                 kThree) == "");
}

// Halves its time at once, and has none left once it has told something.
struct CutOnceTold : SearchMonitor {
  StopReason observe(const SearchProgress&) override {
    return text.empty() ? StopReason::None : StopReason::Timeout;
  }
  bool has_spare() override { return false; }
  void found(const std::string& lines) override { text += lines; }
  std::string text;
};

// Beside so much else that it is seen before all is searched.
std::string beside_others(std::string text) {
  constexpr std::string_view kMain = "main_tree_to_execute=\"";
  const std::size_t at = text.find(kMain);
  if (at == std::string::npos) return text;
  const std::size_t begin = at + kMain.size();
  const std::size_t length = text.find('"', begin) - begin;
  const std::string tree = text.substr(begin, length);
  text.replace(begin, length, "BesideOthers");
  std::string others;
  for (int i = 0; i < 8; ++i) {
    others += "<Action ID=\"Other" + std::to_string(i) + "\"/>";
  }
  text.insert(text.rfind("</root>"),
              "<BehaviorTree ID=\"BesideOthers\"><ParallelAll><SubTree ID=\"" +
                  tree + "\"/>" + others + "</ParallelAll></BehaviorTree>");
  return text;
}

TEST_CASE("what was told while it searched stands in a report that is cut") {
  std::size_t told = 0;
  for (const auto& file : std::filesystem::directory_iterator(
           std::filesystem::path(BTCHECK_FINDINGS))) {
    const std::string name = file.path().filename().string();
    if (!name.ends_with("-bug.xml")) continue;
    CAPTURE(name);
    CutOnceTold monitor;
    CheckOptions options;
    options.limits.monitor = &monitor;
    // Samples are of a search of the whole, and there is none before.
    options.wants_shortest = false;
    options.choices.parts = PartsUse::Never;
    options.tries_repairs = false;
    const CheckResult result =
        check({name, beside_others(file_text(file.path()))}, {}, options);
    REQUIRE(result.files.size() == 1);
    constexpr std::string_view kSeen = "seen so far: BT";
    for (std::size_t at = monitor.text.find(kSeen); at != std::string::npos;
         at = monitor.text.find(kSeen, at + 1)) {
      const std::string code = monitor.text.substr(at + kSeen.size() - 2, 6);
      CAPTURE(code);
      CHECK(std::ranges::any_of(
          result.files[0].findings,
          [&](const TreeFinding& each) { return each.code == code; }));
      ++told;
    }
  }
  CHECK(told > 10);
}

TEST_CASE("a comment at the node allows a finding") {
  const std::string race = "<Parallel success_count=\"1\"><A/><B/></Parallel>";
  CHECK(found_in("<!-- btcheck: allow BT2214: a race -->\n" + race, kThree) ==
        "");
  CHECK(found_in("<!-- btcheck: allow BT2205 -->\n" + race, kThree) ==
        "BT2214 Parallel");
  CHECK(found_in("<!-- btcheck: allow BT2214 -->\n<Sequence>\n<C/>" + race +
                     "</Sequence>",
                 kThree) == "BT2214 Parallel");
}

TEST_CASE("what is denied is an error") {
  CheckOptions options;
  options.judgement.denied = {"warnings"};
  const std::string race = "<Parallel success_count=\"1\"><A/><B/></Parallel>";
  CHECK(found_in(race, kThree, options) == "BT2214 Parallel!");
  options.judgement.denied = {"bt2214"};
  CHECK(found_in(race, kThree, options) == "BT2214 Parallel!");
  options.judgement.denied = {"BT2205"};
  CHECK(found_in(race, kThree, options) == "BT2214 Parallel");
}

}  // namespace
}  // namespace btcheck::findings_test
