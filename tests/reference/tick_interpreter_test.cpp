// SPDX-License-Identifier: MIT
//
// The naive interpreter against the sentences of docs/semantics.md.
#include "reference/tick_interpreter.hpp"

#include <doctest/doctest.h>

#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "model/tree/tree.hpp"

namespace btcheck::reference::tick_interpreter_test {
namespace {

// A tree whose leaves answer from a list: + success, - failure, ~ running,
// the last one for ever. A tick is told as "s? a? a+ s+": `?` for ticked,
// `!` for halted, the root left out.
struct Run {
  explicit Run(const std::string& body,
               std::map<std::string, std::string> leaf_answers = {},
               const std::string& definitions = "")
      : tree(read(definitions + "(BehaviorTree :name t " + body + ")")),
        answers(std::move(leaf_answers)),
        interpreter(tree, script()) {}
  Run(const Run&) = delete;

  static BehaviorTree read(const std::string& forms) {
    Result<BehaviorTree> result = read_btf("test.btf", "(" + forms + ")");
    for (const Diagnostic& diagnostic : result.diagnostics)
      if (diagnostic.severity == Severity::Error) MESSAGE(render(diagnostic));
    REQUIRE(result.value.has_value());
    return *result.value;
  }

  Script script() {
    return {.action =
                [this](NodeId leaf, std::span<const NodeStatus> allowed) {
                  return answer(leaf, allowed);
                },
            .set_sv =
                [this](NodeId, std::span<const int> allowed) {
                  values_allowed.assign(allowed.begin(), allowed.end());
                  return chosen;
                },
            .due = [this](NodeId, int elapsed) { return elapsed >= due_at; },
            .free_moves =
                [this](std::span<int> values) {
                  for (const auto& [variable, value] : moves)
                    values[static_cast<std::size_t>(variable)] = value;
                },
            .timely_move = [](StateVariableId,
                              auto allowed) { return allowed.front(); }};
  }

  NodeStatus answer(NodeId leaf, std::span<const NodeStatus> allowed) {
    answers_allowed.assign(allowed.begin(), allowed.end());
    std::string& list = answers[tree.node(leaf).name];
    if (list.empty()) return allowed.front();
    const char sign = list.front();
    if (list.size() > 1) list.erase(0, 1);
    if (sign == '+') return NodeStatus::Success;
    return sign == '-' ? NodeStatus::Failure : NodeStatus::Running;
  }

  std::string tick() {
    std::string text;
    const TickResult result = interpreter.tick();
    for (const TickEvent& event : result.events) {
      if (tree.node(event.node).is_root()) continue;
      if (!text.empty()) text += ' ';
      text += tree.node(event.node).name;
      text += std::string("?+-~!")[static_cast<std::size_t>(event.kind)];
    }
    return text;
  }

  NodeId find(const std::string& name) const {
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i)
      if (tree.nodes[i].name == name) return NodeId{i};
    throw std::logic_error("no node " + name);
  }
  int local(const std::string& name, std::string_view variable) const {
    return interpreter.local(find(name), variable);
  }
  NodeStatus status(const std::string& name) const {
    return interpreter.status(find(name));
  }
  int variable(std::size_t i) const {
    return interpreter.state().variables.at(i);
  }

  BehaviorTree tree;
  std::map<std::string, std::string> answers;
  int chosen = 0;
  int due_at = 1000;
  std::map<int, int> moves;
  std::vector<int> values_allowed;
  std::vector<NodeStatus> answers_allowed;
  TickInterpreter interpreter;
};

constexpr auto kSuccess = NodeStatus::Success;
constexpr auto kFailure = NodeStatus::Failure;
constexpr auto kRunning = NodeStatus::Running;

// --- The root and the frame ----------------------------------------------

TEST_CASE("the root is ticked first and answers last") {
  Run run("(Action :ID a)", {{"a", "+"}});
  const TickResult result = run.interpreter.tick();
  const NodeId root{0};
  const NodeId action{1};
  CHECK(result.events == std::vector<TickEvent>{{root, EventKind::Ticked},
                                                {action, EventKind::Ticked},
                                                {action, EventKind::Success},
                                                {root, EventKind::Success}});
  CHECK(result.root == kSuccess);
  CHECK(result.statuses == std::vector{kSuccess, kSuccess});
}

TEST_CASE("a root that has ended stays as it is") {
  Run run("(Action :ID a)", {{"a", "~-"}});
  CHECK(run.tick() == "a? a~");
  CHECK_FALSE(run.interpreter.ended());
  CHECK(run.tick() == "a? a-");
  CHECK(run.interpreter.ended());
  CHECK(run.tick().empty());
  CHECK(run.interpreter.state().root == kFailure);
}

TEST_CASE("a root with :loop 1 starts anew") {
  Run run(":loop 1 (Action :ID a)", {{"a", "+-"}});
  CHECK(run.tick() == "a? a+");
  CHECK(run.tick() == "a? a-");
  CHECK(run.tick() == "a? a-");
}

TEST_CASE("a node that was never ticked has no return status") {
  Run run("(Sequence :name s (Action :ID a) (Action :ID b))", {{"a", "-"}});
  run.tick();
  CHECK(run.status("a") == kFailure);
  CHECK(run.status("b") == NodeStatus::NoRetStatus);
}

// --- Sequence and Fallback -----------------------------------------------

TEST_CASE("a Sequence resumes at its running child") {
  Run run("(Sequence :name s (Action :ID a) (Action :ID b))",
          {{"a", "+"}, {"b", "~+"}});
  CHECK(run.tick() == "s? a? a+ b? b~ s~");
  CHECK(run.local("s", "next_seq") == 2);
  CHECK(run.tick() == "s? b? b+ s+");
  CHECK(run.local("s", "next_seq") == 1);
}

TEST_CASE("a failure sends a Sequence back to its first child") {
  Run run(":loop 1 (Sequence :name s (Action :ID a) (Action :ID b))",
          {{"a", "+"}, {"b", "~-"}});
  run.tick();
  CHECK(run.tick() == "s? b? b- s-");
  CHECK(run.local("s", "next_seq") == 1);
  CHECK(run.tick() == "s? a? a+ b? b- s-");
}

TEST_CASE("a Fallback is the mirror of a Sequence") {
  Run run(":loop 1 (Fallback :name f (Action :ID a) (Action :ID b))",
          {{"a", "-"}, {"b", "~+-"}});
  CHECK(run.tick() == "f? a? a- b? b~ f~");
  CHECK(run.local("f", "next_fb") == 2);
  CHECK(run.tick() == "f? b? b+ f+");
  CHECK(run.tick() == "f? a? a- b? b- f-");
  CHECK(run.local("f", "next_fb") == 1);
}

TEST_CASE("a SequenceWithMemory resumes at the child that failed") {
  Run run(
      ":loop 1 (SequenceWithMemory :name s"
      " (Action :ID a) (Action :ID b))",
      {{"a", "+"}, {"b", "-+"}});
  CHECK(run.tick() == "s? a? a+ b? b- s-");
  CHECK(run.local("s", "next_seq") == 2);
  CHECK(run.tick() == "s? b? b+ s+");
  CHECK(run.local("s", "next_seq") == 1);
}

TEST_CASE("a halted Sequence halts its running child and forgets its place") {
  Run run(
      ":loop 1 (ReactiveSequence :name r :halt 1 (Condition :ID c)"
      " (Sequence :name s (Action :ID a) (Action :ID b)))",
      {{"c", "+-+"}, {"a", "+"}, {"b", "~"}});
  run.tick();
  CHECK(run.tick() == "r? c? c- b! s! r-");
  CHECK(run.local("s", "next_seq") == 1);
  CHECK(run.status("s") == kFailure);
  CHECK(run.status("b") == kFailure);
  CHECK(run.tick() == "r? c? c+ s? a? a+ b? b~ s~ r~");
}

TEST_CASE("a halted SequenceWithMemory keeps its place") {
  Run run(
      ":loop 1 (ReactiveSequence :name r :halt 1 (Condition :ID c)"
      " (SequenceWithMemory :name s (Action :ID a) (Action :ID b)))",
      {{"c", "+-+"}, {"a", "+"}, {"b", "~"}});
  run.tick();
  CHECK(run.tick() == "r? c? c- b! s! r-");
  CHECK(run.local("s", "next_seq") == 2);
  CHECK(run.tick() == "r? c? c+ s? b? b~ s~ r~");
}

// --- Reactive nodes ------------------------------------------------------

TEST_CASE("a ReactiveSequence starts at its first child every tick") {
  Run run("(ReactiveSequence :name r (Condition :ID c) (Action :ID a))",
          {{"c", "+"}, {"a", "~+"}});
  CHECK(run.tick() == "r? c? c+ a? a~ r~");
  CHECK(run.tick() == "r? c? c+ a? a+ r+");
}

TEST_CASE("children right of a running one are neither ticked nor halted") {
  Run run("(ReactiveSequence :name r :halt 1 (Action :ID a) (Action :ID b))",
          {{"a", "+~+"}, {"b", "~"}});
  CHECK(run.tick() == "r? a? a+ b? b~ r~");
  CHECK(run.tick() == "r? a? a~ r~");
  CHECK(run.status("b") == kRunning);
  CHECK(run.tick() == "r? a? a+ b? b~ r~");
}

TEST_CASE("without :halt and :wait a decision leaves orphans") {
  Run run(":loop 1 (ReactiveFallback :name r (Condition :ID c) (Action :ID a))",
          {{"c", "-+-"}, {"a", "~"}});
  run.tick();
  CHECK(run.tick() == "r? c? c+ r+");
  CHECK(run.status("a") == kRunning);
  CHECK(run.tick() == "r? c? c- a? a~ r~");
}

TEST_CASE("with :halt every running child is halted, left to right") {
  Run run(
      ":loop 1 (ReactiveSequence :name r :halt 1 :wait 1"
      " (Condition :ID c) (Action :ID a) (Action :ID b))",
      {{"c", "++-"}, {"a", "+~"}, {"b", "~"}});
  CHECK(run.tick() == "r? c? c+ a? a+ b? b~ r~");
  CHECK(run.tick() == "r? c? c+ a? a~ r~");
  CHECK(run.tick() == "r? c? c- a! b! r-");
}

TEST_CASE("with :wait a decision waits until no child runs") {
  Run run(
      ":loop 1 (ReactiveSequence :name r :wait 1"
      " (Condition :ID c) (Action :ID a) (Action :ID b))",
      {{"c", "++-+"}, {"a", "+~+~"}, {"b", "~~+"}});
  run.tick();
  run.tick();
  CHECK(run.tick() == "r? c? c- r~");
  CHECK(run.local("r", "decision") == static_cast<int>(kFailure));
  CHECK(run.tick() == "r? a? a+ b? b~ r~");
  CHECK(run.tick() == "r? b? b+ r-");
  CHECK(run.local("r", "decision") == 0);
  CHECK(run.tick() == "r? c? c+ a? a~ r~");
}

TEST_CASE("a decision is returned at once when no child runs") {
  Run run(
      "(ReactiveFallback :name r :wait 1 (Condition :ID c)"
      " (Action :ID a))",
      {{"c", "+"}});
  CHECK(run.tick() == "r? c? c+ r+");
}

TEST_CASE("a reactive node that is halted while it waits forgets") {
  Run run(
      ":loop 1 (ReactiveSequence :name o :halt 1 (Condition :ID d)"
      " (ReactiveFallback :name r :wait 1 (Condition :ID c)"
      " (Action :ID a)))",
      {{"d", "++-+"}, {"c", "-+-"}, {"a", "~"}});
  run.tick();
  CHECK(run.tick() == "o? d? d+ r? c? c+ r~ o~");
  CHECK(run.tick() == "o? d? d- a! r! o-");
  CHECK(run.local("r", "decision") == 0);
  CHECK(run.tick() == "o? d? d+ r? c? c- a? a~ r~ o~");
}

// --- Parallel ------------------------------------------------------------

TEST_CASE("a Parallel ticks every child and succeeds with m successes") {
  Run run(
      "(Parallel :name p :success 2"
      " (Action :ID a) (Action :ID b) (Action :ID c))",
      {{"a", "+"}, {"b", "~+"}, {"c", "-"}});
  CHECK(run.tick() == "p? a? a+ b? b~ c? c- p~");
  CHECK(run.local("p", "finished") == 0b101);
  CHECK(run.tick() == "p? b? b+ p+");
  CHECK(run.local("p", "finished") == 0);
}

TEST_CASE("a Parallel fails with more than n - m failures") {
  Run run(
      "(Parallel :name p :success 2"
      " (Action :ID a) (Action :ID b) (Action :ID c))",
      {{"a", "-"}, {"b", "~"}, {"c", "-"}});
  CHECK(run.tick() == "p? a? a- b? b~ c? c- p-");
  CHECK(run.status("b") == kRunning);
}

TEST_CASE("a ParallelAll fails with its first failure") {
  Run run("(ParallelAll :name p (Action :ID a) (Action :ID b))",
          {{"a", "~"}, {"b", "-"}});
  CHECK(run.tick() == "p? a? a~ b? b- p-");
}

TEST_CASE("a Parallel with :halt halts who still runs when it decides") {
  Run run(
      "(Parallel :name p :success 1 :halt 1"
      " (Action :ID a) (Action :ID b) (Action :ID c))",
      {{"a", "~"}, {"b", "+"}, {"c", "~"}});
  CHECK(run.tick() == "p? a? a~ b? b+ c? c~ a! c! p+");
}

TEST_CASE("a Parallel with :wait runs until its children have ended") {
  Run run(
      ":loop 1 (Parallel :name p :success 1 :wait 1"
      " (Action :ID a) (Action :ID b))",
      {{"a", "~~-"}, {"b", "+"}});
  CHECK(run.tick() == "p? a? a~ b? b+ p~");
  CHECK(run.tick() == "p? a? a~ p~");
  CHECK(run.tick() == "p? a? a- p+");
  CHECK(run.tick() == "p? a? a- b? b+ p+");
}

TEST_CASE("a new activation of a Parallel ticks an orphan again") {
  Run run(
      ":loop 1 (Parallel :name p :success 1"
      " (Action :ID a) (Action :ID b))",
      {{"a", "~"}, {"b", "+-"}});
  CHECK(run.tick() == "p? a? a~ b? b+ p+");
  CHECK(run.tick() == "p? a? a~ b? b- p~");
  CHECK(run.tick() == "p? a? a~ p~");
}

TEST_CASE("a halted Parallel halts who runs and forgets who has finished") {
  Run run(
      ":loop 1 (ReactiveSequence :name r :halt 1 (Condition :ID d)"
      " (ParallelAll :name p"
      " (Action :ID a) (Action :ID b) (Action :ID c)))",
      {{"d", "+-+"}, {"a", "~"}, {"b", "+"}, {"c", "~"}});
  run.tick();
  CHECK(run.tick() == "r? d? d- a! c! p! r-");
  CHECK(run.tick() == "r? d? d+ p? a? a~ b? b+ c? c~ p~ r~");
}

// --- Decorators ----------------------------------------------------------

TEST_CASE("an Inverter swaps success and failure and passes running on") {
  Run run(":loop 1 (Inverter :name i (Action :ID a))", {{"a", "+-~"}});
  CHECK(run.tick() == "i? a? a+ i-");
  CHECK(run.tick() == "i? a? a- i+");
  CHECK(run.tick() == "i? a? a~ i~");
}

TEST_CASE("ForceSuccess and ForceFailure let running pass") {
  Run succeed(":loop 1 (ForceSuccess :name f (Action :ID a))", {{"a", "~+-"}});
  CHECK(succeed.tick() == "f? a? a~ f~");
  CHECK(succeed.tick() == "f? a? a+ f+");
  CHECK(succeed.tick() == "f? a? a- f+");
  Run fail(":loop 1 (ForceFailure :name f (Action :ID a))", {{"a", "~+-"}});
  CHECK(fail.tick() == "f? a? a~ f~");
  CHECK(fail.tick() == "f? a? a+ f-");
  CHECK(fail.tick() == "f? a? a- f-");
}

TEST_CASE("KeepRunningUntilFailure makes success running") {
  Run run("(KeepRunningUntilFailure :name k (Action :ID a))", {{"a", "+~-"}});
  CHECK(run.tick() == "k? a? a+ k~");
  CHECK(run.tick() == "k? a? a~ k~");
  CHECK(run.tick() == "k? a? a- k-");
}

TEST_CASE("Repeat goes on in the same tick and keeps its count in between") {
  Run run("(Repeat :name n :repeat 3 (Action :ID a))", {{"a", "+~+"}});
  CHECK(run.tick() == "n? a? a+ a? a~ n~");
  CHECK(run.local("n", "count") == 1);
  CHECK(run.tick() == "n? a? a+ a? a+ n+");
  CHECK(run.local("n", "count") == 0);
}

TEST_CASE("a failing child makes Repeat fail and start over") {
  Run run(":loop 1 (Repeat :name n :repeat 2 (Action :ID a))", {{"a", "+-+"}});
  CHECK(run.tick() == "n? a? a+ a? a- n-");
  CHECK(run.local("n", "count") == 0);
  CHECK(run.tick() == "n? a? a+ a? a+ n+");
}

TEST_CASE("RetryUntilSuccessful takes n failures or one success") {
  Run run(
      ":loop 1 (RetryUntilSuccessful :name n :num_attempts 2"
      " (Action :ID a))",
      {{"a", "-~+--"}});
  CHECK(run.tick() == "n? a? a- a? a~ n~");
  CHECK(run.local("n", "count") == 1);
  CHECK(run.tick() == "n? a? a+ n+");
  CHECK(run.local("n", "count") == 0);
  CHECK(run.tick() == "n? a? a- a? a- n-");
}

TEST_CASE("halting a decorator halts its child and clears its counter") {
  Run run(
      ":loop 1 (ReactiveSequence :name r :halt 1 (Condition :ID c)"
      " (Repeat :name n :repeat 2 (Inverter :name i (Action :ID a))))",
      {{"c", "+-+"}, {"a", "-~"}});
  CHECK(run.tick() == "r? c? c+ n? i? a? a- i+ i? a? a~ i~ n~ r~");
  CHECK(run.local("n", "count") == 1);
  CHECK(run.tick() == "r? c? c- a! i! n! r-");
  CHECK(run.local("n", "count") == 0);
}

// --- RateController ------------------------------------------------------

TEST_CASE("a RateController activates its child every period") {
  Run run(":loop 1 (RateController :name h :hz 5 (Action :ID a))",
          {{"a", "+"}});
  CHECK(run.tick() == "h? a? a+ h+");
  CHECK(run.tick() == "h? h~");
  CHECK(run.tick() == "h? a? a+ h+");
  CHECK(run.tick() == "h? h~");
}

TEST_CASE("a RateController ticks a running child every tick") {
  Run run(":loop 1 (RateController :name h :hz 3.5 (Action :ID a))",
          {{"a", "~+-"}});
  CHECK(run.tick() == "h? a? a~ h~");
  CHECK(run.tick() == "h? a? a+ h+");
  CHECK(run.tick() == "h? h~");
  CHECK(run.tick() == "h? a? a- h-");
}

TEST_CASE("a RateController faster than the ticks holds nothing back") {
  Run run(":loop 1 (RateController :name h :hz 50 (Action :ID a))",
          {{"a", "+"}});
  CHECK(run.tick() == "h? a? a+ h+");
  CHECK(run.tick() == "h? a? a+ h+");
}

TEST_CASE("a RateController counts time, not how often it is ticked") {
  Run run(
      ":loop 1 (Fallback :name f (RateController :name h :args (hz 4)"
      " (Action :ID a)) (Action :ID b))",
      {{"a", "-"}, {"b", "~~~+"}});
  CHECK(run.tick() == "f? h? a? a- h- b? b~ f~");
  CHECK(run.tick() == "f? b? b~ f~");
  CHECK(run.tick() == "f? b? b~ f~");
  CHECK(run.tick() == "f? b? b+ f+");
  CHECK(run.tick() == "f? h? a? a- h- b? b+ f+");
}

TEST_CASE("a halted RateController activates its child at once") {
  Run run(
      ":loop 1 (ReactiveSequence :name r :halt 1 (Condition :ID c)"
      " (RateController :name h :hz 1 (Action :ID a)))",
      {{"c", "++-+"}, {"a", "+~"}});
  CHECK(run.tick() == "r? c? c+ h? a? a+ h+ r+");
  CHECK(run.tick() == "r? c? c+ h? h~ r~");
  CHECK(run.tick() == "r? c? c- h! r-");
  CHECK(run.tick() == "r? c? c+ h? a? a~ h~ r~");
}

// --- Nodes of Nav2 -------------------------------------------------------

TEST_CASE("Recovery retries its first child after a recovery") {
  Run run("(Recovery :name r :num_retries 1 (Action :ID a) (Action :ID b))",
          {{"a", "-~-"}, {"b", "~+"}});
  CHECK(run.tick() == "r? a? a- b? b~ r~");
  CHECK(run.local("r", "retry") == 0);
  CHECK(run.tick() == "r? b? b+ a? a~ r~");
  CHECK(run.local("r", "retry") == 1);
  CHECK(run.tick() == "r? a? a- r-");
  CHECK(run.local("r", "retry") == 0);
}

TEST_CASE("Recovery succeeds with its first child") {
  Run run("(Recovery :name r :num_retries 2 (Action :ID a) (Action :ID b))",
          {{"a", "--+"}, {"b", "+"}});
  CHECK(run.tick() == "r? a? a- b? b+ a? a- b? b+ a? a+ r+");
}

TEST_CASE("Recovery fails with its second child") {
  Run run("(Recovery :name r :num_retries 2 (Action :ID a) (Action :ID b))",
          {{"a", "-"}, {"b", "+-"}});
  CHECK(run.tick() == "r? a? a- b? b+ a? a- b? b- r-");
  CHECK(run.local("r", "retry") == 0);
}

TEST_CASE("a halted Recovery starts over") {
  Run run(
      ":loop 1 (ReactiveSequence :name o :halt 1 (Condition :ID c)"
      " (Recovery :name r :num_retries 2 (Action :ID a) (Action :ID b)))",
      {{"c", "+-+"}, {"a", "--~"}, {"b", "+~"}});
  CHECK(run.tick() == "o? c? c+ r? a? a- b? b+ a? a- b? b~ r~ o~");
  CHECK(run.local("r", "retry") == 1);
  CHECK(run.tick() == "o? c? c- b! r! o-");
  CHECK(run.local("r", "retry") == 0);
  CHECK(run.tick() == "o? c? c+ r? a? a~ r~ o~");
}

TEST_CASE("after a success RoundRobin begins with the following child") {
  Run run(
      ":loop 1 (RoundRobin :name r"
      " (Action :ID a) (Action :ID b) (Action :ID c))",
      {{"a", "+-"}, {"b", "-~"}, {"c", "~+"}});
  CHECK(run.tick() == "r? a? a+ r+");
  CHECK(run.local("r", "next") == 2);
  CHECK(run.tick() == "r? b? b- c? c~ r~");
  CHECK(run.local("r", "next") == 3);
  CHECK(run.local("r", "failed") == 1);
  CHECK(run.tick() == "r? c? c+ r+");
  CHECK(run.local("r", "next") == 1);
  CHECK(run.local("r", "failed") == 0);
  CHECK(run.tick() == "r? a? a- b? b~ r~");
}

TEST_CASE("RoundRobin fails when all of its children have failed") {
  Run run(":loop 1 (RoundRobin :name r (Action :ID a) (Action :ID b))",
          {{"a", "+-"}, {"b", "~-"}});
  CHECK(run.tick() == "r? a? a+ r+");
  CHECK(run.tick() == "r? b? b~ r~");
  CHECK(run.tick() == "r? b? b- a? a- r-");
  CHECK(run.local("r", "next") == 2);
  CHECK(run.local("r", "failed") == 0);
}

TEST_CASE("PipelineSequence goes past a running child up to the furthest") {
  Run run(
      "(PipelineSequence :name p"
      " (Action :ID a) (Action :ID b) (Action :ID c))",
      {{"a", "++~+~"}, {"b", "~+~"}, {"c", "~~+"}});
  CHECK(run.tick() == "p? a? a+ b? b~ p~");
  CHECK(run.local("p", "furthest") == 2);
  CHECK(run.tick() == "p? a? a+ b? b+ c? c~ p~");
  CHECK(run.local("p", "furthest") == 3);
  CHECK(run.tick() == "p? a? a~ b? b~ c? c~ p~");
  CHECK(run.tick() == "p? a? a+ b? b~ c? c+ b! p+");
  CHECK(run.local("p", "furthest") == 1);
}

TEST_CASE("a failure in a PipelineSequence halts what runs") {
  Run run(
      ":loop 1 (PipelineSequence :name p"
      " (Action :ID a) (Action :ID b) (Action :ID c))",
      {{"a", "+~"}, {"b", "+-"}, {"c", "~"}});
  CHECK(run.tick() == "p? a? a+ b? b+ c? c~ p~");
  CHECK(run.tick() == "p? a? a~ b? b- a! c! p-");
  CHECK(run.tick() == "p? a? a~ p~");
}

// --- Leaves --------------------------------------------------------------

TEST_CASE("a running Action is ticked again and chooses again") {
  Run run("(Action :ID a)", {{"a", "~~+"}});
  run.tick();
  CHECK(run.answers_allowed == std::vector{kSuccess, kFailure, kRunning});
  CHECK(run.tick() == "a? a~");
  CHECK(run.tick() == "a? a+");
}

TEST_CASE(":SF removes running, and a Condition never runs") {
  Run action("(Action :ID a :SF)");
  action.tick();
  CHECK(action.answers_allowed == std::vector{kSuccess, kFailure});
  Run condition("(Condition :ID c)");
  condition.tick();
  CHECK(condition.answers_allowed == std::vector{kSuccess, kFailure});
}

TEST_CASE("a leaf that may not answer so is an error of the script") {
  Run run("(Action :ID a :SF)", {{"a", "~"}});
  CHECK_THROWS_AS(run.tick(), std::logic_error);
}

constexpr const char* kLight =
    "(defsv light :states (red green amber) :init red"
    " :transitions ((red green) (green amber) (amber red))";

TEST_CASE("SetSV moves along the transitions or stays") {
  Run run(":loop 1 (SetSV :name s :sv light)", {}, kLight + std::string(")"));
  run.chosen = 1;
  CHECK(run.tick() == "s? s+");
  CHECK(run.values_allowed == std::vector{0, 1});
  CHECK(run.variable(0) == 1);
  run.tick();
  CHECK(run.values_allowed == std::vector{1, 2});
  run.chosen = 0;
  CHECK_THROWS_AS(run.tick(), std::logic_error);
}

TEST_CASE("an enumeration that nothing writes moves before a tick") {
  Run run("(Eval :name e (= light green))", {}, kLight + std::string(")"));
  run.moves[0] = 1;
  CHECK(run.tick() == "e? e+");
}

TEST_CASE("a sampled enumeration does not move by itself") {
  Run run("(Eval :name e (= light green))", {},
          kLight + std::string(" :moves sampled)"));
  run.moves[0] = 1;
  CHECK_THROWS_AS(run.tick(), std::logic_error);
}

constexpr const char* kLevel = "(defsv level :init 0 :min 0 :max 2)";

TEST_CASE("Eval tests, and := assigns and succeeds") {
  Run run(
      ":loop 1 (Sequence :name s (Eval :name e (:= level (+ 1 $level)))"
      " (Eval :name f (= level 2)))",
      {}, kLevel);
  CHECK(run.tick() == "s? e? e+ f? f- s-");
  CHECK(run.tick() == "s? e? e+ f? f+ s+");
  CHECK(run.variable(0) == 2);
}

TEST_CASE("a value outside its range ends the run") {
  Run run(
      ":loop 1 (Sequence :name s (Action :ID a)"
      " (Eval :name e (:= level (- level 1))))",
      {{"a", "+"}}, kLevel);
  const TickResult result = run.interpreter.tick();
  CHECK(result.fault);
  CHECK(result.variables == std::vector{0});
  CHECK(result.events.back() == TickEvent{run.find("e"), EventKind::Ticked});
  CHECK(run.tick().empty());
  CHECK(run.interpreter.fault());
}

TEST_CASE("an expression reads the status a node returned last") {
  Run run(
      "(Sequence :name s (ForceSuccess :name f (Action :ID a))"
      " (Eval :name e (= a.rstatus failure)))",
      {{"a", "-"}});
  CHECK(run.tick() == "s? f? a? a- f+ e? e+ s+");
}

TEST_CASE("arithmetic, order and logic are those of the norm") {
  Run run(
      "(Eval :name e (and (= (mod 7 3) 1) (~ (< 2 1)) (>= (* 2 3) 6)"
      " (or (> 1 2) (~= (/ 7 2) 4)) (<= (- 1 2) 0)))");
  CHECK(run.tick() == "e? e+");
}

TEST_CASE("Wait runs for n ticks and succeeds in the n-th after the first") {
  Run run(":loop 1 (Wait :name w :duration 2)");
  CHECK(run.tick() == "w? w~");
  CHECK(run.tick() == "w? w~");
  CHECK(run.tick() == "w? w+");
  CHECK(run.tick() == "w? w~");
}

TEST_CASE("a Wait that nobody ticks goes on counting") {
  Run run(
      ":loop 1 (ReactiveFallback :name r (Condition :ID c)"
      " (Wait :name w :duration 2))",
      {{"c", "-+++-"}});
  run.tick();
  for (int i = 0; i < 3; ++i) CHECK(run.tick() == "r? c? c+ r+");
  CHECK(run.tick() == "r? c? c- w? w+ r+");
}

TEST_CASE("a halted Wait starts from the beginning") {
  Run run(
      ":loop 1 (ReactiveFallback :name r :halt 1 (Condition :ID c)"
      " (Wait :name w :duration 2))",
      {{"c", "-+-"}});
  run.tick();
  CHECK(run.tick() == "r? c? c+ w! r+");
  CHECK(run.tick() == "r? c? c- w? w~ r~");
  CHECK(run.tick() == "r? c? c- w? w~ r~");
  CHECK(run.tick() == "r? c? c- w? w+ r+");
}

TEST_CASE("an Action with :duration runs until it is due") {
  Run run("(Action :ID a :duration [2,3])");
  CHECK(run.tick() == "a? a~");
  CHECK(run.tick() == "a? a~");
  CHECK(run.answers_allowed == std::vector{kRunning});
  CHECK(run.tick() == "a? a~");
  CHECK(run.tick() == "a? a+");
  CHECK(run.answers_allowed == std::vector{kSuccess, kFailure});
}

TEST_CASE("an Action with :duration may be due as soon as min has passed") {
  Run run("(Action :ID a :duration [2,4])");
  run.due_at = 0;
  CHECK(run.tick() == "a? a~");
  CHECK(run.tick() == "a? a~");
  CHECK(run.tick() == "a? a+");
}

TEST_CASE("where its requirement is false a leaf can only fail") {
  Run run("(Action :ID a)", {},
          kLevel + std::string("(defaction a :requires (> level 0))"));
  CHECK(run.tick() == "a? a-");
  CHECK(run.answers_allowed == std::vector{kFailure});
}

TEST_CASE("a decision leaves one answer, and running") {
  Run run(":loop 1 (Action :ID a)", {{"a", "~-+"}},
          kLevel + std::string("(defaction a :succeeds-when (> level 0) "
                               ":on-failure ((:= level 1)))"));
  CHECK(run.tick() == "a? a~");
  CHECK(run.answers_allowed == std::vector{kFailure, kRunning});
  CHECK(run.tick() == "a? a-");
  run.tick();
  CHECK(run.answers_allowed == std::vector{kSuccess, kRunning});
}

TEST_CASE("effects apply with the answer they belong to") {
  Run run(":loop 1 (Action :ID a)", {{"a", "~+-"}},
          kLevel + std::string("(defaction a :on-success ((:= level 2))"
                               " :on-failure ((:= level 1)))"));
  run.tick();
  CHECK(run.variable(0) == 0);
  run.tick();
  CHECK(run.variable(0) == 2);
  run.tick();
  CHECK(run.variable(0) == 1);
}

TEST_CASE("a contract names what the leaf may return") {
  Run run("(Action :ID a)", {}, "(defaction a :returns (success running))");
  run.tick();
  CHECK(run.answers_allowed == std::vector{kSuccess, kRunning});
}

}  // namespace
}  // namespace btcheck::reference::tick_interpreter_test
