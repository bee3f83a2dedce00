// SPDX-License-Identifier: MIT
//
// What people take for laws when they tidy a tree: those that hold, and those
// that do not, each with the reason.
#include <doctest/doctest.h>

#include <string>
#include <string_view>
#include <vector>

#include "compared.hpp"

namespace btcheck::diff_laws_test {
namespace {

struct Law {
  std::string_view name;
  std::string_view one;
  std::string_view other;
  bool holds = true;
  std::string_view why = "";
  std::string_view observe = "leaves";
  Caller caller = Caller::Any;
};

// src/controls and src/decorators of BehaviorTree.CPP 4.10.
constexpr Law kLaws[] = {
    {"Sequence is associative",
     "<Sequence><a/><Sequence><b/><c/></Sequence></Sequence>",
     "<Sequence><a/><b/><c/></Sequence>", true,
     "both resume the child that runs, and a halt resets both"},
    {"and so it is on the other side",
     "<Sequence><Sequence><a/><b/></Sequence><c/></Sequence>",
     "<Sequence><a/><b/><c/></Sequence>", true, "likewise"},
    {"Fallback is associative",
     "<Fallback><a/><Fallback><b/><c/></Fallback></Fallback>",
     "<Fallback><a/><b/><c/></Fallback>", true, "likewise"},
    {"ReactiveSequence is associative",
     "<ReactiveSequence><p/><ReactiveSequence><q/><a/></ReactiveSequence>"
     "</ReactiveSequence>",
     "<ReactiveSequence><p/><q/><a/></ReactiveSequence>", true,
     "both ask all guards in each tick, and halt what runs behind one"},
    {"ReactiveFallback is associative",
     "<ReactiveFallback><p/><ReactiveFallback><q/><a/></ReactiveFallback>"
     "</ReactiveFallback>",
     "<ReactiveFallback><p/><q/><a/></ReactiveFallback>", true, "likewise"},
    {"a Sequence of one is its child", "<Sequence><a/></Sequence>", "<a/>",
     true, "it adds nothing"},
    {"a ReactiveFallback of one is its child",
     "<ReactiveFallback><a/></ReactiveFallback>", "<a/>", true, "likewise"},
    {"two Inverters are none", "<Inverter><Inverter><a/></Inverter></Inverter>",
     "<a/>", true, "running passes through, the rest is turned twice"},
    {"De Morgan, for Sequence",
     "<Inverter><Sequence><a/><b/></Sequence></Inverter>",
     "<Fallback><Inverter><a/></Inverter><Inverter><b/></Inverter></Fallback>",
     true, "a Fallback is a Sequence with the two answers exchanged"},
    {"De Morgan, for reactive nodes",
     "<Inverter><ReactiveSequence><p/><a/></ReactiveSequence></Inverter>",
     "<ReactiveFallback><Inverter><p/></Inverter><Inverter><a/></Inverter>"
     "</ReactiveFallback>",
     true, "likewise"},
    {"ForceSuccess swallows an Inverter below it",
     "<ForceSuccess><Inverter><a/></Inverter></ForceSuccess>",
     "<ForceSuccess><a/></ForceSuccess>", true, "either answer is a success"},
    {"an Inverter turns ForceSuccess into ForceFailure",
     "<Inverter><ForceSuccess><a/></ForceSuccess></Inverter>",
     "<ForceFailure><a/></ForceFailure>", true, "running is not forced"},
    {"ForceSuccess is a Fallback to AlwaysSuccess",
     "<ForceSuccess><a/></ForceSuccess>",
     "<Fallback><a/><AlwaysSuccess/></Fallback>", true,
     "AlwaysSuccess asks nobody: it is not seen"},
    {"RetryUntilSuccessful 1 is its child",
     "<RetryUntilSuccessful num_attempts=\"1\"><a/></RetryUntilSuccessful>",
     "<a/>", true, "there is no second attempt"},
    {"Repeat 1 is its child", "<Repeat num_cycles=\"1\"><a/></Repeat>", "<a/>",
     true, "there is no second round"},
    {"what stands behind AlwaysFailure can go",
     "<Sequence><AlwaysFailure/><a/></Sequence>", "<AlwaysFailure/>", true,
     "it is never ticked"},
    {"AlwaysSuccess adds nothing to a Sequence",
     "<Sequence><AlwaysSuccess/><a/></Sequence>", "<a/>", true,
     "it succeeds at once"},
    {"a reactive node over instant leaves is a plain one",
     "<ReactiveSequence><p/><q/></ReactiveSequence>",
     "<Sequence><p/><q/></Sequence>", true,
     "no tick ends between them, so none is asked again"},
    {"a guard that is asked once is no guard that is asked always",
     "<Sequence><p/><a/></Sequence>",
     "<ReactiveSequence><p/><a/></ReactiveSequence>", false,
     "the reactive one asks p again while a runs"},
    {"IfThenElse without an else is a Sequence",
     "<IfThenElse><p/><a/></IfThenElse>", "<Sequence><p/><a/></Sequence>", true,
     "without a third child a failure of the first is its failure"},
    {"IfThenElse is no Fallback of a Sequence",
     "<IfThenElse><p/><a/><b/></IfThenElse>",
     "<Fallback><Sequence><p/><a/></Sequence><b/></Fallback>", false,
     "the Fallback tries b also where p holds and a fails"},
    {"ForceSuccess is not moved out of a Sequence",
     "<Sequence><ForceSuccess><a/></ForceSuccess><b/></Sequence>",
     "<ForceSuccess><Sequence><a/><b/></Sequence></ForceSuccess>", false,
     "outside, a failure of a leaves b out"},
    {"nor from the last child to the whole",
     "<Sequence><a/><ForceSuccess><b/></ForceSuccess></Sequence>",
     "<ForceSuccess><Sequence><a/><b/></Sequence></ForceSuccess>", false,
     "outside, a failure of a becomes a success"},
    {"but over a single child it is the same",
     "<ForceSuccess><Sequence><a/></Sequence></ForceSuccess>",
     "<Sequence><ForceSuccess><a/></ForceSuccess></Sequence>", true,
     "there is nothing else to be left out"},
    {"a Sequence is not commutative", "<Sequence><p/><q/></Sequence>",
     "<Sequence><q/><p/></Sequence>", false, "another leaf is asked first"},
    {"but nobody hears that who hears the root alone",
     "<Sequence><p/><q/></Sequence>", "<Sequence><q/><p/></Sequence>", true,
     "it succeeds where both hold", "root"},
    {"what is asked twice may be answered twice",
     "<Sequence><p/><p/></Sequence>", "<p/>", false,
     "a second condition is asked that the other has not"},
    {"a Fallback does not share a guard",
     "<Fallback><Sequence><p/><a/></Sequence><Sequence><p/><b/></Sequence>"
     "</Fallback>",
     "<Sequence><p/><Fallback><a/><b/></Fallback></Sequence>", false,
     "p is asked a second time before b"},
    {"a SequenceWithMemory is no Sequence",
     "<SequenceWithMemory><a/><b/></SequenceWithMemory>",
     "<Sequence><a/><b/></Sequence>", false,
     "ticked again after a failure of b it goes on with b"},
    {"not even when it is ticked until it has ended",
     "<SequenceWithMemory><a/><b/></SequenceWithMemory>",
     "<Sequence><a/><b/></Sequence>", false,
     "4.10 yields a tick between its children", "leaves", Caller::Once},
    {"KeepRunningUntilFailure is more than its child",
     "<KeepRunningUntilFailure><a/></KeepRunningUntilFailure>", "<a/>", false,
     "a success becomes running"},
    {"retries of retries are not their product",
     "<RetryUntilSuccessful num_attempts=\"2\">"
     "<RetryUntilSuccessful num_attempts=\"2\"><p/></RetryUntilSuccessful>"
     "</RetryUntilSuccessful>",
     "<RetryUntilSuccessful num_attempts=\"4\"><p/></RetryUntilSuccessful>",
     false,
     "4.10 yields after each attempt of a child that was idle: the outer one "
     "does not where the inner has yielded"},
    {"a Parallel of all is no Sequence",
     "<Parallel success_count=\"2\"><a/><b/></Parallel>",
     "<Sequence><a/><b/></Sequence>", false, "b begins before a has ended"},
    {"a Timeout is more than its child", "<Timeout msec=\"300\"><a/></Timeout>",
     "<a/>", false, "a is halted when the time is up"},
};

Diff of(const Law& law) {
  DiffOptions options;
  options.observe = {std::string(law.observe)};
  options.caller = law.caller;
  return compared(xml_of(law.one), xml_of(law.other), options);
}

}  // namespace

TEST_CASE("laws of refactoring are decided") {
  for (const Law& law : kLaws) {
    CAPTURE(law.name);
    CAPTURE(law.why);
    const Diff diff = of(law);
    CHECK(diff.stopped == StopReason::None);
    if (diff.difference) CAPTURE(told(diff, diff.difference->run));
    CHECK(diff.is_equivalent() == law.holds);
    // Nobody needs to know which is which.
    Law turned = law;
    std::swap(turned.one, turned.other);
    CHECK(of(turned).is_equivalent() == law.holds);
  }
}

TEST_CASE("who ticks a tree until it has ended does not see what it keeps") {
  const std::string leaves = "(Action :ID a) (Action :ID b)";
  const std::string plain =
      fmt::format("(BehaviorTree :name t (Sequence {}))\n", leaves);
  const std::string keeps =
      fmt::format("(BehaviorTree :name t (SequenceWithMemory {}))\n", leaves);
  DiffOptions once;
  once.caller = Caller::Once;
  CHECK(compared(plain, keeps, once).is_equivalent());
  const Diff any = compared(plain, keeps);
  REQUIRE(any.difference);
  CHECK(told(any, any.difference->run).ends_with("root asked, a asked"));
}

TEST_CASE("the run that differs is a shortest one") {
  const Diff diff =
      compared(xml_of("<Sequence><p/><a/></Sequence>"),
               xml_of("<ReactiveSequence><p/><a/></ReactiveSequence>"));
  REQUIRE(diff.difference);
  const Difference& found = *diff.difference;
  CHECK(found.kind == Difference::Kind::Runs);
  CHECK(told(diff, found.run) ==
        "root asked, p asked, p success, a asked, a running, root running, "
        "root asked, a asked");
  CHECK(found.side == 0);
  CHECK(told(diff, found.instead) == "p asked");
  CHECK(!found.other_stops);
  CHECK(!found.other_unseen);
  CHECK(!diff.sides[0].steps.empty());
  CHECK(!diff.sides[1].steps.empty());
}

TEST_CASE("a subtree put in its place is the same") {
  const Diff diff = compared(
      xml_of("<Sequence><p/><SubTree ID=\"Sub\"/></Sequence>",
             "<BehaviorTree ID=\"Sub\"><Fallback><a/><b/></Fallback>"
             "</BehaviorTree>"),
      xml_of("<Sequence><p/><Fallback><a/><b/></Fallback></Sequence>"));
  CHECK(diff.is_equivalent());
}

TEST_CASE("leaves of one name are told apart by where they stand") {
  // The second p is the same as the first of the other tree by its place.
  const std::string one = xml_of(
      "<Fallback><Sequence name=\"go\"><p/><a/></Sequence>"
      "<Sequence name=\"stay\"><p/><b/></Sequence></Fallback>");
  const std::string other = xml_of(
      "<Fallback><Sequence name=\"stay\"><p/><b/></Sequence>"
      "<Sequence name=\"go\"><p/><a/></Sequence></Fallback>");
  const Diff diff = compared(one, other);
  REQUIRE(diff.watched.size() == 5);
  CHECK(diff.watched[1].nodes.one == NodeId{3});
  CHECK(diff.watched[1].nodes.other == NodeId{6});
  REQUIRE(diff.difference);
  CHECK(told(diff, diff.difference->run) == "root asked, p asked");
  // And those that are alone in their places by their order.
  CHECK(compared(one, xml_of("<Fallback><Sequence><p/><a/></Sequence>"
                             "<Sequence><p/><b/></Sequence></Fallback>"))
            .is_equivalent());
}

TEST_CASE("what a leaf is told makes a difference where it is ticked") {
  const std::string one = xml_of("<Sequence><p/><d goal=\"1\"/></Sequence>");
  const std::string other = xml_of("<Sequence><p/><d goal=\"2\"/></Sequence>");
  const Diff diff = compared(one, other);
  REQUIRE(diff.difference);
  CHECK(diff.difference->kind == Difference::Kind::Told);
  CHECK(told(diff, diff.difference->run) ==
        "root asked, p asked, p success, d asked");
  CHECK(diff.watched.back().otherwise == "`goal` 2 instead of 1");
  DiffOptions root;
  root.observe = {"root"};
  CHECK(compared(one, other, root).is_equivalent());
  CHECK(compared(xml_of("<Sequence><AlwaysFailure/><d goal=\"1\"/></Sequence>"),
                 xml_of("<Sequence><AlwaysFailure/><d goal=\"2\"/></Sequence>"))
            .is_equivalent());
}

TEST_CASE("nodes can be observed by name") {
  const std::string one = xml_of(
      "<Sequence><Fallback name=\"x\"><p/><q/></Fallback><a/></Sequence>");
  const std::string other = xml_of(
      "<Sequence><Fallback name=\"x\"><q/><p/></Fallback><a/></Sequence>");
  CHECK(!compared(one, other).is_equivalent());
  DiffOptions options;
  options.observe = {"x", "a"};
  CHECK(compared(one, other, options).is_equivalent());
  options.observe = {"p"};
  const Diff diff = compared(one, other, options);
  REQUIRE(diff.difference);
  options.observe = {"nobody"};
  const BehaviorTree tree = tree_of("a.xml", one);
  const DiffTree side{tree, SourceText("a.xml", FileText(one))};
  const auto refused = compare_trees(side, side, options);
  CHECK(!refused.value);
  REQUIRE(refused.diagnostics.size() == 1);
  CHECK(refused.diagnostics[0].message ==
        "no node is called `nobody`, to be observed");
}

namespace {

// A door is looked at before x is done, or after it.
constexpr std::string_view kDoor =
    "(defsv door :states (Open Closed) :init Open :transitions :all "
    ":moves sampled)\n(BehaviorTree :name t\n  (Sequence\n   {}\n"
    "   (Fallback (Sequence (Eval (= door Open)) (Action :ID y :SF))\n"
    "             (Action :ID z :SF))))\n";

}  // namespace

TEST_CASE("the same runs with other choices are told by a play") {
  const std::string before =
      fmt::format(kDoor, "(SetSV :sv door) (Action :ID x :SF)");
  const std::string after =
      fmt::format(kDoor, "(Action :ID x :SF) (SetSV :sv door)");
  DiffOptions options;
  options.observe = {"x", "y", "z"};
  const Diff diff = compared(before, after, options);
  REQUIRE(diff.difference);
  CHECK(diff.difference->kind == Difference::Kind::Choices);
  REQUIRE(!diff.difference->play.empty());
  CHECK(diff.difference->play.back().kind == PlayRound::Kind::Wins);
  CHECK(compared(before, before, options).is_equivalent());
  // Who hears the measurement sees it at once.
  const Diff seen = compared(before, after);
  REQUIRE(seen.difference);
  CHECK(seen.difference->kind == Difference::Kind::Runs);
}

TEST_CASE("weather that nobody asks for is no difference") {
  const std::string plain = "(BehaviorTree :name t (Action :ID x))\n";
  const std::string weather =
      "(defsv sky :states (Sun Rain) :init Sun :transitions :all)\n"
      "(BehaviorTree :name t (Action :ID x))\n";
  for (const Caller caller : {Caller::Any, Caller::Once}) {
    DiffOptions options;
    options.caller = caller;
    CHECK(compared(plain, weather, options).is_equivalent());
  }
}

TEST_CASE("limits leave it open") {
  DiffOptions options;
  options.limits.max_states = 2;
  const std::string tree = xml_of("<Sequence><a/><b/></Sequence>");
  const Diff diff = compared(tree, tree, options);
  CHECK(diff.stopped == StopReason::MaxStates);
  CHECK(!diff.is_equivalent());
  CHECK(!diff.difference);
}

}  // namespace btcheck::diff_laws_test
