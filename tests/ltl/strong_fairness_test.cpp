// SPDX-License-Identifier: MIT
//
// Searches under strong fairness, on systems drawn by hand.
#include "ltl/product/strong_fairness.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "ltl/buchi/translate.hpp"
#include "ltl/formula_text.hpp"
#include "ltl/product/accepting_cycle.hpp"
#include "ltl/product/product.hpp"
#include "reference/toy_system.hpp"

namespace btcheck::strong_fairness_test {

namespace {

using reference::ToySystem;

constexpr Step kMove{.edge = 0, .elapsed = 0, .progress = true};

// Condition i is requested in states with proposition 2i and granted in those
// with proposition 2i + 1.
StrongFairness label_fairness(const ToySystem& system, std::size_t conditions) {
  return {conditions, [&system, conditions](StateView state,
                                            boost::dynamic_bitset<>& requested,
                                            boost::dynamic_bitset<>& granted) {
            const PropositionSet label = system.label(state);
            for (std::size_t i = 0; i < conditions; ++i) {
              requested[i] = (label >> (2 * i) & 1) != 0;
              granted[i] = (label >> (2 * i + 1) & 1) != 0;
            }
          }};
}

constexpr PropositionSet requests(int condition) {
  return PropositionSet{1} << (2 * condition);
}
constexpr PropositionSet grants(int condition) {
  return PropositionSet{2} << (2 * condition);
}

RunSearch search(const ToySystem& system, std::size_t conditions,
                 std::string_view formula = "true", const Limits& limits = {}) {
  FormulaPool pool;
  const auto automaton = translate(pool, parse(pool, formula));
  REQUIRE(automaton);
  return find_accepting_cycle(
      Product(system, *automaton, Justice::EveryStepIsProgress), limits,
      label_fairness(system, conditions));
}

// State i has label i of the list and steps to i + 1, the last to the first.
ToySystem ring(const std::vector<PropositionSet>& labels) {
  ToySystem system;
  const auto size = static_cast<std::uint32_t>(labels.size());
  for (std::uint32_t i = 0; i < size; ++i) {
    system.add(labels[i], {{(i + 1) % size, kMove}});
  }
  system.add_initial(0);
  return system;
}

bool visits(const Lasso& lasso, Word state) {
  return std::any_of(
      lasso.cycle.begin(), lasso.cycle.end(),
      [&](const RunState& moment) { return moment.state[0] == state; });
}

// Interrupts once it has been asked so often.
class Impatient : public SearchMonitor {
 public:
  explicit Impatient(int patience) : patience_(patience) {}
  StopReason observe(const SearchProgress& progress) override {
    most_bytes_ = std::max(most_bytes_, progress.bytes);
    return patience_-- > 0 ? StopReason::None : StopReason::Interrupted;
  }
  std::uint64_t most_bytes() const { return most_bytes_; }

 private:
  int patience_;
  std::uint64_t most_bytes_ = 0;
};

}  // namespace

TEST_CASE("a cycle that requests and never grants is no fair run") {
  CHECK(search(ring({requests(0), 0}), 1).outcome == SearchOutcome::Empty);
  CHECK(search(ring({requests(0), 0}), 0).outcome == SearchOutcome::Found);
  CHECK(search(ring({0, 0}), 1).outcome == SearchOutcome::Found);
  CHECK(search(ring({0, grants(0)}), 1).outcome == SearchOutcome::Found);
}

TEST_CASE("one state may both request and grant") {
  CHECK(search(ring({requests(0) | grants(0)}), 1).outcome ==
        SearchOutcome::Found);
}

TEST_CASE("a request before the cycle need not be granted") {
  ToySystem system = ring({requests(0)});
  system.add_step(0, system.add(0, {{1, kMove}}), kMove);
  const RunSearch result = search(system, 1);
  REQUIRE(result.outcome == SearchOutcome::Found);
  CHECK(result.lasso->prefix.size() == 1);
  CHECK(result.lasso->cycle.size() == 1);
}

TEST_CASE("the cycle told goes out of its way for a grant") {
  ToySystem system = ring({requests(0), 0, 0, 0, grants(0), 0});
  system.add_step(1, 0, kMove);
  const RunSearch result = search(system, 1);
  REQUIRE(result.outcome == SearchOutcome::Found);
  CHECK(result.lasso->cycle.size() == 6);
  CHECK(visits(*result.lasso, 4));
}

TEST_CASE("the cycle told avoids a request where that is shorter") {
  ToySystem system = ring({0, requests(0), 0, 0, grants(0), 0});
  system.add_step(0, system.add(0, {{0, kMove}}), kMove);
  const RunSearch result = search(system, 1);
  REQUIRE(result.outcome == SearchOutcome::Found);
  CHECK(result.lasso->cycle.size() == 2);
  CHECK_FALSE(visits(*result.lasso, 1));
}

TEST_CASE("what a detour passes must be granted too") {
  // 0 to 5 grants 0 on a way that requests 1, whose grant is off that way.
  ToySystem system =
      ring({requests(0), 0, requests(1), grants(0), 0, 0, grants(1)});
  system.add_step(4, 0, kMove);
  const RunSearch result = search(system, 2);
  REQUIRE(result.outcome == SearchOutcome::Found);
  CHECK(visits(*result.lasso, 6));
  CHECK(visits(*result.lasso, 3));
}

TEST_CASE("taking states out may take grants out, again and again") {
  // 2 is granted only beside request 1, 1 only beside request 0, 0 nowhere.
  const std::vector<PropositionSet> labels = {
      requests(0) | grants(1), requests(1) | grants(2), requests(2)};
  CHECK(search(ring(labels), 3).outcome == SearchOutcome::Empty);
  ToySystem system = ring(labels);
  for (std::uint32_t i = 0; i < 3; ++i) {
    system.add_step(i, i, kMove);
    system.add_step(i, (i + 2) % 3, kMove);
  }
  CHECK(search(system, 3).outcome == SearchOutcome::Empty);
  CHECK(search(system, 2).outcome == SearchOutcome::Found);
  system.add_step(2, system.add(0, {{2, kMove}, {3, kMove}}), kMove);
  const RunSearch result = search(system, 3);
  REQUIRE(result.outcome == SearchOutcome::Found);
  CHECK(result.lasso->cycle.size() == 1);
  CHECK(visits(*result.lasso, 3));
}

TEST_CASE("the part that is left must still pass all acceptance sets") {
  // Proposition 2, c, is on the far side of a request that is never granted.
  constexpr PropositionSet c = 4;
  ToySystem system = ring({0, requests(0), c});
  system.add_step(0, 0, kMove);
  CHECK(search(system, 1, "[]<> c").outcome == SearchOutcome::Empty);
  CHECK(search(system, 1, "[]<> !c").outcome == SearchOutcome::Found);
  system.add_step(2, 2, kMove);
  CHECK(search(system, 1, "[]<> c").outcome == SearchOutcome::Found);
  CHECK(search(system, 1, "[]<> c && []<> !c").outcome == SearchOutcome::Empty);
}

TEST_CASE("a single state that is left needs a step to itself") {
  ToySystem system = ring({requests(0), 0});
  CHECK(search(system, 1).outcome == SearchOutcome::Empty);
  system.add_step(1, 1, kMove);
  CHECK(search(system, 1).outcome == SearchOutcome::Found);
}

TEST_CASE("there may be more conditions than an acceptance set has bits") {
  // Condition 150 is requested in state 0 and granted only if 1 can be left.
  const StrongFairness last_of_many{
      151, [](StateView state, boost::dynamic_bitset<>& requested,
              boost::dynamic_bitset<>& granted) {
        requested[150] = state[0] == 0;
        granted[150] = state[0] == 2;
      }};
  FormulaPool pool;
  const auto automaton = translate(pool, parse(pool, "true"));
  ToySystem system = ring({0, 0});
  const auto outcome = [&] {
    return find_accepting_cycle(
               Product(system, *automaton, Justice::EveryStepIsProgress),
               Limits{}, last_of_many)
        .outcome;
  };
  CHECK(outcome() == SearchOutcome::Empty);
  system.add_step(1, system.add(0, {{0, kMove}}), kMove);
  CHECK(outcome() == SearchOutcome::Found);
}

TEST_CASE("the search stops before a large component is complete") {
  // Each state steps back to the one before: open to the end of the search.
  constexpr std::uint32_t kSize = 50000;
  ToySystem system;
  for (std::uint32_t i = 0; i < kSize; ++i) {
    system.add(i == 0 ? requests(0) : 0, {{i == 0 ? i : i - 1, kMove},
                                          {std::min(i + 1, kSize - 1), kMove}});
  }
  system.add_initial(0);
  const RunSearch result = search(system, 1);
  REQUIRE(result.outcome == SearchOutcome::Found);
  CHECK(result.progress.states < 20);
}

TEST_CASE("an examination asks the limits and counts its memory") {
  constexpr std::uint32_t kSize = 50 * kPollInterval;
  std::vector<PropositionSet> labels(kSize, 0);
  labels[kSize / 2] = requests(0);
  const ToySystem system = ring(labels);
  Impatient patient(1000000);
  const RunSearch whole = search(system, 1, "true", {.monitor = &patient});
  CHECK(whole.outcome == SearchOutcome::Empty);
  CHECK(whole.progress.expanded == kSize);
  CHECK(patient.most_bytes() > whole.progress.bytes + 16 * kSize);
  for (const int polls : {60, 120, 180}) {  // marks, steps, components
    Impatient monitor(polls);
    const RunSearch result = search(system, 1, "true", {.monitor = &monitor});
    CHECK(result.outcome == SearchOutcome::GaveUp);
    CHECK(result.stopped == StopReason::Interrupted);
    CHECK(result.progress.expanded == kSize);
  }
}

TEST_CASE("a candidate is examined when it has doubled and when complete") {
  Candidates candidates;
  CHECK_FALSE(candidates.is_due(1, 5));
  candidates.closed_cycle(3);
  CHECK(candidates.is_due(3, 4));
  CHECK_FALSE(candidates.is_due(3, 8));
  candidates.closed_cycle(3);
  CHECK_FALSE(candidates.is_due(3, 7));
  CHECK_FALSE(candidates.is_due(5, 100));
  CHECK(candidates.is_due(3, 8));
  candidates.closed_cycle(2);
  CHECK_FALSE(candidates.is_due(2, 15));
  CHECK(candidates.is_due_when_complete(2));
  CHECK_FALSE(candidates.is_due_when_complete(2));
}

TEST_CASE("equal marks have one number") {
  MarkTable table(70);
  boost::dynamic_bitset<> requested(70);
  boost::dynamic_bitset<> granted(70);
  CHECK(table.number(requested, granted) == MarkTable::kNothing);
  requested.set(69);
  const std::uint32_t request = table.number(requested, granted);
  CHECK(request != MarkTable::kNothing);
  CHECK(table.number(requested, granted) == request);
  const std::uint32_t grant = table.number(granted, requested);
  CHECK(grant != request);
  ConditionTally tally(table);
  CHECK(tally.is_fair());
  CHECK_FALSE(tally.add(request));
  CHECK_FALSE(tally.is_fair());
  CHECK(tally.requests_in_vain(request));
  CHECK(tally.grants_missing(grant));
  CHECK(tally.add(grant));
  CHECK(tally.is_fair());
  CHECK_FALSE(tally.requests_in_vain(request));
}

}  // namespace btcheck::strong_fairness_test
