// SPDX-License-Identifier: MIT
//
// Random trees ticked by recursion and by their networks, side by side.
#include <doctest/doctest.h>

#include <array>
#include <string>

#include "model/lowering.hpp"
#include "reference/effort.hpp"
#include "reference/random_tree.hpp"
#include "reference/tick_driver.hpp"

namespace btcheck::reference::tick_cross_check_test {
namespace {

constexpr int kTicks = 20;

// What goes differently in some of the runs of a tree, "" for nothing or when
// it cannot be read.
std::string difference_of(const std::string& text, std::uint64_t seed, int runs,
                          TickCensus& census) {
  const Result<BehaviorTree> tree = read_btf("random.btf", text);
  if (!tree.value) return {};
  const Network network = lower(*tree.value, TickSemantics::Root);
  for (int run = 0; run < runs; ++run) {
    const auto found = first_difference(*tree.value, network,
                                        seed + static_cast<std::uint64_t>(run),
                                        kTicks, census);
    if (found) return *found;
  }
  return {};
}

RandomTreeWeights deciding_trees() {
  RandomTreeWeights weights = large_trees();
  weights.decided = 30;
  return weights;
}

}  // namespace

TEST_CASE("networks tick as the trees do they were made of") {
  const std::uint64_t seed = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(500, 5000);
  TickCensus census;
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t here = seed * 1'000'000 + i;
    const std::array<RandomTreeWeights, 4> settings = {
        RandomTreeWeights{}, large_trees(), timed_weather(), deciding_trees()};
    const std::string text = random_tree(here, settings[i % settings.size()]);
    REQUIRE(read_btf("random.btf", text).value.has_value());
    if (difference_of(text, here, 2, census).empty()) continue;
    const std::string small = shrink(text, [&](const std::string& candidate) {
      return !difference_of(candidate, here, 20, census).empty();
    });
    FAIL("seed ", here, "\n", small, difference_of(small, here, 20, census));
  }
  MESSAGE(trees << " trees, " << census.ticks << " ticks, " << census.events
                << " events, " << census.halts << " halts, " << census.faults
                << " faults");
  CHECK_COVERED(census.halts > census.ticks / 50);
  CHECK_COVERED(census.faults > 10);
}

// Trees that the random ones do not contain, and the least ones on which the
// two sides once disagreed.
const char* const kDirected[] = {
    // Due, and not running any more.
    "(BehaviorTree :loop 1 (Action :ID a :duration [1,1]))",
    "(BehaviorTree :loop 1 (Action :ID a :duration [0,2]))",
    "(BehaviorTree :loop 1 (Action :ID a :duration [0,0]))",
    "(BehaviorTree :loop 1 (Wait :duration 0))",
    // Halted, a RoundRobin begins anew.
    "(BehaviorTree :loop 1 (ReactiveSequence :halt 1 (Condition :ID c)"
    " (RoundRobin (Action :ID a) (Action :ID b) (Action :ID d))))",
    // Divisors that may be zero.
    "((defsv x :init 1 :min 0 :max 2) (BehaviorTree :loop 1 (Sequence"
    " (Eval (:= x (mod (+ x 1) 3))) (Eval (= (/ 4 x) 2)))))",
    "((defsv x :init 1 :min 0 :max 2) (BehaviorTree :loop 1 (Sequence"
    " (Eval (:= x (mod (+ x 1) 3))) (Eval (:= x (mod 2 x))))))",
    "((defsv x :init 1 :min 0 :max 2)"
    " (defaction a :on-success ((:= x (- 2 x)) (:= x (/ 2 x))))"
    " (BehaviorTree :loop 1 (Sequence"
    " (Eval (:= x (mod (+ x 1) 3))) (Action :ID a))))",
    "((defsv x :init 1 :min 0 :max 2)"
    " (defaction a :requires (= (/ 2 x) 1))"
    " (BehaviorTree :loop 1 (Sequence"
    " (Eval (:= x (mod (+ x 1) 3))) (Action :ID a))))",
    "((defsv x :init 1 :min 0 :max 2)"
    " (defaction a :requires (= (/ 2 x) 1) :duration [1,2])"
    " (BehaviorTree :loop 1 (Sequence"
    " (Eval (:= x (mod (+ x 1) 3))) (Action :ID a))))",
    "((defsv x :init 1 :min 0 :max 2)"
    " (defcondition c :requires (= (/ 2 x) 1))"
    " (BehaviorTree :loop 1 (Sequence"
    " (Eval (:= x (mod (+ x 1) 3))) (Condition :ID c))))",
    // The second effect leaves the range: the first has not happened either.
    "((defsv x :init 1 :min 0 :max 2) (defsv y :init 0 :min 0 :max 1)"
    " (defaction a :on-success ((:= x 2) (:= y (+ y 1))))"
    " (BehaviorTree :loop 1 (Action :ID a)))"};

TEST_CASE("networks tick as these trees do") {
  for (const char* const tree : kDirected) {
    const std::string text = tree;
    CAPTURE(text);
    REQUIRE(read_btf("tree.btf", text).value.has_value());
    TickCensus census;
    const std::string difference = difference_of(text, 1, 50, census);
    CHECK(difference == "");
  }
}

// Something of almost every type, and most of it within reach of a few ticks.
const char* const kManyTypes =
    "((defsv x :init 0 :min 0 :max 2)"
    " (defsv w :states (w0 w1 w2) :init w0 :transitions :all :moves free)"
    " (defaction m :duration [1,3] :requires (~= w w2))"
    " (BehaviorTree :loop 1 (Sequence"
    "  (ForceSuccess (ReactiveSequence :halt 1 (Condition :ID c)"
    "    (Fallback (Action :ID f) (Wait :duration 2))))"
    "  (Inverter (ReactiveFallback :wait 1 (Condition :ID d)"
    "    (KeepRunningUntilFailure (Action :ID k))))"
    "  (ForceSuccess (Parallel :success 1 :halt 1 (Action :ID p)"
    "    (SequenceWithMemory (Condition :ID q) (Action :ID r))))"
    "  (ForceSuccess (Parallel :success 2 :wait 1"
    "    (Repeat :repeat 2 (Action :ID s))"
    "    (RetryUntilSuccessful :num_attempts 2 (Action :ID t))))"
    "  (ForceSuccess (Recovery :num_retries 1 (RateController :hz 5"
    "    (Action :ID u)) (Action :ID v)))"
    "  (ForceSuccess (PipelineSequence (Action :ID g) (Action :ID h)))"
    "  (ForceSuccess (RoundRobin (Action :ID i) (Action :ID m)))"
    "  (Eval (:= x (mod (+ x 1) 3)))"
    "  (ForceSuccess (Eval (= w w1))))))";

// What was changed, in words.
std::string mutate(Network& network, SplitMix64& random) {
  while (true) {
    Automaton& automaton = network.automata[static_cast<std::size_t>(
        random.below(static_cast<int>(network.automata.size())))];
    if (automaton.edges.empty()) continue;
    Edge& edge = automaton.edges[static_cast<std::size_t>(
        random.below(static_cast<int>(automaton.edges.size())))];
    const std::string where = automaton.name + ": " +
                              automaton.source(edge).name + " -> " +
                              automaton.target(edge).name;
    const int kind = random.below(3);
    if (kind == 0 && !edge.updates.empty()) {
      edge.updates.erase(edge.updates.begin() +
                         random.below(static_cast<int>(edge.updates.size())));
      return where + " without an update";
    }
    if (kind == 1 && !edge.guard.is_true()) {
      edge.guard = Expression::unary(Operation::Not, edge.guard);
      return where + " when it may not";
    }
    if (kind != 2) continue;
    const LocationId other{static_cast<std::uint32_t>(
        random.below(static_cast<int>(automaton.locations.size())))};
    if (other == edge.target) continue;
    edge.target = other;
    return where + ", but to " + automaton.locations[index(other)].name;
  }
}

TEST_CASE("a bug put back is found") {
  const Result<BehaviorTree> tree = read_btf("many.btf", kManyTypes);
  REQUIRE(tree.value.has_value());
  const Network sound = lower(*tree.value, TickSemantics::Root);
  const int mutations = by_effort(30, 300);
  SplitMix64 random(seed_or(1));
  TickCensus census;
  int found = 0;
  std::string survivors;
  for (int i = 0; i < mutations; ++i) {
    Network network = sound;
    const std::string change = mutate(network, random);
    bool differs = false;
    for (std::uint64_t run = 0; run < 40 && !differs; ++run) {
      differs =
          first_difference(*tree.value, network, run, 30, census).has_value();
    }
    found += differs ? 1 : 0;
    if (!differs) survivors += "\n  " + change;
  }
  MESSAGE(found << " of " << mutations
                << " bugs found; not found:" << survivors);
  CHECK_COVERED(found * 100 >= mutations * 60);
}

}  // namespace btcheck::reference::tick_cross_check_test
