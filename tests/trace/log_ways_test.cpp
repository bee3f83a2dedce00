// SPDX-License-Identifier: MIT
//
// Logs that do not show where ticks begin: nothing rests on a guess.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "ltl/rules/property.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/watch/watched_run.hpp"

namespace btcheck::log_ways_test {
namespace {

constexpr LogStatus kIdle = LogStatus::Idle;
constexpr LogStatus kRunning = LogStatus::Running;
constexpr LogStatus kSuccess = LogStatus::Success;
constexpr LogStatus kFailure = LogStatus::Failure;

// A Sequence of three leaves.
BehaviorLog patrol() {
  BehaviorLog log;
  log.begin = 1;
  log.tree = "M";
  log.nodes = {{1, "patrol", "Sequence", std::nullopt, 0, false},
               {2, "look", "Look", 1, 1, false},
               {3, "plan", "Plan", 1, 1, false},
               {4, "go", "Go", 1, 1, false}};
  return log;
}

std::vector<WatchedRule> asked(const BehaviorLog& log,
                               const LogReading& reading,
                               const std::string& rules) {
  const auto read = read_properties("r.ltl", rules);
  REQUIRE(read.value);
  const SourceText source("r.ltl", rules);
  auto report = watch_log("a.btlog", log, reading, *read.value, source);
  REQUIRE(report.value);
  return std::move(report.value->rules);
}

TEST_CASE("a leaf that blocks 20 ms in a tick does not make two of it") {
  BehaviorLog log = patrol();
  // One tick: `plan` blocks, and `go` is ticked in the same one.
  log.transitions = {
      {0, 1, kIdle, kRunning},          {10, 2, kIdle, kSuccess},
      {20'010, 3, kIdle, kSuccess},     {20'020, 4, kIdle, kRunning},
      {100'000, 4, kRunning, kSuccess}, {100'010, 1, kRunning, kSuccess}};
  const std::string rules =
      "property at_once: whenever look.success then go.ticked within 0 ticks\n"
      "property seen: never go.ticked && look.answer != success\n"
      "property in_order: look.success precedes go.ticked\n"
      "property ends: possible root.success\n"
      "property apart: never look.answer == success && go.answer == success\n";
  const auto guessed = asked(log, {}, rules);
  CHECK(guessed[0].outlook == Outlook::Open);
  CHECK(guessed[0].guess == TickGuess::Begin);
  CHECK(moment_text(guessed[0]) ==
        "where ticks begin is not logged, and decides it: attach "
        "btcheck::observer to the tree, or say --tick-gap MS");
  CHECK(guessed[1].outlook == Outlook::Open);
  CHECK(guessed[2].outlook == Outlook::Satisfied);
  CHECK(moment_text(guessed[2]) == "record 2, after 0.000010 s");
  CHECK(guessed[3].outlook == Outlook::Satisfied);
  CHECK(guessed[4].outlook == Outlook::Open);
  CHECK(guessed[4].guess == TickGuess::Begin);

  // Who knows the robot says that a pause of 50 ms parts two ticks.
  const auto known = asked(log, {.tick_gap = 50'000}, rules);
  CHECK(known[0].outlook == Outlook::Open);
  CHECK(known[0].guess == TickGuess::None);
  CHECK(known[1].outlook == Outlook::Open);
  CHECK(known[4].outlook == Outlook::Open);
  // If one of 5 ms did, `go` would be ticked too late.
  const auto wrong = asked(log, {.tick_gap = 5'000}, rules);
  CHECK(wrong[0].outlook == Outlook::Violated);
  CHECK(wrong[1].outlook == Outlook::Open);
}

TEST_CASE("a tree that has answered begins a tick with its next record") {
  BehaviorLog log = patrol();
  const std::vector<LogTransition> round = {
      {0, 1, kIdle, kRunning}, {0, 2, kIdle, kSuccess},
      {0, 3, kIdle, kFailure}, {0, 1, kRunning, kFailure},
      {0, 2, kSuccess, kIdle}, {0, 3, kFailure, kIdle},
      {0, 1, kFailure, kIdle}};
  for (int i = 0; i < 4; ++i) {
    log.transitions.insert(log.transitions.end(), round.begin(), round.end());
  }
  const auto found = asked(
      log, {},
      "property soon: whenever look.success then go.success within 2 ticks\n"
      "property late: whenever look.success then go.success within 9 ticks\n"
      "property twice: never root.failure\n"
      "property again: never look.ticked && previously plan.answer == "
      "failure\n");
  CHECK(found[0].outlook == Outlook::Violated);
  CHECK(found[1].outlook == Outlook::Open);
  CHECK(found[1].guess == TickGuess::Begin);
  CHECK(found[2].outlook == Outlook::Violated);
  CHECK(moment_text(found[2]) == "record 4, after 0.000000 s");
  REQUIRE(found[2].run);
  CHECK(found[2].run->end_words ==
        "violated here, whatever comes then; where ticks begin is not logged");
}

TEST_CASE("how many ticks a pause has is known where their time is") {
  BehaviorLog log = patrol();
  log.transitions = {{0, 1, kIdle, kRunning},
                     {0, 2, kIdle, kRunning},
                     {500'000, 2, kRunning, kSuccess}};
  const std::string rules =
      "property soon: whenever look.ticked then look.success within 3 ticks\n";
  const auto open = asked(log, {.tick_gap = 5'000}, rules);
  CHECK(open[0].outlook == Outlook::Open);
  CHECK(open[0].guess == TickGuess::Count);
  CHECK(moment_text(open[0]) ==
        "ticks without a record are not logged, and decide it: attach "
        "btcheck::observer to the tree, or say --tick-ms MS");
  // It is ticked and answers only five ticks later.
  const auto counted = asked(log, {100'000, true, 5'000}, rules);
  CHECK(counted[0].outlook == Outlook::Violated);
  const auto slow = asked(log, {500'000, true, 5'000}, rules);
  CHECK(slow[0].outlook == Outlook::Open);
  CHECK(slow[0].guess == TickGuess::None);
}

// All ways to cut a log into ticks, against the one verdict without them.
TEST_CASE("what is decided without ticks is so however the log is cut") {
  std::mt19937 random(5);
  const std::string rules =
      "property a: never plan.success && look.answer == success\n"
      "property b: whenever look.ticked then plan.ticked within 1 ticks\n"
      "property c: look.success precedes plan.ticked\n"
      "property d: never root.running && previously look.answer == failure\n"
      "property e: possible once plan.failure and go.ticked\n"
      "property f: whenever go.ticked then root.success within 2 ticks\n"
      "property g: never go.failure since look.failure\n"
      "property h: never plan.ticked\n";
  int decided = 0;
  int open = 0;
  for (int i = 0; i < 25; ++i) {
    BehaviorLog log = patrol();
    std::vector<LogStatus> status(5, kIdle);
    const auto change = [&](std::uint16_t uid, LogStatus to) {
      if (status[uid] == to) return;
      log.transitions.push_back({0, uid, status[uid], to});
      status[uid] = to;
    };
    // Ticks of a Sequence, whose leaves answer at random.
    std::uint16_t child = 2;
    std::vector<std::size_t> begins;
    for (int tick = 0; tick < 4 && log.transitions.size() < 7; ++tick) {
      begins.push_back(log.transitions.size());
      change(1, kRunning);
      for (bool goes_on = true; goes_on;) {
        constexpr LogStatus kAnswers[] = {kSuccess, kFailure, kRunning};
        const LogStatus answer = kAnswers[random() % 3];
        change(child, answer);
        goes_on = answer == kSuccess && child < 4;
        if (answer == kRunning) break;
        if (goes_on) ++child;
        if (goes_on) continue;
        change(1, answer);
        for (std::uint16_t uid = 2; uid <= 4; ++uid) change(uid, kIdle);
        change(1, kIdle);
        child = 2;
      }
    }
    const auto without = asked(log, {}, rules);
    const std::size_t gaps = log.transitions.size() - 1;
    if (gaps > 7) continue;
    for (std::uint32_t cut = 0; cut < (1U << gaps); ++cut) {
      // Where the tree begins anew, a tick does.
      bool is_possible = true;
      for (std::size_t g = 0; g < gaps; ++g) {
        const LogTransition& next = log.transitions[g + 1];
        const bool begins_anew = next.uid == 1 && next.after == kRunning;
        is_possible &= !begins_anew || (cut >> g & 1) != 0;
        // Resets are of the tick that has ended.
        const bool is_reset = next.after == kIdle && next.before != kRunning;
        is_possible &= !is_reset || (cut >> g & 1) == 0;
      }
      if (!is_possible) continue;
      BehaviorLog timed = log;
      std::int64_t time = 0;
      for (std::size_t g = 0; g < gaps; ++g) {
        time += (cut >> g & 1) != 0 ? 100'000 : 1;
        timed.transitions[g + 1].time = time;
      }
      const auto with = asked(timed, {100'000, true, 50'000}, rules);
      for (std::size_t r = 0; r < with.size(); ++r) {
        if (without[r].outlook == Outlook::Open) continue;
        CAPTURE(i);
        CAPTURE(cut);
        CAPTURE(with[r].name);
        REQUIRE(with[r].outlook == without[r].outlook);
      }
    }
    for (const WatchedRule& rule : without) {
      ++(rule.outlook == Outlook::Open ? open : decided);
    }
  }
  MESSAGE(decided << " decided, " << open << " open");
  CHECK(decided > 5);
}

}  // namespace
}  // namespace btcheck::log_ways_test
