// SPDX-License-Identifier: MIT
//
// What the .btf reader understands: every form, keyword and spelling.
#include <doctest/doctest.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "btf_text.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf_reader_test {
namespace {

// The text of an Eval's expression between two variables and two leaves.
std::string eval(std::string_view expression) {
  const BehaviorTree tree = clean_tree_of(
      "(defsv fls :min -1 :max 3) (defsv k :max 9)"
      "(defsv battery :states (Good Low Critical))"
      "(defsv spare :states (Good Low Critical))"
      "(BehaviorTree :name t (Sequence (Eval " +
      std::string(expression) +
      ") (Action :ID land) (Condition :ID ok :name see)))");
  const Node& node = tree.nodes[2];
  if (!node.assignment) return text_of(tree, node.expression);
  return tree.variable(node.assignment->variable).name +
         " := " + text_of(tree, node.assignment->value);
}

// The node inside (BehaviorTree :name t ...).
Node node_of(std::string_view text) {
  return first_node(
      clean_tree_of("(defsv battery :states (Good Low))"
                    "(BehaviorTree :name t " +
                    std::string(text) + ")"));
}

TEST_CASE("the smallest tree is an action") {
  const BehaviorTree tree = clean_tree_of("(BehaviorTree (Action))");
  CHECK(tree.file == "t.btf");
  REQUIRE(tree.nodes.size() == 2);
  CHECK(tree.nodes[0].name == "BehaviorTree1");
  CHECK(tree.nodes[0].parent == NodeId{0});
  CHECK(tree.nodes[1].name == "Action1");
  CHECK(tree.nodes[1].parent == NodeId{0});
  CHECK(tree.nodes[1].span.column == 16);
  CHECK(tree.roots == std::vector<NodeId>{NodeId{0}});
}

TEST_CASE("forms stand in one list, one after another, or both") {
  const char* const texts[] = {
      "((defsv k :max 1)\n (BehaviorTree :name t (Eval (= k 0))))",
      "(defsv k :max 1) (BehaviorTree :name t (Eval (= k 0)))",
      "( ; a comment\n (defsv k :max 1)) (BehaviorTree :name t (Eval (= k 0)))",
      "(BehaviorTree :name t (Eval (= k 0))) ((defsv k :max 1))",
      "\xEF\xBB\xBF(defsv k :max 1)(BehaviorTree :name t(Eval(= k 0)));end",
      "()(defsv k :max 1)\r\n(BehaviorTree :name t\r\n\t(Eval (= k 0)))"};
  for (const char* text : texts) {
    CAPTURE(text);
    const BehaviorTree tree = clean_tree_of(text);
    CHECK(tree.nodes.size() == 2);
    CHECK(tree.variables.size() == 1);
  }
}

TEST_CASE("a node is called by its name, else its ID, else type and line") {
  const BehaviorTree tree = clean_tree_of(R"(
(BehaviorTree :ID root
 (Sequence
  (Action :ID go :name first)
  (Action :ID go)
  (Fallback (Action :name last)))))");
  CHECK(tree.nodes[0].name == "root");
  CHECK(tree.nodes[1].name == "Sequence3");
  CHECK(tree.nodes[2].name == "first");
  CHECK(tree.nodes[2].id == "go");
  CHECK(tree.nodes[3].name == "go");
  CHECK(tree.nodes[4].name == "Fallback6");
  CHECK(tree.nodes[5].id == "");
}

TEST_CASE("a number has a range, from 0 when no :min is given") {
  const BehaviorTree tree = clean_tree_of(
      "(defsv a :max 3) (defsv b :init -2 :max 5 :min -5) (defsv c :min 2 "
      ":max 2) (defsv d :min -2147483647 :max 2147483647) (BehaviorTree "
      "(Action))");
  CHECK(!tree.variables[0].is_enumeration());
  CHECK(tree.variables[0].min == 0);
  CHECK(tree.variables[0].max == 3);
  CHECK(tree.variables[0].initial == 0);
  CHECK(tree.variables[1].min == -5);
  CHECK(tree.variables[1].initial == -2);
  CHECK(tree.variables[2].initial == 2);
  CHECK(tree.variables[1].span.column == 25);
}

TEST_CASE("a number with a step is counted in steps") {
  const BehaviorTree tree = clean_tree_of(
      "(defsv a :max 6 :step 0.1 :init 1.5) (defsv b :step 0.25 :min -0.5 :max "
      "1) (defsv c :step 5 :max 100) (BehaviorTree (Action))");
  CHECK(tree.variables[0].max == 60);
  CHECK(tree.variables[0].initial == 15);
  CHECK(tree.variables[0].scale == Scale{1, 1});
  CHECK(tree.variables[0].value_name(15) == "1.5");
  CHECK(tree.variables[1].min == -2);
  CHECK(tree.variables[1].initial == -2);
  CHECK(tree.variables[1].scale == Scale{25, 2});
  CHECK(tree.variables[1].value_name(-1) == "-0.25");
  CHECK(tree.variables[2].max == 20);
  CHECK(tree.variables[2].value_name(20) == "100");
}

TEST_CASE("what is compared and assigned is counted in steps") {
  const auto height = [](const std::string& expression) {
    const BehaviorTree tree = clean_tree_of(
        "(defsv h :max 6 :step 0.1) (defsv q :max 6 :step 0.25) (defsv k :max "
        "9) (BehaviorTree (Eval " +
        expression + "))");
    const Node& node = tree.nodes[1];
    if (!node.assignment) return text_of(tree, node.expression);
    const std::string fits =
        node.assignment->fits.is_true()
            ? ""
            : ", if " + text_of(tree, node.assignment->fits);
    return text_of(tree, node.assignment->value) + fits;
  };
  CHECK(height("(> h 4.35)") == "h > 4.3");
  CHECK(height("(>= h 4.35)") == "h >= 4.4");
  CHECK(height("(< 4.35 h)") == "h > 4.3");
  CHECK(height("(= h 4.3)") == "h = 4.3");
  CHECK(height("(< k 2.5)") == "k < 3");
  CHECK(height("(:= h 0.5)") == "5");
  CHECK(height("(:= h (+ h 0.1))") == "h + 1");
  CHECK(height("(:= h k)") == "k * 10");
  CHECK(height("(:= h q)") == "q * 25 / 10, if q * 25 mod 10 = 0");
  CHECK(height("(:= h (* 0.5 h))") == "5 * h / 10, if 5 * h mod 10 = 0");
  CHECK(height("(:= h (* 0.5 (* 2 h)))") == "5 * (2 * h) / 10");
}

TEST_CASE("an enumeration starts in its first state and moves anywhere") {
  const BehaviorTree tree = clean_tree_of(
      "(defsv a :states (X Y Z)) (defsv b :moves free :transitions :all :init "
      "Y :states (X Y)) (BehaviorTree (Action))");
  using Pairs = std::vector<std::pair<int, int>>;
  CHECK(tree.variables[0].initial == 0);
  CHECK(tree.variables[0].max == 2);
  CHECK(tree.variables[0].moves == Moves::Default);
  CHECK(tree.variables[0].transitions ==
        Pairs{{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}});
  CHECK(tree.variables[1].initial == 1);
  CHECK(tree.variables[1].moves == Moves::Free);
  CHECK(tree.variables[1].transitions == Pairs{{0, 1}, {1, 0}});
}

TEST_CASE("listed transitions keep their order, without repetition or rest") {
  const BehaviorTree tree = clean_tree_of(
      "(defsv a :states (X Y Z) :transitions ((Z X) (X Y) (Z X) (Y Y))) "
      "(defsv b :states (X Y) :transitions () :moves sampled) "
      "(BehaviorTree (Action))");
  using Pairs = std::vector<std::pair<int, int>>;
  CHECK(tree.variables[0].transitions == Pairs{{2, 0}, {0, 1}});
  CHECK(tree.variables[1].transitions.empty());
  CHECK(tree.variables[1].moves == Moves::Sampled);
}

TEST_CASE("a transition may say how long its state lasts") {
  const BehaviorTree tree = tree_of(
      "(defsv a :states (X Y Z) :transitions ((X Y [3,5]) (Y X [2,inf]) "
      "(X Z) (X Y [3,5]))) (defsv b :states (X Y) :transitions ((X Y))) "
      "(defsv c :states (X Y) :transitions ((X Y 150ms))) "
      "(BehaviorTree (Action))");
  CHECK(tree.variables[0].transitions.size() == 3);
  CHECK(tree.variables[0].lasting ==
        std::vector<Duration>{{3, 5}, {2, kEndless}, kAnyDuration});
  CHECK(tree.variables[1].lasting.empty());
  CHECK(tree.variables[2].lasting == std::vector<Duration>{{2, 2}});
}

TEST_CASE("every node type is read by its name") {
  const BehaviorTree tree = clean_tree_of(R"(
(defsv v :states (A B))
(BehaviorTree :name t (Sequence (Fallback (SequenceWithMemory
 (ReactiveSequence (ReactiveFallback (Parallel :success 1 (ParallelAll
 (Inverter (ForceSuccess (ForceFailure (KeepRunningUntilFailure
 (Repeat :repeat 2 (RetryUntilSuccessful :num_attempts 3 (RateController :hz 2
 (Recovery :num_retries 4 (RoundRobin (PipelineSequence (SubTree :ID s)))
  (Sequence (Timeout :duration 2 (Action)) (Condition) (SetSV :sv v)
   (Eval (= v A)) (Wait :duration 1))))))))))))))))))
(BehaviorTree :name s (Action)))");
  std::set<NodeType> seen;
  for (const Node& node : tree.nodes) seen.insert(node.type);
  for (const NodeTypeInfo& info : btf_node_types()) {
    CAPTURE(info.name);
    CHECK(seen.contains(info.type));
  }
}

TEST_CASE("the options of control nodes") {
  const Node reactive = node_of("(ReactiveSequence :halt 1 (Action) (Action))");
  CHECK(reactive.halt);
  CHECK(!reactive.wait);
  const Node fallback = node_of("(ReactiveFallback (Action) :WAIT 1 :Halt 0)");
  CHECK(!fallback.halt);
  CHECK(fallback.wait);
  const Node parallel =
      node_of("(Parallel :success 2 :wait 0 :halt 1 (Action)(Action)(Action))");
  CHECK(parallel.threshold == 2);
  CHECK(parallel.halt);
  CHECK(node_of("(ParallelAll (Action) (Action))").threshold == 2);
  CHECK(node_of("(Repeat :repeat 3 (Action))").repetitions == 3);
  CHECK(
      node_of("(RetryUntilSuccessful (Action) :num_attempts 2)").repetitions ==
      2);
  CHECK(node_of("(Recovery :retry 0 (Action) (Action))").repetitions == 0);
  CHECK(node_of("(Recovery :num_retries 6 (Action) (Action))").repetitions ==
        6);
  CHECK(node_of("(RateController :hz 0.5 (Action))").rate_hz == 0.5);
  CHECK(node_of("(RateController :args (hz 10) (Action))").rate_hz == 10);
}

TEST_CASE("a root may start over when it is done") {
  CHECK(!clean_tree_of("(BehaviorTree (Action))").nodes[0].loop);
  CHECK(!clean_tree_of("(BehaviorTree :loop 0 (Action))").nodes[0].loop);
  CHECK(clean_tree_of("(BehaviorTree :loop 1 (Action))").nodes[0].loop);
}

TEST_CASE("a leaf may run, unless it is a condition or has :SF") {
  CHECK(node_of("(Action)").contract.may_run);
  CHECK(!node_of("(Condition)").contract.may_run);
  CHECK(!node_of("(Action :SF)").contract.may_run);
  CHECK(!node_of("(Action :SF :ID a)").contract.may_run);
  CHECK(!node_of("(Action :sf 1)").contract.may_run);
  CHECK(node_of("(Action :SF 0)").contract.may_run);
}

TEST_CASE("durations are one number or an interval, in ticks") {
  CHECK(node_of("(Wait :duration 5)").duration->min == 5);
  CHECK(node_of("(Wait :duration 5)").duration->max == 5);
  for (const char* text :
       {"(Action :duration [2,5])", "(Action :duration [ 2, 5 ])",
        "(Action :duration (2 5))", "(Wait :duration [2 5])"}) {
    CAPTURE(text);
    const Node node = node_of(text);
    CHECK(node.duration->min == 2);
    CHECK(node.duration->max == 5);
  }
  CHECK(!node_of("(Action)").duration);
  CHECK(node_of("(Wait :duration (0))").duration->max == 0);
}

TEST_CASE("durations with a unit are as many ticks as they take") {
  const auto ticks = [](const std::string& duration, int tick_ms) {
    const auto tree = read_btf(
        "t.btf", "(BehaviorTree (Action :ID a :duration " + duration + "))",
        tick_ms);
    REQUIRE(tree.value);
    CHECK(tree.diagnostics.size() <= 1);
    return duration_text(*tree.value->nodes[1].duration) +
           (tree.diagnostics.empty() ? "" : " " + tree.diagnostics[0].code);
  };
  CHECK(ticks("500ms", 100) == "[5,5]");
  CHECK(ticks("0.5s", 100) == "[5,5]");
  CHECK(ticks("0.5S", 50) == "[10,10]");
  CHECK(ticks("[0.5s,2.5s]", 100) == "[5,25]");
  CHECK(ticks("(100ms inf)", 100) == "[1,inf]");
  CHECK(ticks("250ms", 100) == "[3,3] BT1025");
  CHECK(ticks("[0.301s,0.9999s]", 100) == "[4,10] BT1025");
  CHECK(ticks("0.5ms", 100) == "[1,1] BT1025");
  CHECK(ticks("0ms", 100) == "[0,0]");
}

TEST_CASE("arguments are kept as they are written") {
  const Node node = node_of(
      "(Action :ID go :args (x -1.5 goal $goal service a/b/c_d\n z ( * 2 ; "
      "twice\n  3 ) text \"a b;(\" n () i [1,2]))");
  REQUIRE(node.arguments.size() == 7);
  CHECK(node.arguments[0].key == "x");
  CHECK(node.arguments[0].value == "-1.5");
  CHECK(node.arguments[1].value == "$goal");
  CHECK(node.arguments[2].value == "a/b/c_d");
  CHECK(node.arguments[3].value == "(* 2 3)");
  CHECK(node.arguments[4].value == "\"a b;(\"");
  CHECK(node.arguments[5].value == "()");
  CHECK(node.arguments[6].value == "[1,2]");
}

TEST_CASE("SetSV names its variable") {
  CHECK(node_of("(SetSV :sv battery)").variable == StateVariableId{0});
  CHECK(node_of("(SetSV :ID look :SV $battery)").name == "look");
}

TEST_CASE("operators, in prefix order, with and without a dollar sign") {
  const struct {
    std::string_view written;
    std::string_view read;
  } kCases[] = {
      {"(= fls 2)", "fls = 2"},
      {"(~= $fls 2)", "fls ~= 2"},
      {"(/= fls 2)", "fls ~= 2"},
      {"(!= fls 2)", "fls ~= 2"},
      {"(< fls k)", "fls < k"},
      {"(<= fls 2)", "fls <= 2"},
      {"(> fls 2)", "fls > 2"},
      {"(>= fls 2)", "fls >= 2"},
      {"(~ (= fls 2))", "not (fls = 2)"},
      {"(not (= fls 2))", "not (fls = 2)"},
      {"(and (= k 1) (= k 2) (= k 3))", "k = 1 and k = 2 and k = 3"},
      {"(OR (= k 1) (and (= k 2)))", "k = 1 or k = 2"},
      {"(= fls (+ k 1 fls))", "fls = k + 1 + fls"},
      {"(= fls (* k (- fls 1)))", "fls = k * (fls - 1)"},
      {"(= fls (- k))", "fls = -k"},
      {"(= fls (/ k 2))", "fls = k / 2"},
      {"(= fls (mod k +2))", "fls = k mod 2"},
      {"(= fls (+ 1 (* 2 (- 1))))", "fls = -1"},
  };
  for (const auto& each : kCases) {
    CAPTURE(each.written);
    CHECK(eval(each.written) == each.read);
  }
}

TEST_CASE("a word beside an enumeration is a state, else a variable") {
  CHECK(eval("(= battery Low)") == "battery = Low");
  CHECK(eval("(~= Critical battery)") == "Critical ~= battery");
  CHECK(eval("(= battery spare)") == "battery = spare");
  CHECK(eval("(= $battery $spare)") == "battery = spare");
  const BehaviorTree tree = clean_tree_of(
      "(defsv Low :states (On Off)) (defsv battery :states (Good Low))"
      "(BehaviorTree (Sequence (Eval (= battery Low)) (Eval (= Low battery))"
      "(Eval (= Low On)) (Eval (= On Low))))");
  CHECK(text_of(tree, tree.nodes[2].expression) == "battery = Low");
  CHECK(tree.nodes[2].expression.terms()[0].operand == 1);
  CHECK(tree.nodes[2].expression.terms()[1].operation == Operation::Constant);
  CHECK(tree.nodes[3].expression.terms()[0].operation == Operation::Constant);
  CHECK(tree.nodes[4].expression.terms()[0].operand == 0);
  CHECK(tree.nodes[5].expression.terms()[1].operand == 0);
}

TEST_CASE("assignments") {
  CHECK(eval("(:= fls (+ 1 fls))") == "fls := 1 + fls");
  CHECK(eval("(:= $k 9)") == "k := 9");
  CHECK(eval("(:= battery Critical)") == "battery := 2");
  CHECK(eval("(:= battery spare)") == "battery := spare");
}

TEST_CASE("the status of a node can be asked for, also ahead of it") {
  CHECK(eval("(= land.rstatus success)") == "land_btn3.rstatus = success");
  CHECK(eval("(~= running $see.rstatus)") == "running ~= see_btn4.rstatus");
  CHECK(eval("(= land_btn3.RSTATUS Failure)") == "land_btn3.rstatus = failure");
  CHECK(eval("(= land.rstatus see.rstatus)") ==
        "land_btn3.rstatus = see_btn4.rstatus");
}

TEST_CASE("a name means the nearest node in the copies of a subtree") {
  const BehaviorTree tree = clean_tree_of(R"(
(BehaviorTree :name main (Sequence (SubTree :ID s) (SubTree :ID s)
  (Action :ID top)))
(BehaviorTree :name s (Sequence (Action :ID go)
  (Eval (= go.rstatus success)) (Eval (= top.rstatus success)))))");
  REQUIRE(tree.nodes.size() == 13);
  const auto target = [&](std::size_t node) {
    return tree.nodes[node].expression.terms()[0].operand;
  };
  CHECK(target(5) == 4);
  CHECK(target(6) == 12);
  CHECK(target(10) == 9);
  CHECK(target(11) == 12);
}

TEST_CASE("the exact spelling of a node's name is preferred") {
  const BehaviorTree tree = clean_tree_of(
      "(BehaviorTree :name t (Sequence (Action :ID Go) (Action :ID go)"
      "(Eval (= go.rstatus success))))");
  CHECK(tree.nodes[4].expression.terms()[0].operand == 3);
}

TEST_CASE("subtrees are expanded in place, as nodes of their own") {
  const BehaviorTree tree = clean_tree_of(R"(
(BehaviorTree :name safe (Fallback :name f (Action :ID land)))
(BehaviorTree :name main (Sequence
  (SubTree :ID safe :name first)
  (SubTree :name safe))))");
  REQUIRE(tree.nodes.size() == 8);
  CHECK(tree.nodes[2].type == NodeType::SubTree);
  CHECK(tree.nodes[2].name == "first");
  CHECK(tree.nodes[2].children == std::vector<NodeId>{NodeId{3}});
  CHECK(tree.nodes[3].parent == NodeId{2});
  CHECK(tree.nodes[3].span.line == 2);
  CHECK(tree.nodes[5].name == "safe");
  CHECK(tree.nodes[7].parent == NodeId{6});
  CHECK(tree.roots.size() == 1);
}

TEST_CASE("a tree can be referred to by :name or :ID") {
  const BehaviorTree tree = clean_tree_of(
      "(BehaviorTree :name main (Sequence (SubTree :ID b) (SubTree :ID c)))"
      "(BehaviorTree :name b :ID c (Action))");
  CHECK(tree.nodes.size() == 6);
}

TEST_CASE("several trees run in the order of (Trees ...)") {
  const BehaviorTree tree = clean_tree_of(
      "((Trees two one) (BehaviorTree :name one (Action))"
      "(BehaviorTree :name two (Action)))");
  CHECK(tree.roots == std::vector<NodeId>{NodeId{0}, NodeId{2}});
  CHECK(tree.nodes[0].name == "two");
  CHECK(tree.nodes[2].parent == NodeId{2});
}

TEST_CASE("a contract applies to every leaf of its ID") {
  const BehaviorTree tree = clean_tree_of(R"(
(defsv altitude :max 9) (defsv door :states (Open Closed))
(defaction land :returns (success running) :duration [2,5]
  :requires (> altitude 0)
  :on-success ((:= altitude 0) (:= door Open)))
(defcondition ok :returns (failure) :on-failure (:= altitude 1))
(BehaviorTree :name main (Sequence
  (Action :ID land) (Action :ID land :name again :duration 1)
  (Action :name land) (Condition :ID ok) (Action :ID ok))))");
  for (const std::size_t node : {2u, 3u, 4u}) {
    const LeafContract& contract = tree.nodes[node].contract;
    CHECK(contract.may_succeed);
    CHECK(!contract.may_fail);
    CHECK(contract.may_run);
    CHECK(text_of(tree, contract.requirement) == "altitude > 0");
    REQUIRE(contract.on_success.size() == 2);
    CHECK(contract.on_success[1].variable == StateVariableId{1});
    CHECK(contract.on_failure.empty());
  }
  CHECK(tree.nodes[2].duration->max == 5);
  CHECK(tree.nodes[3].duration->max == 1);
  CHECK(!tree.nodes[5].contract.may_succeed);
  CHECK(!tree.nodes[5].contract.may_run);
  CHECK(tree.nodes[5].contract.on_failure.size() == 1);
  CHECK(tree.nodes[6].contract.may_succeed);
}

TEST_CASE("a contract and :SF narrow a leaf together") {
  const BehaviorTree tree = clean_tree_of(
      "(defaction a :returns (success running))"
      "(BehaviorTree :name t (Action :ID a :SF))");
  CHECK(first_node(tree).contract.may_succeed);
  CHECK(!first_node(tree).contract.may_fail);
  CHECK(!first_node(tree).contract.may_run);
}

TEST_CASE("a name in a contract is looked up from each leaf that has it") {
  const BehaviorTree tree = clean_tree_of(R"(
(defaction go :requires (= see.rstatus success))
(BehaviorTree :name main (Sequence (SubTree :ID s) (SubTree :ID s)))
(BehaviorTree :name s (Sequence (Condition :ID see) (Action :ID go))))");
  CHECK(tree.nodes[5].contract.requirement.terms()[0].operand == 4);
  CHECK(tree.nodes[9].contract.requirement.terms()[0].operand == 8);
}

TEST_CASE("every example is read") {
  for (const std::string_view name : kExamples) {
    CAPTURE(name);
    const std::string text = example(name);
    const auto result = read_btf(name, text);
    REQUIRE(result.value);
    CHECK(text.find("SPDX-License-Identifier: ") != std::string::npos);
    for (const Diagnostic& found : result.diagnostics) {
      CHECK(found.code == "BT1007");
    }
  }
}

TEST_CASE("every tree in docs/btf.md is read without a warning") {
  const std::string page = example("../docs/btf.md");
  constexpr std::string_view kFence = "```lisp\n";
  int count = 0;
  for (std::size_t at = page.find(kFence); at != std::string::npos;
       at = page.find(kFence, at)) {
    at += kFence.size();
    const std::string text = page.substr(at, page.find("```", at) - at);
    CAPTURE(text);
    CHECK(findings_of(text) == "");
    ++count;
  }
  CHECK(count == 6);
}

// The type, name and line of a node, in pre-order, as in the paper's listing.
void check_line(const BehaviorTree& tree, std::size_t node,
                std::string_view name, int line) {
  CAPTURE(name);
  CHECK(tree.nodes.at(node).name == name);
  CHECK(tree.nodes.at(node).span.line == line);
}

TEST_CASE("drone3 has the nodes and the lines of the paper's listing") {
  const BehaviorTree tree = tree_of(example("drone3.btf"));
  REQUIRE(tree.nodes.size() == 38);
  check_line(tree, 0, "drone", 11);
  check_line(tree, 5, "ReactiveSequence16", 16);
  check_line(tree, 6, "Sequence17", 17);
  check_line(tree, 9, "measure_battery", 20);
  check_line(tree, 12, "land", 23);
  check_line(tree, 16, "goto_waypoint", 27);
  check_line(tree, 20, "land", 31);
  check_line(tree, 24, "camera_track", 35);
  check_line(tree, 25, "Repeat36", 36);
  check_line(tree, 34, "goto_waypoint", 45);
  check_line(tree, 35, "land", 46);
  check_line(tree, 37, "Eval48", 48);
  CHECK(text_of(tree, tree.nodes[37].expression) ==
        "camera_track_btn24.rstatus = success");
  CHECK(text_of(tree, tree.nodes[13].expression) == "not (battery = Critical)");
}

TEST_CASE("drone3-fixed is drone3 with a reactive battery check") {
  const BehaviorTree drone = tree_of(example("drone3.btf"));
  const BehaviorTree fixed = tree_of(example("drone3-fixed.btf"));
  REQUIRE(fixed.nodes.size() == drone.nodes.size());
  for (std::size_t i = 0; i < drone.nodes.size(); ++i) {
    CHECK(fixed.nodes[i].span.line == drone.nodes[i].span.line);
    CHECK((fixed.nodes[i].type == drone.nodes[i].type) == (i != 6));
  }
  CHECK(fixed.nodes[6].type == NodeType::ReactiveSequence);
}

TEST_CASE("the other examples stand on the lines of their listings") {
  const BehaviorTree drone1 = tree_of(example("drone1.btf"));
  check_line(drone1, 9, "land", 10);
  check_line(drone1, 27, "shutdown_drone", 28);
  const BehaviorTree rover = tree_of(example("mars_rover.btf"));
  check_line(rover, 0, "mars_rover", 22);
  check_line(rover, 12, "send", 34);
  CHECK(moves_freely(rover, StateVariableId{0}));
  CHECK(!moves_freely(rover, StateVariableId{2}));
  const BehaviorTree nav2 = tree_of(example("nav2.btf"));
  check_line(nav2, 22, "BackUp", 27);
  check_line(tree_of(example("roundrobin.btf")), 6, "A4", 7);
  check_line(tree_of(example("recovery.btf")), 3, "recov", 4);
}

}  // namespace
}  // namespace btcheck::btf_reader_test
