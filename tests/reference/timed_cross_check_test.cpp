// SPDX-License-Identifier: MIT
//
// The search for violated real-time patterns against their definition.
//
// On random systems of a few states every short run is written out. A run that
// the search tells must violate the pattern by the definition: an infinite one
// as it is, a finite one however it goes on. Where it tells none, every short
// run must satisfy it; and no shorter beginning of a run may refute it, which
// it does when nothing that could follow saves the occurrence.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

#include "ltl/timed/pattern_search.hpp"
#include "reference/effort.hpp"
#include "reference/late_response.hpp"
#include "reference/timed_definition.hpp"
#include "reference/toy_system.hpp"

namespace btcheck::reference::timed_cross_check_test {

namespace {

constexpr int kPropositions = 3;
constexpr std::size_t kLongestWalk = 9;
constexpr std::size_t kMostWalks = 500;

int cases() { return by_effort(2000, 20000); }

int below(std::mt19937& random, int bound) {
  return static_cast<int>(random() % static_cast<unsigned>(bound));
}

// As in a network, some step of each state makes progress.
ToySystem small_system(std::mt19937& random, Justice justice) {
  ToySystem system;
  const int size = 2 + below(random, 5);
  for (int i = 0; i < size; ++i) {
    system.add(static_cast<PropositionSet>(below(random, 1 << kPropositions)) &
               static_cast<PropositionSet>(below(random, 1 << kPropositions)));
  }
  std::uint32_t edge = 0;
  for (int i = 0; i < size; ++i) {
    const int count = 1 + (below(random, 5) + 1) / 3;
    for (int k = 0; k < count; ++k) {
      const bool takes_time = below(random, 5) < 2;
      const bool is_free = k > 0 && !takes_time && below(random, 3) == 0 &&
                           justice == Justice::SomeStepsAreNot;
      system.add_step(static_cast<std::uint32_t>(i),
                      static_cast<std::uint32_t>(below(random, size)),
                      {takes_time ? kTimeStep : edge++,
                       static_cast<std::uint8_t>(takes_time), !is_free});
    }
  }
  system.add_initial(static_cast<std::uint32_t>(below(random, size)));
  return system;
}

// The shapes that property files have.
enum class Shape { Plain, After, Start, FromOpening, Before, Absence, Lasting };
constexpr int kShapeCount = 7;

TimedPattern random_pattern(std::mt19937& random, Shape shape) {
  const auto some = [&] {
    return PropositionSet{1} << below(random, kPropositions);
  };
  TimedPattern pattern;
  constexpr Demand kDemands[] = {Demand::Answer, Demand::FirstAnswer,
                                 Demand::NoAnswer};
  pattern.demand = kDemands[below(random, 3)];
  pattern.from = below(random, 3);
  pattern.to = below(random, 5) == 0 ? kNoEnd : pattern.from + below(random, 4);
  pattern.trigger = some();
  pattern.answer = some();
  const int length = below(random, 4);
  const auto spread = [&](TimedPattern& closed) {
    closed.closing = some();
    if (below(random, 4) > 0) {
      closed.trigger = 1, closed.answer = 2, closed.closing = 4;
    }
  };
  switch (shape) {
    case Shape::Plain:
      break;
    case Shape::After:
      pattern.opening = some();
      break;
    case Shape::FromOpening:
      pattern.opening = some();
      [[fallthrough]];
    case Shape::Start:
      pattern.trigger = 0;
      break;
    case Shape::Before:
      pattern.demand = kDemands[below(random, 2)];
      spread(pattern);
      break;
    case Shape::Absence:
      spread(pattern);
      pattern.demand = Demand::NoAnswer;
      pattern.answer = pattern.closing;
      pattern.from = 0;
      pattern.to = length;
      break;
    case Shape::Lasting:
      pattern.demand = Demand::Lasting;
      pattern.trigger = 0;
      pattern.opening = pattern.answer;
      pattern.must_open = true;
      pattern.from = 0;
      pattern.to = length;
      break;
  }
  return pattern;
}

// A beginning of a run.
struct Walk {
  std::vector<std::uint32_t> states;
  std::vector<Step> steps;  // steps[i] leads from states[i]
};

// How many steps walks may have without there being too many.
std::size_t walk_length(const ToySystem& system) {
  std::vector<std::size_t> walks(system.size(), 1);  // of `length` steps
  for (std::size_t length = 0; length < kLongestWalk; ++length) {
    std::vector<std::size_t> longer(system.size(), 0);
    for (std::size_t s = 0; s < system.size(); ++s) {
      for (const auto& step : system.steps(s)) longer[s] += walks[step.target];
    }
    walks = longer;
    if (walks[system.initial()[0]] > kMostWalks) return length;
  }
  return kLongestWalk;
}

// Every walk that goes on from `begin` by up to `length` steps, in the order
// of their lengths, as long as `visit` says so.
void for_each_walk(const ToySystem& system, const Walk& begin,
                   std::size_t length,
                   const std::function<bool(const Walk&)>& visit) {
  std::vector<Walk> walks = {begin};
  for (std::size_t i = 0; i < walks.size(); ++i) {
    if (!visit(walks[i])) return;
    if (walks[i].steps.size() == begin.steps.size() + length) continue;
    for (const auto& step : system.steps(walks[i].states.back())) {
      Walk longer = walks[i];
      longer.states.push_back(step.target);
      longer.steps.push_back(step.step);
      walks.push_back(std::move(longer));
    }
  }
}

TimedRun timed(const ToySystem& system, const Walk& walk) {
  TimedRun run;
  for (const std::uint32_t state : walk.states) {
    run.labels.push_back(system.label_of(state));
  }
  for (const Step& step : walk.steps) run.elapsed.push_back(step.elapsed);
  return run;
}

// The fair runs that a walk is, if it is closed at its last state; the loop
// begins no earlier than `from`.
void for_each_fair_run(const ToySystem& system, const Walk& walk,
                       std::size_t from,
                       const std::function<void(const TimedRun&)>& visit) {
  const std::size_t last = walk.steps.size();
  bool has_progress = false;
  for (std::size_t loop = last; loop-- > from;) {
    has_progress |= walk.steps[loop].progress;
    if (!has_progress || walk.states[loop] != walk.states[last]) continue;
    TimedRun run = timed(system, walk);
    run.labels.pop_back();
    run.loop = loop;
    visit(run);
  }
}

// Whether some occurrence in a beginning is violated whatever follows.
bool is_refuted(const TimedPattern& pattern, const TimedRun& begin) {
  for (std::size_t at = 0; at < begin.labels.size(); ++at) {
    if (is_lost_at(pattern, begin, at)) return true;
  }
  return false;
}

Walk walk_of(const Lasso& lasso) {
  Walk walk;
  const auto add = [&](const RunState& next) {
    if (!walk.states.empty()) walk.steps.push_back(next.step);
    walk.states.push_back(static_cast<std::uint32_t>(next.state[0]));
  };
  for (const RunState& next : lasso.prefix) add(next);
  for (const RunState& next : lasso.cycle) add(next);
  if (!lasso.cycle.empty()) {
    walk.states.push_back(
        static_cast<std::uint32_t>(lasso.cycle.front().state[0]));
    walk.steps.push_back(lasso.closing);
  }
  return walk;
}

struct Count {
  int empty = 0;
  int finite = 0;
  int infinite = 0;
  int runs = 0;        // that were to satisfy
  int going_on = 0;    // that were to violate
  int beginnings = 0;  // that were not to be refuted
};

class Comparison {
 public:
  Comparison(const ToySystem& system, const TimedPattern& pattern, Count& count)
      : system_(system),
        pattern_(pattern),
        count_(count),
        start_({{system.initial()[0]}, {}}),
        length_(walk_length(system)),
        found_(find_violation(system, pattern, Limits{})) {}

  // What is wrong, "" for nothing.
  std::string flaw() {
    if (found_.outcome == SearchOutcome::GaveUp) return "it gave up";
    const bool waits = pattern_.demand == Demand::Answer ||
                       pattern_.demand == Demand::FirstAnswer;
    if (!waits && found_.longest_answer >= 0) return "an answer to nothing";
    if (!found_.lasso) return flaw_of_none();
    if (!is_run(system_, *found_.lasso)) return "it is no run";
    return found_.lasso->cycle.empty() ? flaw_of_finite() : flaw_of_infinite();
  }

 private:
  std::string flaw_of_none() {
    ++count_.empty;
    std::string flaw = shorter_refuted(length_);
    for_each_walk(system_, start_, length_, [&](const Walk& walk) {
      for_each_fair_run(system_, walk, 0, [&](const TimedRun& run) {
        ++count_.runs;
        if (!satisfies(pattern_, run)) flaw = "a run it has not found";
      });
      return flaw.empty();
    });
    return flaw;
  }

  std::string flaw_of_infinite() {
    ++count_.infinite;
    if (!is_fair(*found_.lasso)) return "it is not fair";
    TimedRun run = timed(system_, walk_of(*found_.lasso));
    run.labels.pop_back();
    run.loop = found_.lasso->prefix.size();
    if (satisfies(pattern_, run)) return "the run satisfies";
    if (!is_violated_at(pattern_, run, found_.trigger_index) &&
        !never_opens(run)) {
      return "another occurrence";
    }
    return shorter_refuted(length_);
  }

  std::string flaw_of_finite() {
    ++count_.finite;
    const Walk walk = walk_of(*found_.lasso);
    const std::size_t last = walk.steps.size();
    std::string flaw = shorter_refuted(std::min(last, length_ + 1) - 1);
    int ways = 0;
    for_each_walk(system_, walk, length_, [&](const Walk& longer) {
      for_each_fair_run(system_, longer, last, [&](const TimedRun& run) {
        ++ways;
        if (satisfies(pattern_, run)) flaw = "it goes on and satisfies";
        if (!is_violated_at(pattern_, run, found_.trigger_index)) {
          flaw = "another occurrence";
        }
      });
      return flaw.empty();
    });
    count_.going_on += ways;
    if (ways == 0) return "it cannot go on";
    return flaw;
  }

  // Whether a run of up to `length` steps refutes the pattern.
  std::string shorter_refuted(std::size_t length) {
    std::string flaw;
    if (length > length_) return flaw;  // no steps at all
    for_each_walk(system_, start_, length, [&](const Walk& walk) {
      ++count_.beginnings;
      if (is_refuted(pattern_, timed(system_, walk))) flaw = "a shorter one";
      return flaw.empty();
    });
    return flaw;
  }

  bool never_opens(const TimedRun& run) const {
    if (!pattern_.must_open || found_.trigger_index + 1 != run.labels.size()) {
      return false;
    }
    for (const PropositionSet label : run.labels) {
      if ((label & pattern_.opening) != 0) return false;
    }
    return true;
  }

  const ToySystem& system_;
  const TimedPattern& pattern_;
  Count& count_;
  Walk start_;
  std::size_t length_;
  PatternRun found_;
};

std::string shown(const ToySystem& system, const TimedPattern& pattern) {
  std::string text = fmt::format(
      "P {} Q {} A {} R {} [{},{}] demand {} must open {}\n", pattern.trigger,
      pattern.answer, pattern.opening, pattern.closing, pattern.from,
      pattern.to, static_cast<int>(pattern.demand), pattern.must_open);
  for (std::size_t s = 0; s < system.size(); ++s) {
    text += fmt::format("{}{} label {}:", s == system.initial()[0] ? ">" : " ",
                        s, system.label_of(s));
    for (const auto& step : system.steps(s)) {
      text += fmt::format(" {}{}{}", step.target,
                          step.step.elapsed ? " in time" : "",
                          step.step.progress ? "," : " free,");
    }
    text += "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("a real-time pattern is violated iff its definition says so") {
  std::mt19937 random(shifted_seed(31));
  Count counts[kShapeCount];
  for (int round = 0; round < cases(); ++round) {
    const int shape = round % kShapeCount;
    const ToySystem system = small_system(
        random, round / kShapeCount % 2 == 0 ? Justice::EveryStepIsProgress
                                             : Justice::SomeStepsAreNot);
    const TimedPattern pattern =
        random_pattern(random, static_cast<Shape>(shape));
    const std::string flaw = Comparison(system, pattern, counts[shape]).flaw();
    if (!flaw.empty()) FAIL(flaw, "\n", shown(system, pattern));
    const bool is_late_response = static_cast<Shape>(shape) == Shape::Plain &&
                                  pattern.demand == Demand::Answer &&
                                  pattern.to != kNoEnd;
    if (!is_late_response) continue;
    CHECK(late_response(system, pattern).exists ==
          (find_violation(system, pattern, Limits{}).outcome ==
           SearchOutcome::Found));
  }
  constexpr const char* kNames[] = {"plain",   "after",  "from the start",
                                    "opening", "before", "absence",
                                    "lasting"};
  for (int shape = 0; shape < kShapeCount; ++shape) {
    const Count& count = counts[shape];
    MESSAGE(std::string(kNames[shape]), ": ", count.empty, " satisfied with ",
            count.runs, " runs; violated by ", count.finite,
            " finite runs going on in ", count.going_on, " ways and by ",
            count.infinite, " infinite; ", count.beginnings, " beginnings");
    const int least = cases() / kShapeCount / 20;
    CHECK_COVERED(count.empty > least);
    CHECK_COVERED(count.finite > least);
  }
}

}  // namespace btcheck::reference::timed_cross_check_test
