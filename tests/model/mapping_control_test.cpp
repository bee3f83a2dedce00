// SPDX-License-Identifier: MIT
//
// Control nodes against their tables in docs/semantics.md: the sequences and
// fallbacks, with memory, reactive, and the parallels.
#include <doctest/doctest.h>

#include <string>

#include "model/lowering.hpp"
#include "model/network_text.hpp"

namespace btcheck::mapping_control_test {
namespace {

TEST_CASE("a Sequence resumes its running child") {
  const std::string table = R"(
    tick_node -> a [next_seq = 1]
    tick_node -> b [next_seq = 2]
    a -> a_done a.caller := n
    b -> b_done b.caller := n
    a_done -> b [a says success]
    a_done -> failure [a says failure] next_seq := 1
    a_done -> running [a says running] next_seq := 1
    b_done -> success [b says success] next_seq := 1
    b_done -> failure [b says failure] next_seq := 1
    b_done -> running [b says running] next_seq := 2
    halt -> halt_wait [a.rstatus = running] a.rstatus := halt_me, a.caller := n
    halt -> halt_wait [b.rstatus = running] b.rstatus := halt_me, b.caller := n
    halt_wait -> halt [a.caller = None and b.caller = None]
    halt -> halted [a.rstatus ~= running and b.rstatus ~= running] next_seq := 1
  )";
  CHECK(table_of(over("Sequence", 2), "n") == framed(table));
  CHECK(table_of(over("Sequence", 2), "n", TickSemantics::Leaves) ==
        framed(table));
}

TEST_CASE("a timed Sequence takes a unit and then looks whose turn it is") {
  CHECK(table_of(over("Sequence", 1), "n", TickSemantics::Nodes) == framed(R"(
    tick_node -> evaluate @[1,1]
    evaluate -> a [next_seq = 1]
    a_done -> success [a says success] next_seq := 1
    a_done -> failure [a says failure] next_seq := 1
    a_done -> running [a says running] next_seq := 1
  )" + calls({"a"}) + halts({"a"}, "halt", "halted", "next_seq := 1")));
}

TEST_CASE("a Fallback is a Sequence with the answers exchanged") {
  CHECK(
      table_of(over("Fallback", 3), "n") ==
      framed(R"(
    tick_node -> a [next_fb = 1]
    tick_node -> b [next_fb = 2]
    tick_node -> c [next_fb = 3]
    a_done -> b [a says failure]
    a_done -> success [a says success] next_fb := 1
    a_done -> running [a says running] next_fb := 1
    b_done -> c [b says failure]
    b_done -> success [b says success] next_fb := 1
    b_done -> running [b says running] next_fb := 2
    c_done -> failure [c says failure] next_fb := 1
    c_done -> success [c says success] next_fb := 1
    c_done -> running [c says running] next_fb := 3
  )" + calls({"a", "b", "c"}) +
             halts({"a", "b", "c"}, "halt", "halted", "next_fb := 1", false)));
}

TEST_CASE("a SequenceWithMemory begins again with the child that failed") {
  CHECK(table_of(over("SequenceWithMemory", 2), "n") == framed(R"(
    tick_node -> a [next_seq = 1]
    tick_node -> b [next_seq = 2]
    a_done -> b [a says success]
    a_done -> failure [a says failure] next_seq := 1
    a_done -> running [a says running] next_seq := 1
    b_done -> success [b says success] next_seq := 1
    b_done -> failure [b says failure] next_seq := 2
    b_done -> running [b says running] next_seq := 2
  )" + calls({"a", "b"}) + halts({"a", "b"}, "halt", "halted", "", false)));
}

TEST_CASE("the locals of a Sequence have their range and begin at child one") {
  const BehaviorTree tree = tree_of(over("Sequence", 3));
  const Network network = lower(tree, TickSemantics::Root);
  const Automaton& node = automaton_called(network, "n");
  REQUIRE(node.locals.size() == 1);
  const Variable& next = network.variable(node.locals[0]);
  CHECK(next.role == VariableRole::Local);
  CHECK(next.min == 1);
  CHECK(next.max == 3);
  CHECK(next.initial == 1);
  CHECK(qualified_name(network, node.locals[0]) == "n_btn1.next_seq");
}

TEST_CASE("a ReactiveSequence begins every tick at its first child") {
  CHECK(table_of(over("ReactiveSequence", 2), "n") == framed(R"(
    tick_node -> a
    a_done -> b [a says success]
    a_done -> failure [a says failure]
    a_done -> running [a says running]
    b_done -> success [b says success]
    b_done -> failure [b says failure]
    b_done -> running [b says running]
  )" + calls({"a", "b"}) + halts({"a", "b"}, "halt", "halted")));
}

TEST_CASE("a ReactiveSequence with :halt halts all that runs on a failure") {
  const std::string table = framed(R"(
    tick_node -> a
    a_done -> b [a says success]
    a_done -> halt_rest [a says failure]
    a_done -> running [a says running]
    b_done -> success [b says success]
    b_done -> halt_rest [b says failure]
    b_done -> running [b says running]
  )" + calls({"a", "b"}) + halts({"a", "b"}, "halt_rest", "failure") +
                                   halts({"a", "b"}, "halt", "halted"));
  CHECK(table_of(over("ReactiveSequence :halt 1", 2), "n") == table);
  CHECK(table_of(over("ReactiveSequence :halt 1 :wait 1", 2), "n") == table);
}

TEST_CASE("a ReactiveSequence with :wait remembers its decision") {
  const std::string runs = "[a.rstatus = running or b.rstatus = running]";
  const std::string rests =
      "[not (a.rstatus = running or b.rstatus = running)]";
  CHECK(table_of(over("ReactiveSequence :wait 1", 2), "n") ==
        framed(R"(
    tick_node -> a [deciding = 0]
    tick_node -> wait_1 [deciding = 1]
    a_done -> b [a says success]
    a_done -> decision [a says failure]
    a_done -> running [a says running]
    b_done -> success [b says success]
    b_done -> decision [b says failure]
    b_done -> running [b says running]
    wait_1 -> wait_2 [a.rstatus ~= running]
    wait_1 -> wait_1_done [a.rstatus = running] a.caller := n
    wait_1_done -> wait_2 [a.caller = None]
    wait_2 -> wait_3 [b.rstatus ~= running]
    wait_2 -> wait_2_done [b.rstatus = running] b.caller := n
    wait_2_done -> wait_3 [b.caller = None]
  )" + ("decision -> running " + runs + " deciding := 1\n") +
               "decision -> failure " + rests + "\nwait_3 -> running " + runs +
               "\nwait_3 -> failure " + rests + " deciding := 0\n" +
               calls({"a", "b"}) +
               halts({"a", "b"}, "halt", "halted", "deciding := 0")));
}

TEST_CASE("a ReactiveFallback decides on a success") {
  CHECK(table_of(over("ReactiveFallback :halt 1", 2),
                 "n") == framed(R"(
    tick_node -> a
    a_done -> b [a says failure]
    a_done -> halt_rest [a says success]
    a_done -> running [a says running]
    b_done -> failure [b says failure]
    b_done -> halt_rest [b says success]
    b_done -> running [b says running]
  )" + calls({"a", "b"}) + halts({"a", "b"}, "halt_rest", "success") +
                                halts({"a", "b"}, "halt", "halted")));
  const std::string waiting =
      table_of(over("ReactiveFallback :wait 1", 1), "n");
  CHECK(waiting == framed(R"(
    tick_node -> a [deciding = 0]
    tick_node -> wait_1 [deciding = 1]
    a_done -> failure [a says failure]
    a_done -> decision [a says success]
    a_done -> running [a says running]
    wait_1 -> wait_2 [a.rstatus ~= running]
    wait_1 -> wait_1_done [a.rstatus = running] a.caller := n
    wait_1_done -> wait_2 [a.caller = None]
    decision -> running [a.rstatus = running] deciding := 1
    decision -> success [not (a.rstatus = running)]
    wait_2 -> running [a.rstatus = running]
    wait_2 -> success [not (a.rstatus = running)] deciding := 0
  )" + calls({"a"}) + halts({"a"}, "halt", "halted", "deciding := 0")));
}

constexpr std::string_view kCalls = R"(
    tick_node -> children_done [active = 0]
      + a.caller := n, b.caller := n, active := 1
    tick_node -> children_done [active = 1]
      + a.caller := a.rstatus = running, b.caller := b.rstatus = running
    children_done -> counting [a.caller = None and b.caller = None]
)";

// "(a.rstatus = success) + (b.rstatus = success) >= m".
std::string at_least(const std::string& status, int number) {
  return "(a.rstatus = " + status + ") + (b.rstatus = " + status +
         ") >= " + std::to_string(number);
}

// The rows of a Parallel over a and b that decides at once.
std::string parallel(int needed, const std::string& on_success,
                     const std::string& on_failure) {
  const std::string passes = at_least("success", needed);
  const std::string fails = at_least("failure", 2 - needed + 1);
  return std::string(kCalls) + "counting -> " + on_success + " [" + passes +
         "] active := 0\ncounting -> " + on_failure + " [" + fails +
         "] active := 0\ncounting -> running [not (" + passes + ") and not (" +
         fails + ")]\n" + halts({"a", "b"}, "halt", "halted", "active := 0");
}

TEST_CASE("a Parallel calls all children in one step and counts answers") {
  CHECK(table_of(over("Parallel :success 1", 2), "n") ==
        framed(parallel(1, "success", "failure")));
  CHECK(table_of(over("Parallel :success 2", 2), "n") ==
        framed(parallel(2, "success", "failure")));
}

TEST_CASE("a ParallelAll needs the success of every child") {
  CHECK(table_of(over("ParallelAll", 2), "n") ==
        framed(parallel(2, "success", "failure")));
}

TEST_CASE("a Parallel with :halt halts what runs before it answers") {
  const std::string table =
      framed(parallel(1, "halt_then_success", "halt_then_failure") +
             halts({"a", "b"}, "halt_then_success", "success") +
             halts({"a", "b"}, "halt_then_failure", "failure"));
  CHECK(table_of(over("Parallel :success 1 :halt 1", 2), "n") == table);
  CHECK(table_of(over("Parallel :success 1 :halt 1 :wait 1", 2), "n") == table);
}

TEST_CASE("a Parallel with :wait stays active until no child runs") {
  const std::string runs = "(a.rstatus = running or b.rstatus = running)";
  const std::string passes = at_least("success", 2);
  const std::string fails = at_least("failure", 1);
  std::string table(kCalls);
  // Once all have succeeded none runs.
  table += "counting -> success [" + passes + "] active := 0\n";
  table += "counting -> running [" + fails + " and " + runs + "]\n";
  table +=
      "counting -> failure [" + fails + " and not " + runs + "] active := 0\n";
  table += "counting -> running [not (" + passes + ") and not (" + fails +
           ")]\n" + halts({"a", "b"}, "halt", "halted", "active := 0");
  CHECK(table_of(over("ParallelAll :wait 1", 2), "n") == framed(table));
}

}  // namespace
}  // namespace btcheck::mapping_control_test
