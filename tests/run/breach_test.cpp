// SPDX-License-Identifier: MIT
//
// Contracts broken on purpose, in many ways and under every policy: each is
// reported as what it is, and the run stays one of the model.
#include <doctest/doctest.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "run/driven.hpp"
#include "run/leaves/function_leaves.hpp"
#include "run/process/process_leaves.hpp"

namespace btcheck::breach_test {
namespace {

using namespace std::chrono_literals;

constexpr OnBreach kPolicies[] = {OnBreach::Stop, OnBreach::Fail,
                                  OnBreach::GoOn};

Reply succeeds() { return Reply::answer(NodeStatus::Success); }
Reply fails() { return Reply::answer(NodeStatus::Failure); }
Reply runs() { return Reply::answer(NodeStatus::Running); }

// Replies by the number of the question, from 1.
class Canned : public Leaves {
 public:
  using Replies = std::function<Reply(const LeafQuestion&, int)>;
  explicit Canned(Replies replies) : replies_(std::move(replies)) {}
  Reply ask(const LeafQuestion& question) override {
    return replies_(question, ++asked_);
  }
  std::optional<VariableMove> next_move(int tick, StateView) override {
    if (!move || moved_ == tick) return std::nullopt;
    moved_ = tick;
    return move;
  }
  std::optional<VariableMove> move;

 private:
  Replies replies_;
  int asked_ = 0;
  int moved_ = 0;
};

struct Case {
  std::string name;
  std::string tree;
  Canned::Replies replies;
  BreachKind kind;
};

std::string root(const std::string& body) {
  return "(BehaviorTree :name t (Fallback " + body +
         " (Action :ID other :SF)))";
}

// The first leaf misbehaves, `other` succeeds.
Canned::Replies first(Canned::Replies replies) {
  return [replies](const LeafQuestion& question, int asked) {
    return index(question.node) == 2 ? replies(question, asked) : succeeds();
  };
}
Canned::Replies always(Reply (*reply)()) {
  return first([reply](const LeafQuestion&, int) { return reply(); });
}

std::vector<Case> answers_not_allowed() {
  using enum BreachKind;
  const std::string act = "(Action :ID a";
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, const std::string& definition,
                       const std::string& leaf, Reply (*reply)(),
                       BreachKind kind) {
    cases.push_back({name, definition + root(leaf), always(reply), kind});
  };
  add("an :SF action runs", "", act + " :SF)", runs, Forbidden);
  add("a duration of 0 runs", "", act + " :duration 0)", runs, TooLate);
  for (const auto& [returns, reply] :
       std::vector<std::pair<std::string, Reply (*)()>>{
           {"(success)", fails},
           {"(failure)", succeeds},
           {"(running success)", fails},
           {"(running failure)", succeeds},
           {"(success)", runs},
           {"(failure)", runs},
           {"(success failure)", runs}}) {
    add("returns " + returns, "(defaction a :returns " + returns + ")",
        act + ")", reply, Forbidden);
  }
  for (const auto& [returns, reply] :
       std::vector<std::pair<std::string, Reply (*)()>>{
           {"(success)", fails}, {"(failure)", succeeds}}) {
    add("a condition returns " + returns,
        "(defcondition a :returns " + returns + ")", "(Condition :ID a)", reply,
        Forbidden);
  }
  add("a condition runs", "", "(Condition :ID a)", runs, WrongAnswer);
  for (const std::string duration : {"3", "[2,4]", "[2,2]", "5"}) {
    const std::string leaf = act + " :duration " + duration + ")";
    add("success before " + duration, "", leaf, succeeds, TooEarly);
    add("failure before " + duration, "", leaf, fails, TooEarly);
    add("running after " + duration, "", leaf, runs, TooLate);
  }
  for (const int late : {2, 3}) {
    cases.push_back({"early in tick " + std::to_string(late),
                     root(act + " :duration [4,6])"),
                     first([late](const LeafQuestion&, int asked) {
                       return asked < late ? runs() : succeeds();
                     }),
                     TooEarly});
  }
  for (const std::string sampled : {"Critical", "Full"}) {
    cases.push_back(
        {"a measurement that transitions exclude",
         "(defsv b :states (Good Low Critical Full) :init Good :transitions "
         "((Good Low) (Low Critical)))" +
             root("(SetSV :ID a :sv b)"),
         first([sampled](const LeafQuestion&, int) {
           return Reply::answer(sampled == "Critical" ? 2 : 3);
         }),
         Forbidden});
  }
  for (const BreachKind kind :
       {NoAnswer, Threw, Gone, Nonsense, WrongAnswer, AnsweredTwice}) {
    for (const std::string& leaf :
         std::vector<std::string>{act + ")", act + " :SF)", "(Condition :ID a)",
                                  act + " :duration 3)"}) {
      cases.push_back({"a leaf without an answer", root(leaf),
                       first([kind](const LeafQuestion&, int) {
                         return Reply::broken(kind, "`a` is broken");
                       }),
                       kind});
    }
  }
  return cases;
}

int told_breaches = 0;

void check_reported(const Driven& driven, BreachKind kind, OnBreach policy) {
  REQUIRE(!driven.breaches.empty());
  CHECK(driven.breaches[0].kind == kind);
  CHECK(driven.breaches[0].tick >= 1);
  CHECK(driven.breaches[0].text.size() > 5);
  CHECK(driven.is_run_of_the_model);
  if (policy == OnBreach::Stop) CHECK(driven.end == EngineState::Breached);
  CHECK((driven.reason.empty() || driven.end == EngineState::Breached));
  ++told_breaches;
}

}  // namespace

TEST_CASE("every breach is reported, under every policy") {
  told_breaches = 0;
  for (const Case& each : answers_not_allowed()) {
    for (const OnBreach policy : kPolicies) {
      CAPTURE(each.name);
      CAPTURE(each.tree);
      CAPTURE(static_cast<int>(policy));
      const LoweredTree lowered(each.tree);
      const CompiledNetwork system(lowered.network);
      Canned leaves(each.replies);
      check_reported(drive(lowered, system, leaves, policy, 12), each.kind,
                     policy);
    }
  }
  MESSAGE(told_breaches << " breaches reported");
  CHECK(told_breaches >= 100);
}

TEST_CASE("what the policies do") {
  const LoweredTree lowered(
      "(BehaviorTree :name t (Action :ID a :duration "
      "[2,4]))");
  const CompiledNetwork system(lowered.network);
  Canned early([](const LeafQuestion&, int) { return succeeds(); });
  // The answer waits until the model allows it, and is asked for once.
  CHECK(drive(lowered, system, early, OnBreach::GoOn, 9).lines ==
        "tick 1: root=running a=running\n"
        "tick 2: root=running a=running\n"
        "tick 3: root=success a=success\n");
  Canned again([](const LeafQuestion&, int) { return succeeds(); });
  CHECK(drive(lowered, system, again, OnBreach::Fail, 9).lines ==
        "tick 1: root=running a=running\n"
        "tick 2: root=running a=running\n"
        "tick 3: root=failure a=failure\n");
  Canned stopped([](const LeafQuestion&, int) { return succeeds(); });
  const Driven driven = drive(lowered, system, stopped, OnBreach::Stop, 9);
  CHECK(driven.lines == "tick 1: root=none a=none\n");
  CHECK(driven.breaches.size() == 1);
  CHECK(driven.breaches[0].text ==
        "`a` answered success after 0 ticks; its duration is [2,4]; there it "
        "can answer running");
}

TEST_CASE("where the model has no way out the run ends") {
  const LoweredTree lowered(
      "(defaction a :returns (success)) (BehaviorTree :name t (Action :ID a))");
  const CompiledNetwork system(lowered.network);
  for (const OnBreach policy : {OnBreach::Fail, OnBreach::GoOn}) {
    Canned leaves([](const LeafQuestion&, int) { return fails(); });
    const Driven driven = drive(lowered, system, leaves, policy, 9);
    CHECK(driven.end == EngineState::Breached);
    CHECK(driven.reason.starts_with("the model does not let `a` "));
  }
}

TEST_CASE(
    "a requirement that is false fails the leaf without its being asked") {
  const LoweredTree lowered(
      "(defsv x :max 1) (defaction a :requires (= x 1))"
      "(BehaviorTree :name t (Action :ID a))");
  const CompiledNetwork system(lowered.network);
  int asked = 0;
  Canned leaves([&](const LeafQuestion&, int) {
    ++asked;
    return succeeds();
  });
  const Driven driven = drive(lowered, system, leaves, OnBreach::Stop, 9);
  CHECK(driven.lines == "tick 1: root=failure x=0 a=failure\n");
  CHECK(driven.breaches.empty());
  CHECK(asked == 0);
}

TEST_CASE("a variable changes along its transitions only") {
  const LoweredTree lowered(
      "(defsv w :states (Calm Windy Storm) :init Calm :transitions ((Calm "
      "Windy) (Windy Storm))) (BehaviorTree :name t (Action :ID a))");
  const CompiledNetwork system(lowered.network);
  for (const OnBreach policy : kPolicies) {
    Canned leaves([](const LeafQuestion&, int) { return runs(); });
    leaves.move = VariableMove{StateVariableId{0}, 2};
    const Driven driven = drive(lowered, system, leaves, policy, 3);
    CHECK(driven.breaches.at(0).text ==
          "`w` became Storm, which :transitions exclude from Calm at this "
          "time; it "
          "stays");
    CHECK(driven.is_run_of_the_model);
    CHECK(driven.breaches.size() == (policy == OnBreach::Stop ? 1 : 3));
  }
  Canned leaves([](const LeafQuestion&, int) { return runs(); });
  leaves.move = VariableMove{StateVariableId{0}, 1};
  CHECK(drive(lowered, system, leaves, OnBreach::Stop, 1).lines ==
        "tick 1: root=running w=Windy a=running\n");
}

// --- A process -----------------------------------------------------------

namespace {

struct Talk {
  std::string said;  // after the first question, by printf
  BreachKind kind;
};

// Answers `begin` and then, to the first question, with what is given; all
// others get success.
std::string shell_leaves(const std::string& said) {
  return "read l; echo '{\"id\":0,\"answer\":\"ready\"}'; read l; " + said +
         "; i=1; while read l; do i=$((i+1)); echo "
         "\"{\\\"id\\\":$i,\\\"answer\\\":\\\"success\\\"}\"; done";
}
std::string says(const std::string& line) { return "echo '" + line + "'"; }

const std::vector<Talk>& talks() {
  using enum BreachKind;
  static const std::vector<Talk> all = {
      {says("hello"), Nonsense},
      {says("[1]"), Nonsense},
      {says("{}"), Nonsense},
      {says("{\"id\":1}"), Nonsense},
      {says("{\"id\":-1,\"answer\":\"success\"}"), Nonsense},
      {says("{\"id\":1,\"answer\":7}"), Nonsense},
      {says("{\"set\":\"w\"}"), Nonsense},
      {says(""), Nonsense},
      {"head -c 1100000 /dev/zero | tr '\\0' x", Nonsense},
      {says("{\"id\":1,\"answer\":\"maybe\"}"), WrongAnswer},
      {says("{\"id\":1,\"answer\":\"halted\"}"), WrongAnswer},
      {says("{\"id\":1,\"value\":\"Low\"}"), WrongAnswer},
      {"sleep 30", NoAnswer},
      {"exit 3", Gone},
      {"kill -9 $$", Gone},
      {"exec >&-; sleep 1", Gone},
  };
  return all;
}

}  // namespace

TEST_CASE("a process that hangs, dies or talks nonsense is reported") {
  told_breaches = 0;
  const LoweredTree lowered(
      "(defsv w :states (Calm Storm) :init Calm :transitions :all)"
      "(BehaviorTree :name t (Fallback (Action :ID a) (Action :ID other)))");
  const CompiledNetwork system(lowered.network);
  for (const Talk& talk : talks()) {
    for (const OnBreach policy : kPolicies) {
      CAPTURE(talk.said);
      CAPTURE(static_cast<int>(policy));
      const std::chrono::milliseconds patience =
          talk.kind == BreachKind::NoAnswer ? 300ms : 20s;
      ProcessLeaves leaves(lowered.tree, system,
                           {shell_leaves(talk.said), patience, 100, {}});
      REQUIRE(leaves.begin() == "");
      check_reported(drive(lowered, system, leaves, policy, 2), talk.kind,
                     policy);
    }
  }
  CHECK(told_breaches == 48);
}

TEST_CASE("what a process says without being asked is reported") {
  const LoweredTree lowered(
      "(defsv w :states (Calm Storm) :init Calm :transitions :all)"
      "(defsv x :max 2)"
      "(BehaviorTree :name t (Sequence (Action :ID a) (SetSV :ID m :sv x)))");
  const CompiledNetwork system(lowered.network);
  const std::string ok = "{\"id\":1,\"answer\":\"running\"}";
  for (const Talk& talk : std::vector<Talk>{
           {"{\"id\":0,\"answer\":\"ready\"}", BreachKind::AnsweredTwice},
           {"{\"id\":99,\"answer\":\"success\"}", BreachKind::Nonsense},
           {"{\"set\":\"x\",\"value\":1}", BreachKind::WrongAnswer},
           {"{\"set\":\"w\",\"value\":\"Mild\"}", BreachKind::WrongAnswer},
           {"{\"set\":\"w\",\"value\":1}", BreachKind::WrongAnswer},
           {"{\"set\":\"v\",\"value\":1}", BreachKind::WrongAnswer}}) {
    CAPTURE(talk.said);
    ProcessLeaves leaves(
        lowered.tree, system,
        {shell_leaves(says(talk.said) + "; " + says(ok)), 20s, 100, {}});
    REQUIRE(leaves.begin() == "");
    const Driven driven = drive(lowered, system, leaves, OnBreach::GoOn, 3);
    REQUIRE(!driven.breaches.empty());
    CHECK(driven.breaches[0].kind == talk.kind);
    CHECK(driven.is_run_of_the_model);
  }
}

namespace {

// Four actions that run until `stop` fails, so that all of them are halted in
// one tick; the last one is asked in it. Leaves in Python, by what they do.
constexpr const char* kHaltingTree =
    "(BehaviorTree :name t (ReactiveFallback :halt 1 (Condition :ID stop)"
    " (Parallel :success 4 (Action :ID a) (Action :ID b) (Action :ID c)"
    " (Action :ID d))))";

std::string halting_leaves(const std::string& halt) {
  return R"(exec python3 -c '
import json, sys, threading, time, os
def say(id, answer):
    line = json.dumps({"id": id, "answer": answer}) + "\n"
    os.write(1, line.encode())  # whole, whichever threads say something
ticks = 0
for line in sys.stdin:
    m = json.loads(line)
    if m["do"] == "end": break
    if m["do"] == "begin": say(0, "ready")
    elif m["do"] == "ask":
        ticks += 1
        say(m["id"], "success" if ticks > 1 else "failure")
    elif m["do"] == "halt":
        )" +
         halt + R"(
    else: say(m["id"], "running")
')";
}

}  // namespace

TEST_CASE("those that are halted in one tick are waited for together") {
  const LoweredTree lowered(kHaltingTree);
  const CompiledNetwork system(lowered.network);
  ProcessLeaves leaves(
      lowered.tree, system,
      {halting_leaves(
           R"(threading.Timer(2, say, (m["id"], "halted")).start())"),
       20s,
       100,
       {}});
  REQUIRE(leaves.begin() == "");
  const auto begun = std::chrono::steady_clock::now();
  const Driven driven = drive(lowered, system, leaves, OnBreach::Stop, 3);
  const auto spent = std::chrono::steady_clock::now() - begun;
  CHECK(driven.breaches.empty());
  CHECK(driven.lines.find("root=success") != std::string::npos);
  CHECK(spent >= 2s);
  CHECK(spent < 6s);  // one after another they take 8
}

TEST_CASE("who does not halt in time is told of, each by name") {
  const LoweredTree lowered(kHaltingTree);
  const CompiledNetwork system(lowered.network);
  ProcessLeaves leaves(
      lowered.tree, system,
      {halting_leaves(R"(m["node"] == "b" and say(m["id"], "halted"))"),
       3s,
       100,
       {}});
  REQUIRE(leaves.begin() == "");
  const auto begun = std::chrono::steady_clock::now();
  const Driven driven = drive(lowered, system, leaves, OnBreach::GoOn, 3);
  CHECK(std::chrono::steady_clock::now() - begun < 6s);
  REQUIRE(driven.breaches.size() == 3);
  CHECK(driven.breaches[0].text ==
        "`a` has not answered within 3000 ms, when it was halted");
  CHECK(driven.breaches[1].text ==
        "`c` has not answered within 3000 ms, when it was halted");
  CHECK(driven.breaches[2].kind == BreachKind::NotHalted);
}

TEST_CASE("an answer to a question that was not asked is told at once") {
  const LoweredTree lowered("(BehaviorTree :name t (Action :ID a))");
  const CompiledNetwork system(lowered.network);
  ProcessLeaves leaves(
      lowered.tree, system,
      {shell_leaves(says("{\"id\":99,\"answer\":\"success\"}")), 20s, 100, {}});
  REQUIRE(leaves.begin() == "");
  const auto begun = std::chrono::steady_clock::now();
  const Driven driven = drive(lowered, system, leaves, OnBreach::Stop, 1);
  CHECK(std::chrono::steady_clock::now() - begun < 10s);
  REQUIRE(!driven.breaches.empty());
  CHECK(driven.breaches[0].text ==
        "question 99 is answered, which was not asked; `a` was asked question "
        "1");
}

TEST_CASE("a process that closes its output and lives is waited for once") {
  const LoweredTree lowered(
      "(BehaviorTree :name t (Parallel :success 2 (Action :ID a)"
      " (Action :ID b)))");
  const CompiledNetwork system(lowered.network);
  const auto begun = std::chrono::steady_clock::now();
  {
    ProcessLeaves leaves(
        lowered.tree, system,
        {"read l; echo '{\"id\":0,\"answer\":\"ready\"}'; read l; echo "
         "'{\"id\":1,\"answer\":\"running\"}'; exec >&-; exec sleep 30",
         20s,
         100,
         {}});
    REQUIRE(leaves.begin() == "");
    const Driven driven = drive(lowered, system, leaves, OnBreach::Stop, 3);
    REQUIRE(driven.breaches.size() == 1);
    CHECK(driven.breaches[0].text ==
          "the process of the leaves has closed its output");
    leaves.end("breached");
  }
  CHECK(std::chrono::steady_clock::now() - begun < 15s);
}

TEST_CASE("a process that is not ready is said to be so") {
  const LoweredTree lowered("(BehaviorTree :name t (Action :ID a))");
  const CompiledNetwork system(lowered.network);
  const auto complaint = [&](const std::string& command) {
    ProcessLeaves leaves(lowered.tree, system, {command, 20s, 100, {}});
    return leaves.begin();
  };
  CHECK(complaint("exit 2") ==
        "the process of the leaves has ended with exit code 2");
  CHECK(complaint("/nowhere/leaves 2>/dev/null") ==
        "the process of the leaves has ended with exit code 127");
  CHECK(complaint("read l; echo '{\"id\":0,\"answer\":\"success\"}'") ==
        "the process did not answer `ready` to `begin`");
}

// --- Functions -----------------------------------------------------------

TEST_CASE("a function that throws, hangs or does not stop is reported") {
  const LoweredTree lowered(
      "(defsv x :max 3) (BehaviorTree :name t (Fallback (Action :ID a :SF)"
      " (Condition :ID c) (Sequence (SetSV :ID m :sv x)"
      " (Action :ID b :duration [1,9]))))");
  const CompiledNetwork system(lowered.network);
  FunctionLeaves leaves(lowered.tree, 50ms);
  const auto node = [&](const std::string& id) {
    for (std::uint32_t n = 0; n < lowered.tree.nodes.size(); ++n) {
      if (lowered.tree.nodes[n].id == id) return NodeId{n};
    }
    return NodeId{0};
  };
  std::atomic<bool> is_over = false;
  leaves.give(node("a"),
              {run::ActionFunction([](const run::Call&, std::stop_token) {
                throw std::runtime_error("no engine");
                return run::Answer::Success;
              })});
  leaves.give(node("c"), {run::ConditionFunction([&](const run::Call&) {
                while (!is_over) std::this_thread::sleep_for(1ms);
                return true;
              })});
  leaves.give(
      node("m"),
      {run::MeasureFunction([](const run::Call&) { return run::Value(7); })});
  leaves.give(node("b"),
              {run::ActionFunction([&](const run::Call&, std::stop_token) {
                while (!is_over) std::this_thread::sleep_for(1ms);
                return run::Answer::Success;
              })});
  leaves.begin();
  const Driven driven = drive(lowered, system, leaves, OnBreach::Fail, 3);
  REQUIRE(driven.breaches.size() >= 3);
  CHECK(driven.breaches[0].text == "`a` threw: no engine");
  CHECK(driven.breaches[1].text == "`c` has not answered within 50 ms");
  CHECK(driven.breaches[2].text ==
        "`m` answered 7, which is not a number from 0 to 3");
  CHECK(driven.end == EngineState::Breached);  // a SetSV cannot fail
  CHECK(driven.is_run_of_the_model);
  CHECK(!leaves.end());  // `c` has not returned
  is_over = true;
  std::this_thread::sleep_for(20ms);
  CHECK(leaves.end());
}

}  // namespace btcheck::breach_test
