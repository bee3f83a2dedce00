// SPDX-License-Identifier: MIT
//
// What holds because nothing happens is told apart from what holds.
#include "check/search/searches.hpp"

#include <doctest/doctest.h>

#include <string>

#include "check/checked.hpp"

namespace btcheck::vacuity_test {
namespace {

// c, then a, which may run and be ticked again; nobody halts.
constexpr std::string_view kTree =
    "(BehaviorTree :name t (Sequence :name s (Condition :ID c)"
    " (Action :ID a)))";

// "holds", "never: TEXT" for a trigger that does not occur, "holds even if …".
std::string vacuity(const std::string& text) {
  const Lowered model(kTree);
  const Verified verified(model, text);
  const PropertyVerdict& verdict = verified.verdicts.back();
  if (verdict.verdict != Verdict::Holds) return "violated";
  if (verdict.no_run) return "no run";
  if (!verdict.idle.empty()) return "never: " + verdict.idle;
  std::string parts = verdict.is_vacuous() ? "vacuous" : "holds";
  for (const VacuousPart& part : verdict.vacuous) {
    parts += "; " + part.text + (part.as_if_true ? " always" : " never");
  }
  return parts;
}

TEST_CASE("a trigger that never occurs makes its rule vacuous") {
  CHECK(vacuity("prove [] (a.halted => <> root.ended)") == "never: a.halted");
  CHECK(vacuity("prove always (a.halted => c.done)") == "never: a.halted");
  CHECK(vacuity("prove a.halted leadsto c.ticked") == "never: a.halted");
  CHECK(vacuity("prove a.halted leadsto c.ticked within [0,1]") ==
        "never: a.halted");
  CHECK(vacuity("prove a.halted forbids c.ticked within [0,1]") ==
        "never: a.halted");
  CHECK(vacuity("prove present c.ticked after a.halted within [0,1]") ==
        "never: a.halted");
}

TEST_CASE("a scope that never opens or closes makes its rule vacuous") {
  CHECK(
      vacuity("prove c.ticked leadsto a.ticked within [0,9] after a.halted") ==
      "never: a.halted");
  CHECK(
      vacuity("prove a.ticked leadsto c.ticked within [0,0] before a.halted") ==
      "never: a.halted");
  CHECK(vacuity("prove absent a.success before c.ticked for 2") ==
        "never: a.success before c.ticked");
  CHECK(vacuity(
            "prove c.ticked leadsto a.success within [0,1] after a.success") ==
        "never: c.ticked after a.success");
}

TEST_CASE("a trigger that the assumptions exclude makes its rule vacuous") {
  CHECK(vacuity("assume never c.failure\n"
                "prove c.failure leadsto a.ticked within [0,0]") ==
        "never: c.failure");
}

TEST_CASE("branching time has its triggers, too") {
  CHECK(vacuity("prove AG (a.halted => AF c.ticked)") == "never: a.halted");
  CHECK(vacuity("prove AG (c.success => AF c.done)") == "holds");
}

TEST_CASE("an answer that does not matter makes its rule vacuous") {
  CHECK(vacuity("prove ltl ([] a.ticked) => (<> a.success)") ==
        "vacuous; a.success never");
  CHECK(vacuity("prove ltl (<> c.ticked) or (<> a.success)") ==
        "vacuous; a.success never");
}

TEST_CASE("more than was asked is no vacuity") {
  CHECK(vacuity("prove [] (c.success => <> c.done)") == "holds");
  CHECK(vacuity("prove ltl (<> a.ticked) => (<> c.ticked)") ==
        "holds; a.ticked always");
}

TEST_CASE("the end of a scope may go unused") {
  CHECK(vacuity("prove c.success leadsto c.done after c.ticked until a.halted")
            .substr(0, 5) == "holds");
}

TEST_CASE("a rule that needs all its parts is left alone") {
  CHECK(vacuity("prove ltl (not a.ticked) W c.success") == "holds");
  CHECK(vacuity("prove eventually c.ticked") == "holds");
}

TEST_CASE("occurrences are counted in states") {
  const Lowered model(kTree);
  const Verified verified(model,
                          "prove [] (c.success => <> c.done)\n"
                          "prove c.success leadsto c.done within [0,1]\n"
                          "prove always (c.success => not a.active)\n");
  for (const PropertyVerdict& verdict : verified.verdicts) {
    CHECK(verdict.verdict == Verdict::Holds);
    CHECK(verdict.triggers == 1u);
    CHECK(verdict.idle == "");
  }
}

TEST_CASE("assumptions that no run satisfies are told") {
  CHECK(vacuity("assume never c.ticked\nprove <> a.success") == "no run");
  CHECK(vacuity("assume <> a.ticked\nprove <> c.success") != "no run");
}

TEST_CASE("an action that has to end does") {
  CHECK(vacuity("prove <> root.ended") == "violated");
  CHECK(vacuity("assume every action eventually ends\n"
                "prove <> root.ended") == "holds");
  CHECK(vacuity("assume [] <> a.ticked => [] <> a.success\n"
                "prove <> root.ended") == "holds");
  CHECK(vacuity("assume ([] <> a.ticked) => (<> [] a.success)\n"
                "prove <> root.ended") != "violated");
}

}  // namespace
}  // namespace btcheck::vacuity_test
