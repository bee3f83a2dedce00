// SPDX-License-Identifier: MIT
//
// Decorators, SubTree and the control nodes of Nav2 against their tables in
// docs/semantics.md.
#include <doctest/doctest.h>

#include <string>

#include "model/network_text.hpp"

namespace btcheck::mapping_decorator_test {
namespace {

// A decorator over a that turns success and failure into these.
std::string decorated(const std::string& on_success,
                      const std::string& on_failure,
                      const std::string& updates = "") {
  return "tick_node -> a\na_done -> " + on_success +
         " [a says success]\na_done -> " + on_failure +
         " [a says failure]\na_done -> running [a says running]\n" +
         calls({"a"}) + halts({"a"}, "halt", "halted", updates);
}

TEST_CASE("a decorator changes what its child answers") {
  const auto table = [](const std::string& type) {
    return table_of(over(type, 1), "n");
  };
  CHECK(table("Inverter") == framed(decorated("failure", "success")));
  CHECK(table("ForceSuccess") == framed(decorated("success", "success")));
  CHECK(table("ForceFailure") == framed(decorated("failure", "failure")));
  CHECK(table("KeepRunningUntilFailure") ==
        framed(decorated("running", "failure")));
}

TEST_CASE("a timed decorator calls its child one unit later") {
  std::string table = decorated("failure", "success");
  table.replace(0, std::string("tick_node -> a\n").size(),
                "tick_node -> evaluate @[1,1]\nevaluate -> a\n");
  CHECK(table_of(over("Inverter", 1), "n", TickSemantics::Nodes) ==
        framed(table));
  CHECK(table_of(over("Inverter", 1), "n", TickSemantics::Leaves) ==
        framed(decorated("failure", "success")));
}

TEST_CASE("a SubTree is a node that passes everything on") {
  const std::string text =
      "((BehaviorTree :name t (SubTree :ID n))"
      " (BehaviorTree :name n (Action :name a)))";
  CHECK(table_of(text, "n") == framed(decorated("success", "failure")));
}

TEST_CASE("Repeat counts the successes of its child") {
  CHECK(table_of(over("Repeat :repeat 3", 1), "n") == framed(R"(
    tick_node -> a
    a_done -> a [a says success and count = 0] count := 1
    a_done -> a [a says success and count = 1] count := 2
    a_done -> success [a says success and count = 2] count := 0
    a_done -> failure [a says failure] count := 0
    a_done -> running [a says running]
  )" + calls({"a"}) + halts({"a"}, "halt", "halted", "count := 0")));
  CHECK(table_of(over("Repeat :repeat 1", 1), "n") == framed(R"(
    tick_node -> a
    a_done -> success [a says success] count := 0
    a_done -> failure [a says failure] count := 0
    a_done -> running [a says running]
  )" + calls({"a"}) + halts({"a"}, "halt", "halted", "count := 0")));
}

TEST_CASE("RetryUntilSuccessful counts the failures of its child") {
  CHECK(table_of(over("RetryUntilSuccessful :num_attempts 2", 1),
                 "n") == framed(R"(
    tick_node -> a
    a_done -> a [a says failure and count = 0] count := 1
    a_done -> failure [a says failure and count = 1] count := 0
    a_done -> success [a says success] count := 0
    a_done -> running [a says running]
  )" + calls({"a"}) + halts({"a"}, "halt", "halted", "count := 0")));
}

TEST_CASE("a RateController activates its child once a period") {
  const std::string table =
      framed(R"(
    tick_node -> a [a.rstatus = running]
    tick_node -> a [not (a.rstatus = running)
      + and n_timer.location ~= counting] n_timer.location := counting
    tick_node -> running [not (a.rstatus = running)
      + and n_timer.location = counting]
    a_done -> success [a says success]
    a_done -> failure [a says failure]
    a_done -> running [a says running]
  )" + calls({"a"}) +
             halts({"a"}, "halt", "halted", "n_timer.location := idle"));
  CHECK(table_of(over("RateController :hz 2", 1), "n") == table);
  CHECK(table_of(over("RateController :args (hz 2)", 1), "n") == table);
}

TEST_CASE("the period of a RateController is ten ticks over its rate") {
  const auto period = [](const std::string& hz) {
    return table_of(over("RateController :hz " + hz, 1), "n_timer");
  };
  CHECK(period("1") == "counting -> due @[10,10]\n");
  CHECK(period("3") == "counting -> due @[3,3]\n");
  CHECK(period("4") == "counting -> due @[3,3]\n");
  CHECK(period("0.5") == "counting -> due @[20,20]\n");
  CHECK(period("100") == "counting -> due @[1,1]\n");
}

TEST_CASE("Recovery repairs and tries again in the same tick") {
  const std::string table =
      R"(
    tick_node -> a [next = 1]
    tick_node -> b [next = 2]
    a_done -> success [a says success] retry := 0, next := 1
    a_done -> b [a says failure and retry ~= 2] next := 2
    a_done -> failure [a says failure and retry = 2] retry := 0, next := 1
    a_done -> running [a says running]
    b_done -> a [b says success and retry = 0] retry := 1, next := 1
    b_done -> a [b says success and retry = 1] retry := 2, next := 1
    b_done -> failure [b says failure] retry := 0, next := 1
    b_done -> running [b says running]
  )" + calls({"a", "b"}) +
      halts({"a", "b"}, "halt", "halted", "retry := 0, next := 1", false);
  CHECK(table_of(over("Recovery :num_retries 2", 2), "n") == framed(table));
  CHECK(table_of(over("Recovery :retry 2", 2), "n") == framed(table));
}

TEST_CASE("Recovery without retries fails at once") {
  CHECK(table_of(over("Recovery :num_retries 0", 2), "n") ==
        framed(R"(
    tick_node -> a [next = 1]
    tick_node -> b [next = 2]
    a_done -> success [a says success] retry := 0, next := 1
    a_done -> b [a says failure and retry ~= 0] next := 2
    a_done -> failure [a says failure and retry = 0] retry := 0, next := 1
    a_done -> running [a says running]
    b_done -> failure [b says failure] retry := 0, next := 1
    b_done -> running [b says running]
  )" + calls({"a", "b"}) +
               halts({"a", "b"}, "halt", "halted", "retry := 0, next := 1",
                     false)));
}

TEST_CASE("RoundRobin goes on with the following child") {
  CHECK(table_of(over("RoundRobin", 3), "n") ==
        framed(R"(
    tick_node -> a [next = 1]
    tick_node -> b [next = 2]
    tick_node -> c [next = 3]
    a_done -> success [a says success] next := 2, failed := 0
    a_done -> b [a says failure and failed = 0] next := 2, failed := 1
    a_done -> b [a says failure and failed = 1] next := 2, failed := 2
    a_done -> failure [a says failure and failed = 2] next := 2, failed := 0
    a_done -> running [a says running]
    b_done -> success [b says success] next := 3, failed := 0
    b_done -> c [b says failure and failed = 0] next := 3, failed := 1
    b_done -> c [b says failure and failed = 1] next := 3, failed := 2
    b_done -> failure [b says failure and failed = 2] next := 3, failed := 0
    b_done -> running [b says running]
    c_done -> success [c says success] next := 1, failed := 0
    c_done -> a [c says failure and failed = 0] next := 1, failed := 1
    c_done -> a [c says failure and failed = 1] next := 1, failed := 2
    c_done -> failure [c says failure and failed = 2] next := 1, failed := 0
    c_done -> running [c says running]
  )" + calls({"a", "b", "c"}) +
               halts({"a", "b", "c"}, "halt", "halted",
                     "next := 1, failed := 0", false)));
}

TEST_CASE("PipelineSequence goes on past what runs, up to the furthest") {
  CHECK(table_of(over("PipelineSequence", 3), "n") ==
        framed(R"(
    tick_node -> a
    a_done -> b [a says success]
    a_done -> halt_then_failure [a says failure]
    a_done -> running [a says running and furthest <= 1] furthest := 1
    a_done -> b [a says running and not (furthest <= 1)]
    b_done -> c [b says success]
    b_done -> halt_then_failure [b says failure]
    b_done -> running [b says running and furthest <= 2] furthest := 2
    b_done -> c [b says running and not (furthest <= 2)]
    c_done -> halt_then_success [c says success]
    c_done -> halt_then_failure [c says failure]
    c_done -> running [c says running] furthest := 3
  )" + calls({"a", "b", "c"}) +
               halts({"a", "b", "c"}, "halt_then_success", "success",
                     "furthest := 1") +
               halts({"a", "b", "c"}, "halt_then_failure", "failure",
                     "furthest := 1") +
               halts({"a", "b", "c"}, "halt", "halted", "furthest := 1")));
}

}  // namespace
}  // namespace btcheck::mapping_decorator_test
