// SPDX-License-Identifier: MIT
//
// The metric temporal formulas of the patterns, read as quantifiers.
//
// After Abid, Dal Zilio and Le Botlan (FMICS 2012): P is the trigger, Q the
// answer, A the opening and R the closing. The loop is written out often enough
// that each index a quantifier could need occurs, with its date; what is said
// of all later indices is then said of those up to the end. Nothing here counts
// ages while walking along, and nothing knows of modes or of an observer.
#include "reference/timed_definition.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

namespace btcheck::reference {

namespace {

class RunMeaning {
 public:
  RunMeaning(const TimedPattern& pattern, const TimedRun& run)
      : pattern_(pattern) {
    const std::size_t size = run.labels.size();
    std::int64_t around = 0;
    for (std::size_t i = run.loop; i < size; ++i) around += run.elapsed[i];
    const std::int64_t reach =
        (pattern.to == kNoEnd ? pattern.from : pattern.to) + 1;
    const std::size_t turns =
        3 + (around == 0 ? 0 : static_cast<std::size_t>(reach / around) + 1);
    const std::size_t period = size - run.loop;
    begins_ = size + period;
    std::int64_t date = 0;
    for (std::size_t i = 0; i < size + turns * period; ++i) {
      const std::size_t state =
          i < size ? i : run.loop + (i - run.loop) % period;
      labels_.push_back(run.labels[state]);
      dates_.push_back(date);
      date += run.elapsed[state];
    }
  }

  bool holds() const {
    if (pattern_.closing != 0) return holds_before_closing();
    if (pattern_.opening == 0) return holds_from(0);
    // (not A) W (A and …), or U where it must open
    for (std::size_t a = 0; a < begins_; ++a) {
      if (has(a, pattern_.opening)) return holds_from(a);
    }
    return !pattern_.must_open;
  }

  bool is_occurrence(std::size_t at) const {
    std::size_t open = 0;
    if (pattern_.opening != 0) {
      while (open < at && !has(open, pattern_.opening)) ++open;
      if (!has(open, pattern_.opening)) return false;
    }
    for (std::size_t r = 0; pattern_.closing != 0 && r <= at; ++r) {
      if (has(r, pattern_.closing)) return false;
    }
    return pattern_.trigger == 0 ? at == open : has(at, pattern_.trigger);
  }

  // What is asked after an occurrence, disregarding `F R =>`.
  bool holds_after(std::size_t i) const {
    switch (pattern_.demand) {
      case Demand::Answer:  // F_I Q, or (not R) U_I (Q and not R)
        return is_answered(i, pattern_.closing);
      case Demand::FirstAnswer:  // (not Q) U_I Q, …
        return is_answered(i, pattern_.closing | pattern_.answer);
      case Demand::NoAnswer:  // G_I not Q
        for (std::size_t k = i; k < labels_.size(); ++k) {
          if (is_in_time(i, k) && has(k, pattern_.answer)) return false;
        }
        return true;
      case Demand::Lasting:  // G_I Q
        break;
    }
    for (std::size_t k = i; k < labels_.size(); ++k) {
      if (is_in_time(i, k) && !has(k, pattern_.answer)) return false;
    }
    return true;
  }

 private:
  bool has(std::size_t i, PropositionSet some) const {
    return (labels_[i] & some) != 0;
  }
  bool is_in_time(std::size_t i, std::size_t k) const {
    const std::int64_t age = dates_[k] - dates_[i];
    return age >= pattern_.from &&
           (pattern_.to == kNoEnd || age <= pattern_.to);
  }

  // (not spoilers) U_I (Q and not R)
  bool is_answered(std::size_t i, PropositionSet spoilers) const {
    for (std::size_t k = i; k < labels_.size(); ++k) {
      if (is_in_time(i, k) && has(k, pattern_.answer) &&
          !has(k, pattern_.closing)) {
        bool is_clean = true;
        for (std::size_t j = i; j < k; ++j) is_clean &= !has(j, spoilers);
        if (is_clean) return true;
      }
    }
    return false;
  }

  // G (P => …), or … alone
  bool holds_from(std::size_t begin) const {
    if (pattern_.trigger == 0) return holds_after(begin);
    for (std::size_t i = begin; i < begins_; ++i) {
      if (has(i, pattern_.trigger) && !holds_after(i)) return false;
    }
    return true;
  }

  // (F R) => (P => …) U R
  bool holds_before_closing() const {
    assert(pattern_.trigger != 0 && pattern_.opening == 0);
    bool closes = false;
    for (std::size_t r = 0; r < begins_; ++r) {
      if (!has(r, pattern_.closing)) continue;
      closes = true;
      bool is_kept = true;
      for (std::size_t i = 0; i < r; ++i) {
        is_kept &= !has(i, pattern_.trigger) || holds_after(i);
      }
      if (is_kept) return true;
    }
    return !closes;
  }

  const TimedPattern& pattern_;
  std::vector<PropositionSet> labels_;
  std::vector<std::int64_t> dates_;
  std::size_t begins_ = 0;  // later states repeat what is seen before it
};

}  // namespace

bool satisfies(const TimedPattern& pattern, const TimedRun& run) {
  return RunMeaning(pattern, run).holds();
}

bool is_violated_at(const TimedPattern& pattern, const TimedRun& run,
                    std::size_t at) {
  const RunMeaning meaning(pattern, run);
  return meaning.is_occurrence(at) && !meaning.holds_after(at);
}

namespace {

// One thing that could follow a beginning if every label were possible: some
// time, then one state for ever.
TimedRun followed(const TimedRun& begin, PropositionSet waiting, int units,
                  PropositionSet last) {
  TimedRun run = begin;
  run.elapsed.resize(begin.labels.size() - 1);
  run.elapsed.push_back(units >= 0);
  for (int i = 0; i < units; ++i) {
    run.labels.push_back(waiting);
    run.elapsed.push_back(1);
  }
  run.loop = run.labels.size();
  run.labels.push_back(last);
  run.elapsed.push_back(1);
  return run;
}

}  // namespace

bool is_lost_at(const TimedPattern& pattern, const TimedRun& begin,
                std::size_t at) {
  const bool has_closed = std::any_of(
      begin.labels.begin(), begin.labels.end(),
      [&](PropositionSet label) { return (label & pattern.closing) != 0; });
  if (pattern.closing != 0 && !has_closed) return false;
  // Enough to save an occurrence that can be saved.
  const int wait = (pattern.to == kNoEnd ? pattern.from : pattern.to) + 1;
  const PropositionSet labels[] = {0, pattern.answer, pattern.opening};
  for (const PropositionSet waiting : labels) {
    for (const PropositionSet last : labels) {
      for (int units = -1; units <= wait; ++units) {
        const TimedRun run = followed(begin, waiting, units, last);
        if (!is_violated_at(pattern, run, at)) return false;
      }
    }
  }
  return true;
}

}  // namespace btcheck::reference
