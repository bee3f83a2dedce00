// SPDX-License-Identifier: MIT
//
// While the counter is below its last value, no network can tell which value
// that is. So a run that stays below is one of all networks that count further.
// Another one is made longer: between two states that differ in the counter
// alone, by one, a round is gone through again. What the rule says of the
// longer runs is read off the truth of its parts: each follows from those
// behind it, so where two rounds in a row begin with the same truths, further
// ones in front of them do, too. (docs/reductions.md, "For every count")
#include "check/replay/counted_run.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "check/replay/evidence.hpp"
#include "ltl/formula/lasso_evaluation.hpp"

namespace btcheck {
namespace {

// The states from `first` to before `behind` can be gone through again.
struct Round {
  std::size_t first = 0;
  std::size_t behind = 0;
};

// Rounds are gone through so many times more, until truths repeat.
constexpr std::size_t kMostMore = 8;

class CountedRun {
 public:
  CountedRun(const Network& network, VariableId counter, Run run)
      : counter_(index(counter)),
        last_(network.variable(counter).max),
        run_(std::move(run)) {
    begin_loop_with_reset();
  }

  int greatest() const {
    int most = 0;
    for (std::size_t i = 0; i < run_.state_count(); ++i) {
      most = std::max(most, count(i));
    }
    return most;
  }

  const Run& run() const { return run_; }

  // A round for each time that the counter comes to its last value; nothing
  // where there is none for some.
  std::optional<std::vector<Round>> rounds() const {
    std::vector<Round> all;
    for (std::size_t begin = 0; begin < run_.state_count();) {
      std::size_t end = begin + 1;
      while (end < run_.state_count() && count(end) >= count(end - 1)) ++end;
      if (count(end - 1) == last_) {
        const auto round = round_in(begin, end);
        if (!round) return std::nullopt;
        all.push_back(*round);
      }
      begin = end;
    }
    return all;
  }

 private:
  int count(std::size_t state) const {
    return run_.state(state).variables[counter_];
  }

  // Where the counter falls on the loop, the loop begins behind such a fall:
  // then no rise of it is partly before the loop and partly in it.
  void begin_loop_with_reset() {
    if (run_.loop == kNoLoop) return;
    const std::size_t end = run_.state_count() - 1;
    std::size_t fall = run_.loop + 1;
    while (fall <= end && count(fall) >= count(fall - 1)) ++fall;
    if (fall > end) return;
    std::vector<RunStep> again(
        run_.steps.begin() + static_cast<std::ptrdiff_t>(run_.loop),
        run_.steps.begin() + static_cast<std::ptrdiff_t>(fall));
    run_.steps.insert(run_.steps.end(), again.begin(), again.end());
    run_.loop = fall;
  }

  bool differ_by_one(std::size_t first, std::size_t behind) const {
    Valuation one = run_.state(first);
    ++one.variables[counter_];
    return one == run_.state(behind);
  }

  // From 1 on, as a counter that is set to 0 there falls; and below the last
  // value.
  std::optional<Round> round_in(std::size_t begin, std::size_t end) const {
    for (std::size_t first = begin; first < end; ++first) {
      if (count(first) < 1) continue;
      for (std::size_t behind = first + 1; behind < end; ++behind) {
        if (count(behind) > count(first) + 1 || count(behind) >= last_) break;
        // A round lies before the loop or in it.
        if (run_.loop != kNoLoop && first < run_.loop && behind > run_.loop) {
          break;
        }
        if (differ_by_one(first, behind)) return Round{first, behind};
      }
    }
    return std::nullopt;
  }

  std::uint32_t counter_;
  int last_;
  Run run_;
};

// The word with each round `more` times more, and where the first two copies of
// each begin.
struct LongerWord {
  std::vector<PropositionSet> labels;
  std::size_t loop = 0;
  std::vector<std::pair<std::size_t, std::size_t>> begins;
};

LongerWord longer(const RunWord& word, const std::vector<Round>& rounds,
                  std::size_t more) {
  LongerWord made;
  for (std::size_t i = 0; i <= word.labels.size(); ++i) {
    for (const Round& round : rounds) {
      if (round.behind != i) continue;
      const std::size_t length = round.behind - round.first;
      const std::size_t begin = made.labels.size() - length;
      made.begins.emplace_back(begin, made.labels.size());
      for (std::size_t copy = 0; copy < more; ++copy) {
        for (std::size_t k = 0; k < length; ++k) {
          made.labels.push_back(word.labels[round.first + k]);
        }
      }
    }
    if (i == word.labels.size()) break;
    if (i == word.loop) made.loop = made.labels.size();
    made.labels.push_back(word.labels[i]);
  }
  return made;
}

// The formula is false on the word, however often each round is gone through.
bool stays_false(const RunWord& word, const std::vector<Round>& rounds) {
  for (std::size_t more = 0; more <= kMostMore; ++more) {
    const LongerWord made = longer(word, rounds, more);
    const auto truths =
        truths_on_lasso(word.pool, word.formula, made.labels, made.loop);
    if (truths.back()[0]) return false;
    const auto repeats = [&](const auto& begins) {
      return std::ranges::all_of(truths, [&](const std::vector<bool>& truth) {
        return truth[begins.first] == truth[begins.second];
      });
    };
    if (more > 0 && std::ranges::all_of(made.begins, repeats)) return true;
  }
  return false;
}

// An answer that is missing, or comes too late, does so on longer runs as well.
bool only_late_is_wrong(const BoundProperty& rule) {
  const TimedPattern& pattern = rule.timed.pattern;
  return pattern.demand == Demand::Answer && pattern.from == 0 &&
         pattern.opening == 0 && pattern.closing == 0 && !rule.is_assumed;
}

}  // namespace

std::optional<int> least_last_value(const Network& network, VariableId counter,
                                    const Run& run, const BoundProperty& rule) {
  const int last = network.variable(counter).max;
  const CountedRun counted(network, counter, run);
  if (counted.greatest() < last) return counted.greatest() + 1;
  const auto rounds = counted.rounds();
  if (!rounds) return std::nullopt;
  if (rule.form == PropertyForm::Timed) {
    return only_late_is_wrong(rule) ? std::optional(last) : std::nullopt;
  }
  // What a last state shows, it shows behind further rounds.
  if (asks_of_states(rule.form) && !rule.is_assumed) return last;
  const auto word = word_of(network, counted.run(), rule.formula);
  if (!word || !stays_false(*word, *rounds)) return std::nullopt;
  return last;
}

}  // namespace btcheck
