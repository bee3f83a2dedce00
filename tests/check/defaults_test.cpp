// SPDX-License-Identifier: MIT
//
// The questions of the default report, each answered in both ways.
#include "check/defaults.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/checked.hpp"

namespace btcheck {
namespace {

DefaultReport report_of(const Lowered& model, const Limits& limits = {}) {
  DefaultReport report = check_defaults(model.tree, model.system, limits);
  CHECK(report.error == "");
  const bool has_time = model.network.ticks != TickSemantics::None;
  REQUIRE(report.tree.size() == kTreeQuestionCount - (has_time ? 0 : 1));
  for (std::size_t q = 0; q < report.tree.size(); ++q) {
    CHECK(static_cast<std::size_t>(report.tree[q].question) == q);
  }
  REQUIRE(report.nodes.size() == model.tree.nodes.size());
  return report;
}

// "yes yes yes yes yes yes", in the order of TreeQuestion.
std::string answers(const DefaultReport& report) {
  std::string text;
  for (const TreeReport& answer : report.tree) {
    text += text.empty() ? "" : " ";
    text += answer.verdict == Verdict::Holds      ? "yes"
            : answer.verdict == Verdict::Violated ? "no"
                                                  : "?";
  }
  return text;
}

std::string answers_of(std::string_view tree,
                       TickSemantics ticks = TickSemantics::Root) {
  return answers(report_of(Lowered(tree, ticks)));
}

const TreeReport& answer_to(const DefaultReport& report,
                            TreeQuestion question) {
  return report.tree[static_cast<std::size_t>(question)];
}

TEST_CASE("a tree that can do anything has nothing to be reported") {
  CHECK(answers_of("(BehaviorTree :name t (Action :ID a))") ==
        "yes yes yes yes yes yes");
}

TEST_CASE("a tree that cannot succeed, or cannot fail") {
  CHECK(answers_of("(BehaviorTree :name t (ForceFailure (Action :ID a)))") ==
        "no yes yes yes yes yes");
  CHECK(answers_of("(BehaviorTree :name t (ForceSuccess (Action :ID a)))") ==
        "yes no yes yes yes yes");
}

TEST_CASE("a tree that goes round for ever cannot end") {
  const Lowered model(
      "(BehaviorTree :name t (KeepRunningUntilFailure"
      " (ForceSuccess (Action :ID a))))");
  const DefaultReport report = report_of(model);
  CHECK(answers(report) == "no no no yes yes yes");
  const TreeReport& end = answer_to(report, TreeQuestion::CanAlwaysEnd);
  REQUIRE(end.run.has_value());
  CHECK(end.run->steps.empty());
  CHECK(is_fault(end));
}

TEST_CASE("a state of no return is the first on the way") {
  const Lowered model(
      "(BehaviorTree :name t (Fallback (Condition :ID ok)"
      " (KeepRunningUntilFailure (ForceSuccess (Action :ID a)))))");
  const DefaultReport report = report_of(model);
  CHECK(answers(report) == "yes no no yes yes yes");
  REQUIRE(answer_to(report, TreeQuestion::CanAlwaysEnd).run.has_value());
  CHECK(!answer_to(report, TreeQuestion::CanAlwaysEnd).run->steps.empty());
}

TEST_CASE("an assignment out of range is found, and ends the run") {
  const Lowered model(
      "(defsv k :max 2)"
      "(BehaviorTree :name t :loop 1 (Eval (:= k (+ k 1))))");
  const DefaultReport report = report_of(model);
  CHECK(answers(report) == "yes no yes yes no yes");
  const TreeReport& range = answer_to(report, TreeQuestion::InRange);
  CHECK(range.ticks == 3);
  CHECK(is_fault(range));
}

TEST_CASE("a division by zero is a fault as well") {
  CHECK(answers_of("(defsv k :max 2)"
                   "(BehaviorTree :name t (Eval (= (/ 1 k) 0)))") ==
        "no no yes yes no yes");
}

// No tree that can be read is stuck, so one is made so: nothing leads from
// where the action decides.
TEST_CASE("a tree that stops in the middle is stuck") {
  const BehaviorTree tree = tree_of("(BehaviorTree :name t (Action :ID a))");
  Network network = lower(tree, TickSemantics::Root);
  Automaton& action = network.automata[0];
  const LocationId tick = *action.find_location("tick_node");
  for (Edge& edge : action.edges) {
    if (edge.source == tick) edge.guard = Expression::constant(0);
  }
  const CompiledNetwork system(network);
  const DefaultReport report = check_defaults(tree, system, {});
  CHECK(answers(report) == "no no no no yes yes");
  const TreeReport& stuck = answer_to(report, TreeQuestion::NeverStuck);
  REQUIRE(stuck.run.has_value());
  CHECK(stuck.ticks == 1);
  CHECK(is_fault(stuck));
}

TEST_CASE("a tick that never returns is a zero-time loop") {
  const BehaviorTree tree = tree_of("(BehaviorTree :name t (Action :ID a))");
  Network network = lower(tree, TickSemantics::Root);
  for (Edge& edge : network.automata[1].edges) edge.when = kAtOnce;
  const CompiledNetwork system(network);
  const DefaultReport report = check_defaults(tree, system, {});
  CHECK(answers(report) == "yes yes yes yes yes no");
  const TreeReport& loop = answer_to(report, TreeQuestion::NoZeroTimeLoop);
  CHECK(loop.run.has_value());
  CHECK(is_fault(loop));
}

TEST_CASE("where no time passes nobody asks for loops without time") {
  CHECK(answers_of("(BehaviorTree :name t (Action :ID a))",
                   TickSemantics::None) == "yes yes yes yes yes");
}

TEST_CASE("several trees succeed when all do, and fail when one does") {
  CHECK(answers_of("(BehaviorTree :name a (ForceSuccess (Action :ID x)))"
                   "(BehaviorTree :name b (ForceFailure (Action :ID y)))"
                   "(Trees a b)") == "no yes yes yes yes yes");
  CHECK(answers_of("(BehaviorTree :name a (ForceSuccess (Action :ID x)))"
                   "(BehaviorTree :name b (Action :ID y))"
                   "(Trees a b)") == "yes yes yes yes yes yes");
}

TEST_CASE("not to succeed or not to fail is no fault of the mission") {
  TreeReport report;
  report.verdict = Verdict::Violated;
  for (std::size_t q = 0; q < kTreeQuestionCount; ++q) {
    report.question = static_cast<TreeQuestion>(q);
    CHECK(is_fault(report) == (q > 1));
  }
  report.verdict = Verdict::Undecided;
  CHECK(!is_fault(report));
}

// A row for each node: the tick at which it can first be so, `-` for never and
// `?` for unknown, in the order ticked, success, failure, running, halted.
std::string node_table(const Lowered& model, const DefaultReport& report) {
  std::string text;
  for (const NodeReport& node : report.nodes) {
    text += model.tree.node(node.node).name;
    for (const Possibility& answer : node.answers) {
      CHECK(answer.run.has_value() == (answer.verdict == Verdict::Holds));
      text += answer.verdict == Verdict::Violated ? " -"
              : answer.verdict == Verdict::Undecided
                  ? " ?"
                  : " " + std::to_string(answer.ticks);
    }
    text += '\n';
  }
  return text;
}

TEST_CASE("each node is asked what it can do, and when first") {
  const Lowered model(
      "(BehaviorTree :name t (ReactiveSequence :halt 1 :name r"
      " (Condition :ID c) (Wait :name w :duration 2) (Action :ID a)"
      " (ForceFailure :name f (Action :ID b :SF)) (Action :ID never)))");
  CHECK(node_table(model, report_of(model)) ==
        "t 0 - 1 1 -\n"
        "r 1 - 1 1 -\n"
        "c 1 1 1 - -\n"
        "w 1 3 - 1 2\n"
        "a 3 3 3 3 4\n"
        "f 3 - 3 - -\n"
        "b 3 3 3 - -\n"
        "never - - - - -\n");
}

TEST_CASE("what a limit leaves open is undecided, what is found is not") {
  const Lowered model(example("drone3.btf"));
  const DefaultReport report = report_of(model, {.max_states = 3000});
  CHECK(report.stopped == StopReason::MaxStates);
  CHECK(answers(report) == "? yes ? ? ? ?");
  const std::string table = node_table(model, report);
  CHECK(table.find("start_drone 1 1 1 1 ?") != std::string::npos);
  CHECK(table.find("-") == std::string::npos);
}

}  // namespace
}  // namespace btcheck
