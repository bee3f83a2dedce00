// SPDX-License-Identifier: MIT
//
// P leadsto Q within [from, to], on systems drawn by hand.
#include "ltl/timed/pattern_search.hpp"

#include <doctest/doctest.h>

#include "reference/toy_system.hpp"

namespace btcheck::pattern_search_test {

namespace {

using reference::ToySystem;

constexpr PropositionSet kP = 1;
constexpr PropositionSet kQ = 2;
constexpr Step kMove{.edge = 0, .elapsed = 0, .progress = true};
constexpr Step kFree{.edge = 1, .elapsed = 0, .progress = false};
constexpr Step kTick{.edge = kTimeStep, .elapsed = 1, .progress = true};

PatternRun search(const ToySystem& system, int from, int to,
                  const Limits& limits = {}) {
  return find_violation(
      system, {.trigger = kP, .answer = kQ, .from = from, .to = to}, limits);
}

// States with these labels one after the other by steps of time; the last
// idles.
ToySystem line(const std::vector<PropositionSet>& labels) {
  ToySystem system;
  const auto last = static_cast<std::uint32_t>(labels.size() - 1);
  for (std::uint32_t i = 0; i <= last; ++i) {
    system.add(labels[i], {{std::min(i + 1, last), kTick}});
  }
  system.add_initial(0);
  return system;
}

}  // namespace

TEST_CASE("an answer at either end of the interval is in time") {
  const ToySystem system = line({0, kP, 0, kQ, 0});
  CHECK(search(system, 2, 2).outcome == SearchOutcome::Empty);
  CHECK(search(system, 0, 2).outcome == SearchOutcome::Empty);
  CHECK(search(system, 2, 5).outcome == SearchOutcome::Empty);
}

TEST_CASE("an answer too early or too late is none") {
  const ToySystem system = line({0, kP, 0, kQ, 0});
  CHECK(search(system, 3, 4).outcome == SearchOutcome::Found);
  CHECK(search(system, 0, 1).outcome == SearchOutcome::Found);
}

TEST_CASE("the run ends with the step of time too much") {
  const PatternRun result = search(line({0, kP, 0, 0, 0}), 0, 1);
  REQUIRE(result.lasso);
  CHECK(result.lasso->prefix.size() == 4);
  CHECK(result.lasso->cycle.empty());
  CHECK(result.lasso->prefix.back().step == kTick);
  CHECK(result.trigger_index == 1);
}

TEST_CASE("a state with trigger and answer answers itself") {
  const ToySystem system = line({kP | kQ, 0, 0});
  CHECK(search(system, 0, 0).outcome == SearchOutcome::Empty);
  CHECK(search(system, 1, 2).outcome == SearchOutcome::Found);
}

TEST_CASE("every occurrence counts, also one while another waits") {
  const ToySystem system = line({kP, kP, kQ, 0, 0});
  CHECK(search(system, 1, 2).outcome == SearchOutcome::Empty);
  const PatternRun result = search(system, 2, 3);
  REQUIRE(result.outcome == SearchOutcome::Found);
  CHECK(result.trigger_index == 1);
}

TEST_CASE("an idle system lets time pass") {
  ToySystem system;
  system.add(kP, {{0, kTick}});
  system.add_initial(0);
  const PatternRun result = search(system, 0, 3);
  REQUIRE(result.lasso);
  CHECK(result.lasso->prefix.size() == 5);
  CHECK(result.trigger_index == 0);
}

TEST_CASE("time standing still while an answer is due is a violation") {
  ToySystem system;
  system.add(0, {{1, kTick}});
  system.add(kP, {{2, kMove}});
  system.add(0, {{3, kMove}});
  system.add(0, {{2, kMove}});
  system.add_initial(0);
  const PatternRun result = search(system, 0, 1000);
  REQUIRE(result.lasso);
  CHECK(result.trigger_index == 1);
  CHECK(result.lasso->prefix.size() == 2);
  CHECK(result.lasso->cycle.size() == 2);
}

TEST_CASE("free moves alone do not hold up time") {
  ToySystem system;
  system.add(kP, {{0, kFree}, {1, kTick}});
  system.add(kQ, {{1, kTick}});
  system.add_initial(0);
  CHECK(search(system, 0, 1).outcome == SearchOutcome::Empty);
}

TEST_CASE("triggers and the longest answer are told") {
  const PatternRun result = search(line({kP, kQ, kP, 0, 0, kQ, 0}), 0, 5);
  CHECK(result.outcome == SearchOutcome::Empty);
  CHECK(result.triggers == 2);
  CHECK(result.longest_answer == 3);
  CHECK(search(line({0, 0}), 0, 5).triggers == 0);
  CHECK(search(line({0, 0}), 0, 5).longest_answer == -1);
}

TEST_CASE("a wide interval costs nothing where answers come soon") {
  const PatternRun result = search(line({kP, 0, kQ, 0}), 0, 1'000'000'000);
  CHECK(result.outcome == SearchOutcome::Empty);
  CHECK(result.progress.states < 10);
}

TEST_CASE("a search for late answers that reaches its limit gives up") {
  ToySystem system;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    system.add(0, {{(i + 1) % 20000, kTick}});
  }
  system.add_initial(0);
  const PatternRun result = search(system, 0, 5, Limits{.max_states = 3000});
  CHECK(result.outcome == SearchOutcome::GaveUp);
  CHECK(result.stopped == StopReason::MaxStates);
}

}  // namespace btcheck::pattern_search_test
