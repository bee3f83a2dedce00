// SPDX-License-Identifier: MIT
//
// Monitors against the definition of their three verdicts.
//
// Of formulas: after each letter of a random word, the words that begin so are
// written down as a system, a chain of states that goes over into all labels
// there are, and the tableau says whether one of them satisfies the formula,
// whether one violates it. Of patterns: every continuation of a few letters,
// its last letter for ever, is tried by the definition; intervals are so short
// that it takes no more of them.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <random>
#include <string>
#include <vector>

#include "ltl/monitor/monitor.hpp"
#include "reference/effort.hpp"
#include "reference/random_ltl.hpp"
#include "reference/tableau.hpp"
#include "reference/timed_definition.hpp"

namespace btcheck::reference::monitor_cross_check_test {
namespace {

constexpr std::uint32_t kAtoms = 2;
constexpr PropositionSet kLabels = 1 << kAtoms;

// All words that begin with the letters.
ToySystem words_after(const std::vector<PropositionSet>& letters) {
  ToySystem system;
  for (PropositionSet label = 0; label < kLabels; ++label) system.add(label);
  const auto go_anywhere = [&](std::uint32_t from) {
    for (std::uint32_t to = 0; to < kLabels; ++to) system.add_step(from, to);
  };
  for (std::uint32_t from = 0; from < kLabels; ++from) go_anywhere(from);
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const std::uint32_t next = system.add(letters[i]);
    if (i == 0) system.add_initial(next);
    if (i > 0) system.add_step(last, next);
    last = next;
  }
  if (!letters.empty()) go_anywhere(last);
  for (std::uint32_t any = 0; letters.empty() && any < kLabels; ++any) {
    system.add_initial(any);
  }
  return system;
}

Outlook expected(bool some_satisfies, bool some_violates) {
  if (!some_satisfies && !some_violates) return Outlook::Excluded;
  if (!some_satisfies) return Outlook::Violated;
  return some_violates ? Outlook::Open : Outlook::Satisfied;
}

std::string_view name_of(Outlook outlook) {
  return kOutlookNames[static_cast<std::size_t>(outlook)];
}

TEST_CASE("a monitor says what the words that begin so have in common") {
  std::mt19937 random(shifted_seed(17));
  int decided = 0;
  const int cases = by_effort(2000, 10000);
  for (int i = 0; i < cases; ++i) {
    FormulaPool pool;
    const int size = 2 + static_cast<int>(random() % 6);
    const FormulaId claim = random_formula(pool, random, size, kAtoms);
    const bool is_assumed = random() % 4 == 0;
    const FormulaId assumed = is_assumed
                                  ? random_formula(pool, random, 3, kAtoms)
                                  : pool.constant(true);
    const auto monitor = monitor_of(pool, claim, assumed);
    REQUIRE(monitor);
    const FormulaId good = pool.binary(FormulaKind::And, assumed, claim);
    const FormulaId bad = pool.binary(FormulaKind::And, assumed,
                                      pool.unary(FormulaKind::Not, claim));
    MonitorRun run(*monitor);
    std::vector<PropositionSet> letters;
    Outlook before = Outlook::Open;
    for (int length = 0; length <= 4; ++length) {
      CAPTURE(shown(pool, claim));
      CAPTURE(shown(pool, assumed));
      CAPTURE(length);
      // What has been said is said for good.
      if (before != Outlook::Open) {
        CHECK(run.outlook() == before);
      } else {
        const ToySystem system = words_after(letters);
        const Outlook wanted = expected(some_run_satisfies(system, pool, good),
                                        some_run_satisfies(system, pool, bad));
        CHECK(name_of(run.outlook()) == name_of(wanted));
        decided += wanted != Outlook::Open;
      }
      before = run.outlook();
      letters.push_back(random() % kLabels);
      run.read(letters.back());
    }
  }
  CHECK_COVERED(decided > cases / 3);
}

TEST_CASE("what is not known is as open as its ways") {
  std::mt19937 random(shifted_seed(18));
  for (int i = 0; i < by_effort(300, 3000); ++i) {
    FormulaPool pool;
    const FormulaId claim = random_formula(pool, random, 5, kAtoms);
    const auto monitor = monitor_of(pool, claim, pool.constant(true));
    REQUIRE(monitor);
    std::vector<MonitorRun> ways{MonitorRun(*monitor)};
    MonitorRun run(*monitor);
    for (int length = 0; length < 4; ++length) {
      const PropositionSet label = random() % kLabels;
      const PropositionSet unknown = random() % kLabels;
      std::vector<MonitorRun> longer;
      for (const MonitorRun& way : ways) {
        for (PropositionSet other = 0; other < kLabels; ++other) {
          if (((other ^ label) & ~unknown) != 0) continue;
          longer.push_back(way);
          longer.back().read(other);
        }
      }
      ways = std::move(longer);
      Outlook wanted = ways.front().outlook();
      for (const MonitorRun& way : ways) {
        if (way.outlook() != wanted) wanted = Outlook::Open;
      }
      CHECK(name_of(run.read(label, unknown)) == name_of(wanted));
    }
  }
}

// --- Real time ---------------------------------------------------------------

constexpr PropositionSet kElapsed = 8;

int below(std::mt19937& random, int bound) {
  return static_cast<int>(random() % static_cast<unsigned>(bound));
}

TimedPattern some_pattern(std::mt19937& random) {
  TimedPattern pattern;
  pattern.demand = static_cast<Demand>(below(random, 4));
  pattern.from = pattern.demand == Demand::Lasting ? 0 : below(random, 3);
  pattern.to = below(random, 6) == 0 ? kNoEnd : pattern.from + below(random, 2);
  switch (below(random, 5)) {
    case 0:
      pattern.trigger = 0;
      break;
    case 1:
      pattern.opening = 4;
      break;
    case 2:
      pattern.trigger = 0;
      pattern.opening = 4;
      pattern.must_open = below(random, 2) == 0;
      break;
    case 3:
      if (pattern.demand == Demand::Lasting) break;
      pattern.closing = 4;
      if (pattern.demand == Demand::NoAnswer) pattern.answer = 4;
      break;
    default:
      if (below(random, 4) == 0) pattern.answer = pattern.trigger;
      break;
  }
  return pattern;
}

// The word of such letters, the last of them for ever. A letter says whether
// time has passed before it.
TimedRun run_of(const std::vector<PropositionSet>& letters) {
  TimedRun run;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    run.labels.push_back(letters[i] & ~kElapsed);
    const std::size_t next = std::min(i + 1, letters.size() - 1);
    run.elapsed.push_back((letters[next] & kElapsed) != 0 ? 1 : 0);
  }
  run.loop = letters.size() - 1;
  return run;
}

// What the continuations by so many letters do.
void try_all(const TimedPattern& pattern, std::vector<PropositionSet>& letters,
             int more, bool& some_satisfies, bool& some_violates) {
  for (PropositionSet letter = 0; letter < 16; ++letter) {
    if (some_satisfies && some_violates) return;
    letters.push_back(letter);
    if (more > 1) {
      try_all(pattern, letters, more - 1, some_satisfies, some_violates);
    } else {
      const bool holds = satisfies(pattern, run_of(letters));
      (holds ? some_satisfies : some_violates) = true;
    }
    letters.pop_back();
  }
}

TEST_CASE("a monitor of a pattern says what all continuations do") {
  std::mt19937 random(shifted_seed(19));
  int decided = 0;
  const int cases = by_effort(400, 4000);
  for (int i = 0; i < cases; ++i) {
    const TimedPattern pattern = some_pattern(random);
    const auto monitor = monitor_of(pattern, kElapsed);
    REQUIRE(monitor);
    MonitorRun run(*monitor);
    std::vector<PropositionSet> letters;
    for (int length = 0; length < 6; ++length) {
      letters.push_back(random() % 16);
      if (random() % 3 != 0) letters.back() &= ~PropositionSet{4};
      if (length == 0) letters.back() &= ~kElapsed;
      run.read(letters.back());
      bool some_satisfies = false;
      bool some_violates = false;
      try_all(pattern, letters, 4, some_satisfies, some_violates);
      const Outlook wanted = expected(some_satisfies, some_violates);
      INFO(fmt::format(
          "trigger {} answer {} opening {} closing {} from {} to "
          "{} demand {} must open {}; letters {}",
          pattern.trigger, pattern.answer, pattern.opening, pattern.closing,
          pattern.from, pattern.to, static_cast<int>(pattern.demand),
          pattern.must_open, fmt::join(letters, " ")));
      CHECK(name_of(run.outlook()) == name_of(wanted));
      if (wanted != Outlook::Open) {
        ++decided;
        break;
      }
    }
  }
  CHECK_COVERED(decided > cases / 4);
}

}  // namespace
}  // namespace btcheck::reference::monitor_cross_check_test
