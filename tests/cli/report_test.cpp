// SPDX-License-Identifier: MIT
//
// Results in words, and the exit code that they ask for.
#include "report/text/report.hpp"

#include <doctest/doctest.h>

#include <array>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "model/btf_text.hpp"

namespace btcheck::report_test {
namespace {

const InputFile kTree{"t.btf",
                      "(BehaviorTree :name t (Sequence :name s\n"
                      " (Condition :ID c) (Action :ID a)))"};

CheckResult checked(const std::string& properties,
                    const CheckOptions& options = {},
                    const InputFile& tree = kTree) {
  std::vector<InputFile> files;
  if (!properties.empty()) files.push_back({"p.ltl", properties});
  CheckResult result = check(tree, files, options);
  std::string shown;
  for (const Diagnostic& found : result.diagnostics) shown += render(found);
  INFO(shown);
  REQUIRE(result.files.size() == 1);
  return result;
}

std::string verdicts(const CheckResult& result,
                     Detail detail = Detail::Events) {
  return verdicts_text(result, result.files[0], detail);
}

TEST_CASE("digits are grouped by three") {
  CHECK(grouped(0) == "0");
  CHECK(grouped(7) == "7");
  CHECK(grouped(999) == "999");
  CHECK(grouped(1000) == "1,000");
  CHECK(grouped(328443) == "328,443");
  CHECK(grouped(1234567) == "1,234,567");
  CHECK(grouped(UINT64_MAX) == "18,446,744,073,709,551,615");
}

TEST_CASE("the worst exit code counts, in the order 4, 2, 1, 3, 0") {
  constexpr std::array<ExitCode, 5> kWorstFirst = {
      ExitCode::Internal, ExitCode::BadInput, ExitCode::Missed,
      ExitCode::Undecided, ExitCode::Met};
  for (std::size_t i = 0; i < kWorstFirst.size(); ++i) {
    for (std::size_t j = i; j < kWorstFirst.size(); ++j) {
      CHECK(worst_of(kWorstFirst[i], kWorstFirst[j]) == kWorstFirst[i]);
      CHECK(worst_of(kWorstFirst[j], kWorstFirst[i]) == kWorstFirst[i]);
    }
  }
  CHECK(static_cast<int>(ExitCode::Met) == 0);
  CHECK(static_cast<int>(ExitCode::Missed) == 1);
  CHECK(static_cast<int>(ExitCode::BadInput) == 2);
  CHECK(static_cast<int>(ExitCode::Undecided) == 3);
  CHECK(static_cast<int>(ExitCode::Internal) == 4);
}

// A verdict for a property with this expectation.
ExitCode code_of(Verdict verdict, Expectation expectation,
                 const std::string& error = "") {
  CheckedFile file;
  Property property;
  property.expectation = expectation;
  PropertyVerdict made;
  made.property = &property;
  made.verdict = verdict;
  made.error = error;
  file.verdicts.push_back(made);
  return exit_code_of(file);
}

TEST_CASE("a property asks for the exit code of what was expected of it") {
  using enum Verdict;
  CHECK(code_of(Holds, Expectation::None) == ExitCode::Met);
  CHECK(code_of(Holds, Expectation::Holds) == ExitCode::Met);
  CHECK(code_of(Holds, Expectation::Violated) == ExitCode::Missed);
  CHECK(code_of(Violated, Expectation::None) == ExitCode::Missed);
  CHECK(code_of(Violated, Expectation::Holds) == ExitCode::Missed);
  CHECK(code_of(Violated, Expectation::Violated) == ExitCode::Met);
  CHECK(code_of(Undecided, Expectation::None) == ExitCode::Undecided);
  CHECK(code_of(Undecided, Expectation::Violated) == ExitCode::Undecided);
  CHECK(code_of(Violated, Expectation::Violated, "not possible") ==
        ExitCode::Internal);
}

TEST_CASE("something violated counts more than something undecided") {
  CheckedFile file;
  Property property;
  for (const Verdict verdict :
       {Verdict::Undecided, Verdict::Violated, Verdict::Holds}) {
    PropertyVerdict made;
    made.property = &property;
    made.verdict = verdict;
    file.verdicts.push_back(made);
  }
  CHECK(exit_code_of(file) == ExitCode::Missed);
}

TEST_CASE("the default report asks for 1 only at a fault of the mission") {
  CheckedFile file;
  CHECK(exit_code_of(file) == ExitCode::Met);
  file.defaults.emplace();
  CHECK(exit_code_of(file) == ExitCode::Met);
  TreeReport report;
  report.verdict = Verdict::Violated;
  report.question = TreeQuestion::CanSucceed;
  file.defaults->tree.push_back(report);
  CHECK(exit_code_of(file) == ExitCode::Met);
  file.defaults->stopped = StopReason::Timeout;
  CHECK(exit_code_of(file) == ExitCode::Undecided);
  report.question = TreeQuestion::NeverStuck;
  file.defaults->tree.push_back(report);
  CHECK(exit_code_of(file) == ExitCode::Missed);
  file.defaults->error = "step 3 is not possible";
  CHECK(exit_code_of(file) == ExitCode::Internal);
}

TEST_CASE("the heading says what was checked, and how") {
  const CheckResult result = checked("tick nodes\nprove never a.halted\n");
  CHECK(heading_text(result, result.files[0]) ==
        "t.btf: 4 nodes, 0 variables; profile paper, tick nodes, "
        "no assumptions\n");
  const CheckResult one =
      checked("", {},
              {"u.btf",
               "(defsv v :max 2) (BehaviorTree :name t (Action :ID a "
               ":SF))"});
  CHECK(heading_text(one, one.files[0]) ==
        "u.btf: 2 nodes, 1 variable; profile paper, tick root, "
        "no assumptions\n");
}

TEST_CASE("a verdict stands in one line, its title below") {
  CHECK(verdicts(checked("## Nobody halts it.\n"
                         "property calm: never a.halted\n")) ==
        "HOLDS      calm\n"
        "           Nobody halts it.\n"
        "\n1 property: 1 hold, 0 violated, 0 undecided\n");
}

TEST_CASE("what nobody expected is told with its run") {
  const std::string text =
      verdicts(checked("property fine: never a.failure\n"));
  CHECK(text.starts_with(
      "VIOLATED   fine  (after 1 tick)\n"
      "           never a.failure\n"
      "           why: a -> failure in tick 1 breaks the rule; "
      "with a -> success or a\n"
      "           -> running it need not have been broken.\n\n"
      "    tick 1   c -> success"));
  CHECK(
      text.ends_with("chosen\n"
                     "    -- here it is so: a.failure\n\n"
                     "1 property: 0 hold, 1 violated, 0 undecided\n"));
}

TEST_CASE("what was expected is told without its run, or with every step") {
  const CheckResult result =
      checked("property hole expect violated: never a.failure\n");
  CHECK(verdicts(result) ==
        "VIOLATED   hole  (after 1 tick; as expected)\n"
        "\n1 property: 0 hold, 1 violated, 0 undecided; all as expected\n");
  const std::string every = verdicts(result, Detail::EveryStep);
  CHECK(every.find("t_btn0: start_ -> tick_node") != std::string::npos);
}

TEST_CASE("what was expected otherwise says so") {
  const std::string text =
      verdicts(checked("property p expect violated: never a.halted\n"
                       "property q expect holds: never a.failure\n"
                       "property r expect violated: possible a.running\n"));
  CHECK(text.starts_with("HOLDS      p  (expected a violation)\n"));
  CHECK(text.find("\nVIOLATED   q  (after 1 tick; expected to hold)\n") !=
        std::string::npos);
  CHECK(text.find("\nHOLDS      r  (witness after 1 tick; expected a "
                  "violation)\n") != std::string::npos);
  CHECK(
      text.ends_with("3 properties: 2 hold, 1 violated, 0 undecided; "
                     "3 not as expected\n"));
}

TEST_CASE("a run without an end goes on for ever") {
  const std::string text =
      verdicts(checked("property ends: ltl <> root.ended\n"));
  CHECK(text.starts_with("VIOLATED   ends  (after "));
  CHECK(text.find(", then for ever)\n") != std::string::npos);
  CHECK(text.find("    -- the loop begins\n") != std::string::npos);
}

TEST_CASE("a response says how long the longest answer took") {
  const std::string text = verdicts(
      checked("property one: c.success leadsto a.ticked within [0,2]\n"
              "property two: a.halted leadsto a.ticked within [0,2]\n"
              "property three: a.running leadsto root.ended within [0,1]\n"));
  CHECK(text.starts_with(
      "HOLDS      one  (asked in 1 state, answered within 0 of 2 ticks)\n"
      "HOLDS      two  (vacuously: `a.halted` never happens)\n"
      "VIOLATED   three  (after 2 ticks)\n"));
  CHECK(text.find("    -- asked here, not answered\n") != std::string::npos);
}

TEST_CASE("an undecided verdict names the limit and what was covered") {
  CheckOptions options;
  options.limits.max_states = 1;
  CHECK(
      verdicts(checked("property p expect holds: never a.halted\n", options)) ==
      "UNDECIDED  p  (after 1 states: the limit of --max-states; allow "
      "more)\n\n1 property: 0 hold, 0 violated, 1 undecided\n");
}

TEST_CASE("each limit has its name") {
  SearchProgress progress;
  progress.states = 12345;
  const auto text = [&](StopReason reason) {
    return stop_text(reason, progress);
  };
  CHECK(text(StopReason::MaxStates).find("--max-states") != std::string::npos);
  CHECK(text(StopReason::Memory).find("--memory") != std::string::npos);
  CHECK(text(StopReason::Timeout).find("--timeout") != std::string::npos);
  CHECK(text(StopReason::Interrupted) == "after 12,345 states: interrupted");
}

TEST_CASE("an internal error is said instead of a run") {
  CheckResult result = checked("property p: never a.failure\n");
  result.files[0].verdicts[0].error = "step 3 is not possible";
  CHECK(verdicts(result).find("internal error: step 3 is not possible\n") !=
        std::string::npos);
  CHECK(exit_code_of(result.files[0]) == ExitCode::Internal);
}

std::string defaults(const CheckResult& result,
                     Detail detail = Detail::Events) {
  return defaults_text(result, result.files[0], detail);
}

TEST_CASE("with -v the default report has a line for each question and node") {
  const std::string text = defaults(checked(""), Detail::EveryStep);
  const auto table = text.find("\nThe mission as a whole\n");
  REQUIRE(table != std::string::npos);
  CHECK(text.substr(table).starts_with(R"(
The mission as a whole
  the mission can succeed              yes, e.g. in tick 1
  the mission can fail                 yes, e.g. in tick 1
  from every state it can still end    yes
  it can always still succeed          no, can be lost in tick 1: c -> failure
  it is never stuck                    yes
  no script or assignment fails        yes
  every tick returns                   yes

Each node, and a tick in which it can be so, on a shortest run (-: never)
 line node                                ticked success failure running  halted
    1 BehaviorTree t                           0       1       1       1
    1  Sequence s                              1       1       1       1       -
    2   Condition c                            1       1       1
    2   Action a                               1       1       1       1       -
)"));
}

TEST_CASE("the default report tells findings, and sums up") {
  const std::string text = defaults(checked(""));
  CHECK(text.starts_with(
      "\nnote[BT2205]: `c` is not asked again while `a` runs\n"));
  CHECK(text.ends_with("\n1 finding; 4 nodes, 61 states, all runs\n"));
}

TEST_CASE("a fault is told with its run") {
  const std::string text =
      defaults(checked("", {},
                       {"t.btf",
                        "(defsv k :max 1)(BehaviorTree :name t (Sequence"
                        " (Action :ID a :SF) (Eval (:= k (+ k 2)))))"}));
  CHECK(text.find("no script or assignment fails        NO, see below\n") !=
        std::string::npos);
  CHECK(text.find("\nNot so: no script or assignment fails\n"
                  "    tick 1   a -> success") != std::string::npos);
}

TEST_CASE("nodes that are of no use are worth a look") {
  const std::string text =
      defaults(checked("", {},
                       {"t.btf",
                        "(defsv k :max 1)(BehaviorTree :name t (Fallback\n"
                        "(Eval :name sure (< k 2))\n (Action :ID late)\n"
                        "(Sequence (Action :ID later))))"}));
  CHECK(text.find("`sure` is always true when it is ticked\n") !=
        std::string::npos);
  CHECK(text.find("`late` and `Sequence4` are never ticked\n") !=
        std::string::npos);
  CHECK(text.find("later") == std::string::npos);
}

TEST_CASE("what a limit leaves open is a question mark") {
  CheckOptions options;
  options.limits.max_states = 1;
  const std::string text = defaults(checked("", options), Detail::EveryStep);
  CHECK(text.find("the mission can succeed              UNDECIDED\n") !=
        std::string::npos);
  CHECK(text.find("Action a                               ?       ?") !=
        std::string::npos);
  CHECK(text.ends_with(
      "\nUNDECIDED where a ? stands: after 1 states: the limit of "
      "--max-states; allow more\n"
      "  `btcheck space`, on a part of the tree, tells what multiplies its "
      "states.\n\nnothing found so far; 4 nodes, 1 state, within the "
      "limits\n"));
}

}  // namespace
}  // namespace btcheck::report_test
