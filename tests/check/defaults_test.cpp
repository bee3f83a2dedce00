// SPDX-License-Identifier: MIT
//
// The questions of the default report, each answered in both ways.
#include "check/questions/defaults.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/checked.hpp"
#include "model/lowering.hpp"

namespace btcheck::defaults_test {
namespace {

DefaultReport report_of(const Lowered& model, const Limits& limits = {}) {
  DefaultReport report =
      check_defaults(model.tree, model.system, Reduction::None, limits);
  CHECK(report.error == "");
  const bool has_time = model.network.ticks != TickSemantics::None;
  REQUIRE(report.tree.size() == kTreeQuestionCount - (has_time ? 0 : 1));
  for (std::size_t q = 0; q < report.tree.size(); ++q) {
    CHECK(static_cast<std::size_t>(report.tree[q].question) == q);
  }
  REQUIRE(report.nodes.size() == model.tree.nodes.size());
  return report;
}

// "yes no yes no yes yes yes", in the order of TreeQuestion.
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
  CHECK(answers_of("(BehaviorTree :name t :loop 1 (Action :ID a))") ==
        "yes yes yes yes yes yes yes");
}

TEST_CASE("a tree that cannot succeed, or cannot fail") {
  CHECK(answers_of("(BehaviorTree :name t (ForceFailure (Action :ID a)))") ==
        "no yes yes no yes yes yes");
  CHECK(answers_of("(BehaviorTree :name t (ForceSuccess (Action :ID a)))") ==
        "yes no yes yes yes yes yes");
}

TEST_CASE("a tree that goes round for ever cannot end") {
  const Lowered model(
      "(BehaviorTree :name t (KeepRunningUntilFailure"
      " (ForceSuccess (Action :ID a))))");
  const DefaultReport report = report_of(model);
  CHECK(answers(report) == "no no no no yes yes yes");
  const TreeReport& end = answer_to(report, TreeQuestion::CanAlwaysEnd);
  REQUIRE(end.run.has_value());
  CHECK(end.run->is_empty());
  // The mission is the loop.
  CHECK(end.is_meant);
  CHECK_FALSE(is_fault(end));
}

TEST_CASE("a state of no return is the first on the way") {
  const Lowered model(
      "(BehaviorTree :name t (Fallback (Condition :ID ok)"
      " (KeepRunningUntilFailure (ForceSuccess (Action :ID a)))))");
  const DefaultReport report = report_of(model);
  CHECK(answers(report) == "yes no no no yes yes yes");
  REQUIRE(answer_to(report, TreeQuestion::CanAlwaysEnd).run.has_value());
  CHECK(!answer_to(report, TreeQuestion::CanAlwaysEnd).run->is_empty());
}

TEST_CASE("the step with which success is lost is the last of the run") {
  const Lowered model(
      "(BehaviorTree :name t (Sequence (Action :ID a) (Action :ID b)))");
  const DefaultReport report = report_of(model);
  CHECK(answers(report) == "yes yes yes no yes yes yes");
  const TreeReport& lost = answer_to(report, TreeQuestion::CanAlwaysSucceed);
  REQUIRE(lost.run.has_value());
  CHECK(lost.ticks() == 1);
  CHECK(node_entering(model.network, lost.run->told().steps.back().step.edge,
                      LocationRole::Failure) == NodeId{2});
  CHECK(!is_fault(lost));
}

TEST_CASE("a mission that tries again until it succeeds cannot lose that") {
  CHECK(answers_of("(BehaviorTree :name t :loop 1 (Sequence (Action :ID a)"
                   " (Condition :ID b)))") == "yes yes yes yes yes yes yes");
}

TEST_CASE("an assignment out of range is found, and ends the run") {
  const Lowered model(
      "(defsv k :max 2)"
      "(BehaviorTree :name t :loop 1 (Eval (:= k (+ k 1))))");
  const DefaultReport report = report_of(model);
  CHECK(answers(report) == "yes no yes no yes no yes");
  const TreeReport& range = answer_to(report, TreeQuestion::InRange);
  CHECK(range.ticks() == 3);
  CHECK(is_fault(range));
}

TEST_CASE("a division by zero is a fault as well") {
  CHECK(answers_of("(defsv k :max 2)"
                   "(BehaviorTree :name t (Eval (= (/ 1 k) 0)))") ==
        "no no yes no yes no yes");
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
  const DefaultReport report =
      check_defaults(tree, system, Reduction::None, {});
  CHECK(answers(report) == "no no no no no yes yes");
  const TreeReport& stuck = answer_to(report, TreeQuestion::NeverStuck);
  REQUIRE(stuck.run.has_value());
  CHECK(stuck.ticks() == 1);
  CHECK(is_fault(stuck));
}

TEST_CASE("a tick that never returns is a zero-time loop") {
  const BehaviorTree tree = tree_of("(BehaviorTree :name t (Action :ID a))");
  Network network = lower(tree, TickSemantics::Root);
  for (Edge& edge : network.automata[1].edges) edge.when = kAtOnce;
  const CompiledNetwork system(network);
  const DefaultReport report =
      check_defaults(tree, system, Reduction::None, {});
  CHECK(answers(report) == "yes yes yes no yes yes no");
  const TreeReport& loop = answer_to(report, TreeQuestion::NoZeroTimeLoop);
  CHECK(is_fault(loop));
  REQUIRE(loop.run.has_value());
  const Run run = loop.run->told();
  REQUIRE(run.loop < run.steps.size());
  CHECK(run.state(run.loop) == run.state(run.steps.size()));
  bool is_ticked = false;
  for (std::size_t i = run.loop; i < run.steps.size(); ++i) {
    CHECK(run.steps[i].step.elapsed == 0);
    is_ticked |= node_entering(network, run.steps[i].step.edge,
                               LocationRole::Tick) == NodeId{1};
  }
  CHECK(is_ticked);
}

TEST_CASE("where no time passes nobody asks for loops without time") {
  CHECK(answers_of("(BehaviorTree :name t (Action :ID a))",
                   TickSemantics::None) == "yes yes yes no yes yes");
}

TEST_CASE("several trees succeed when all do, and fail when one does") {
  CHECK(answers_of("(BehaviorTree :name a (ForceSuccess (Action :ID x)))"
                   "(BehaviorTree :name b (ForceFailure (Action :ID y)))"
                   "(Trees a b)") == "no yes yes no yes yes yes");
  CHECK(answers_of("(BehaviorTree :name a (ForceSuccess (Action :ID x)))"
                   "(BehaviorTree :name b (Action :ID y))"
                   "(Trees a b)") == "yes yes yes no yes yes yes");
}

TEST_CASE("not to succeed or not to fail is no fault of the mission") {
  TreeReport report;
  report.verdict = Verdict::Violated;
  for (std::size_t q = 0; q < kTreeQuestionCount; ++q) {
    report.question = static_cast<TreeQuestion>(q);
    const bool is_wish = report.question == TreeQuestion::CanSucceed ||
                         report.question == TreeQuestion::CanFail ||
                         report.question == TreeQuestion::CanAlwaysSucceed;
    CHECK(is_fault(report) == !is_wish);
  }
  report.verdict = Verdict::Undecided;
  CHECK(!is_fault(report));
}

// A row for each node: a tick in which it can be so, `-` for never and
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
                  : " " + std::to_string(answer.ticks());
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
        "t 0 - 1 1 - -\n"
        "r 1 - 1 1 - -\n"
        "c 1 1 1 - - -\n"
        "w 1 3 - 1 2 -\n"
        "a 3 3 3 3 4 -\n"
        "f 3 - 3 - - -\n"
        "b 3 3 3 - - -\n"
        "never - - - - - -\n");
}

// "a: c d@2" for each action with stale guards.
std::string stale(std::string_view tree) {
  const Lowered model(tree);
  std::string text;
  for (const StaleGuardReport& found : report_of(model).stale_guards) {
    text += text.empty() ? "" : "; ";
    text += model.tree.node(found.action).name + ":";
    for (const NodeId guard : found.guards) {
      text += " " + model.tree.node(guard).name;
    }
    text += "@" + std::to_string(found.run->ticks());
    REQUIRE(found.run.has_value());
    CHECK(node_entering(model.network, found.run->told().steps.back().step.edge,
                        LocationRole::Tick) == found.action);
  }
  return text;
}

std::string in_tree(const std::string& node) {
  return "(defsv w :states (Calm Storm) :transitions :all)"
         "(defsv k :max 1)"
         "(BehaviorTree :name t " +
         node + ")";
}

TEST_CASE("a guard before an action that runs goes stale") {
  for (const std::string row : {"Sequence", "SequenceWithMemory"}) {
    CAPTURE(row);
    CHECK(stale(in_tree("(" + row + " (Condition :ID c) (Action :ID a))")) ==
          "a: c@2");
  }
  CHECK(stale(in_tree("(Fallback (Condition :ID c) (Action :ID a))")) ==
        "a: c@2");
  CHECK(stale(in_tree("(Sequence (SetSV :ID m :sv w) (Action :ID a))")) ==
        "a: m@2");
  CHECK(stale(in_tree("(Sequence (Eval :name e (= w Calm))"
                      " (Inverter (Action :ID a)))")) == "a: e@2");
}

TEST_CASE("what goes stale are the guards that every run has asked") {
  CHECK(stale(in_tree("(Sequence (Sequence (Condition :ID c) (Condition :ID d))"
                      " (Action :ID a))")) == "a: c d@2");
  CHECK(stale(in_tree("(Sequence (Fallback (Condition :ID c) (Condition :ID d))"
                      " (Action :ID a))")) == "a: c@2");
  CHECK(stale(in_tree("(Fallback (Inverter (Sequence (Condition :ID c)"
                      " (Inverter (Condition :ID d)))) (Action :ID a))")) ==
        "a: c d@2");
  CHECK(stale(in_tree("(Sequence (ParallelAll (Condition :ID c)"
                      " (Condition :ID d)) (Action :ID a))")) == "a: c d@2");
  CHECK(stale(in_tree("(RoundRobin (Condition :ID c) (Action :ID a))")) == "");
}

TEST_CASE("a guard is not stale where every tick begins anew") {
  CHECK(stale(in_tree("(ReactiveSequence (Condition :ID c)"
                      " (Action :ID a))")) == "");
  CHECK(stale(in_tree("(ParallelAll (Condition :ID c) (Action :ID a))")) == "");
  // Above a Sequence that resumes, a reactive node asks again.
  CHECK(stale(in_tree("(ReactiveSequence (Condition :ID c)"
                      " (Sequence (Condition :ID d) (Action :ID a)))")) ==
        "a: d@2");
}

TEST_CASE("what cannot change or cannot run makes nothing stale") {
  CHECK(stale(in_tree("(Sequence (Condition :ID c) (Action :ID a :SF))")) ==
        "");
  // Nothing writes k while a runs.
  CHECK(stale(in_tree("(Sequence (Eval :name e (= k 0)) (Action :ID a)"
                      " (Eval (:= k 1)))")) == "");
  CHECK(stale(in_tree("(ReactiveSequence (Eval :name up (:= k (- 1 k)))"
                      " (Sequence (Eval :name e (= k 1)) (Action :ID a)))")) ==
        "a: e@2");
  // An assignment looks at nothing.
  CHECK(stale(in_tree("(Sequence (Eval (:= k 1)) (Action :ID a))")) == "");
}

TEST_CASE("a status that an Eval reads can change like a variable") {
  const std::string rest =
      " (Sequence (Eval :name e (~ (= b.rstatus failure))) (Action :ID a)))";
  CHECK(stale(in_tree("(ReactiveFallback (ForceFailure (Action :ID b :SF))" +
                      rest)) == "a: e@2");
  CHECK(stale(in_tree("(Fallback (ForceFailure (Action :ID b :SF))" + rest)) ==
        "");
}

// "a<p succeeded@1" for each leaf that is left running.
std::string left_running(const std::string& tree) {
  const Lowered model("(BehaviorTree :name t " + tree + ")");
  std::string text;
  for (const LeftRunningReport& found : report_of(model).left_running) {
    text += text.empty() ? "" : "; ";
    text +=
        model.tree.node(found.leaf).name + "<" +
        model.tree.node(found.above).name + " " +
        std::string(kStatusNames[static_cast<std::size_t>(found.decision)]) +
        "@" + std::to_string(found.run->ticks());
    REQUIRE(found.run.has_value());
    const Run run = found.run->told();
    const std::size_t end = run.steps.size();
    const VariableId status = model.network.node_status[index(found.leaf)];
    CHECK(run.state(end).variables[index(status)] ==
          static_cast<int>(NodeStatus::Running));
    CHECK(node_entering(model.network, run.steps.back().step.edge,
                        LocationRole::Start) == found.above);
  }
  return text;
}

TEST_CASE("who decides and neither halts nor waits leaves children running") {
  const std::string row = " (Condition :ID c) (Action :ID a))";
  CHECK(left_running("(ReactiveSequence :name p" + row) == "a<p failure@2");
  CHECK(left_running("(ReactiveFallback :name p" + row) == "a<p success@2");
  CHECK(left_running("(ReactiveSequence :name p :halt 1" + row) == "");
  CHECK(left_running("(ReactiveSequence :name p :wait 1" + row) == "");
  CHECK(left_running("(Sequence :name p" + row) == "");
}

TEST_CASE("a parallel node leaves children running when it has enough") {
  const std::string rest = " (Condition :ID c) (Action :ID a))";
  CHECK(left_running("(Parallel :success 1 :name p" + rest) == "a<p success@1");
  CHECK(left_running("(ParallelAll :name p" + rest) == "a<p failure@1");
  CHECK(left_running("(Parallel :success 1 :halt 1 :name p" + rest) == "");
}

TEST_CASE("a leaf deeper down is left running by who is left above it") {
  CHECK(left_running("(ReactiveSequence :name p (Condition :ID c)"
                     " (Sequence :name s (Action :ID a :SF)"
                     " (Action :ID b)))") == "b<p failure@2");
}

TEST_CASE("what a limit leaves open is undecided, what is found is not") {
  const Lowered model(example("drone3.btf"));
  const DefaultReport report = report_of(model, {.max_states = 3000});
  CHECK(report.stopped == StopReason::MaxStates);
  CHECK(answers(report) == "? yes ? ? ? ? ?");
  const std::string table = node_table(model, report);
  CHECK(table.find("start_drone 1 1 1 1 ?") != std::string::npos);
  CHECK(table.find("-") == std::string::npos);
}

// A search that takes long: half of its time is over after some thousand
// states.
struct Hurried : SearchMonitor {
  StopReason observe(const SearchProgress&) override {
    return StopReason::None;
  }
  bool has_spare() override { return ++asked < 8; }
  void found(const std::string& lines) override { text += lines; }
  std::string text;
  int asked = 0;
};

// Time to search, and none to tell.
class NoTimeToTell : public SearchMonitor {
 public:
  StopReason observe(const SearchProgress&) override {
    return is_late ? StopReason::Timeout : StopReason::None;
  }
  bool may_tell() override {
    is_late = true;
    return false;
  }

  bool is_late = false;
};

TEST_CASE("without time to tell all runs, the longest are given up") {
  NoTimeToTell monitor;
  Limits limits;
  limits.monitor = &monitor;
  const DefaultReport report = report_of(
      Lowered("(BehaviorTree :name t (Repeat :repeat 2000 (Action :ID a)))"),
      limits);
  CHECK(report.stopped == StopReason::Timeout);
  CHECK(answer_to(report, TreeQuestion::CanSucceed).verdict ==
        Verdict::Undecided);
  CHECK(answer_to(report, TreeQuestion::CanFail).verdict == Verdict::Holds);
  for (const Possibility& answer : report.nodes.back().answers) {
    CHECK(answer.verdict != Verdict::Undecided);
  }
}

TEST_CASE("what lies too deep for a search that is stopped, samples see") {
  const Lowered model(example("drone3.btf"));
  Hurried monitor;
  const Limits limits{.max_states = 12000, .monitor = &monitor};
  const DefaultReport report = check_defaults(
      model.tree, model.system, Reduction::None, limits, Sampling::WhenLong);
  CHECK(report.error == "");
  CHECK(report.stopped == StopReason::MaxStates);
  CHECK(answers(report) == "yes yes ? ? ? ? ?");
  CHECK(monitor.text.find("seen so far: the mission can succeed, after ") !=
        std::string::npos);
  const KeptRun& run = *answer_to(report, TreeQuestion::CanSucceed).run;
  CHECK(node_entering(model.network, run.steps().back().edge,
                      LocationRole::Success) == model.tree.roots[0]);
}

TEST_CASE("samples claim nothing that the whole search does not") {
  for (const char* name : {"drone1.btf", "drone3.btf", "nav2.btf"}) {
    CAPTURE(name);
    const Lowered model(example(name));
    Hurried monitor;
    const Limits limits{.max_states = 12000, .monitor = &monitor};
    const DefaultReport few = check_defaults(
        model.tree, model.system, Reduction::Full, limits, Sampling::WhenLong);
    const DefaultReport all =
        check_defaults(model.tree, model.system, Reduction::Full, {});
    CHECK(few.error == "");
    for (std::size_t n = 0; n < few.nodes.size(); ++n) {
      for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
        const Verdict claimed = few.nodes[n].answers[q].verdict;
        if (few.stopped == StopReason::None || claimed == Verdict::Holds) {
          CHECK(claimed == all.nodes[n].answers[q].verdict);
        }
      }
    }
    for (const TreeFinding& found : few.findings) {
      CHECK(std::ranges::any_of(all.findings, [&](const TreeFinding& each) {
        return each.code == found.code && each.node == found.node;
      }));
    }
  }
}

TEST_CASE("a tick that changes nothing is not taken for the end") {
  // Reduced, one whole tick leads from a state back to it.
  const Lowered model(
      "(BehaviorTree :name t (ReactiveFallback :wait 1 (Condition :ID a)"
      " (KeepRunningUntilFailure (Eval (~ (= a.rstatus running))))))");
  for (const Reduction reduction :
       {Reduction::None, Reduction::Live, Reduction::Full}) {
    const DefaultReport report =
        check_defaults(model.tree, model.system, reduction, {});
    CHECK(report.error == "");
    CHECK(answers(report) == "yes no no no yes yes yes");
  }
}

}  // namespace
}  // namespace btcheck::defaults_test
