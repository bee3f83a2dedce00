// SPDX-License-Identifier: MIT
//
// Real-time patterns, and the observer that sees them violated.
//
// One observer serves the whole family of Abid, Dal Zilio and Le Botlan
// ("Real-time specification patterns and tools", FMICS 2012; the patterns of
// Fiacre's property language): it waits for its scope to open, then for an
// occurrence of the trigger, then counts the units of time and looks for the
// answer. It guesses which occurrence is to be violated: one idle mode and one
// for each age, where a deterministic observer would remember a set of ages. It
// is a layer around the network, so it never holds time up.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "explore/state/transition_system.hpp"
#include "ltl/formula/pattern.hpp"

namespace btcheck {

// The scope opens at the first state with `opening` and closes at the first
// state after that with `closing`; a run in which it never closes satisfies a
// pattern that has a closing. Within it each state with the trigger is an
// occurrence, which is looked at on its own; the state itself has age 0.
// Propositions are single bits, or 0 for none.
struct TimedPattern {
  PropositionSet trigger = 1;  // none: the opening of the scope is the only one
  PropositionSet answer = 2;
  int from = 0;  // units of time, 0 <= from <= to
  int to = 0;    // kNoEnd: at any age from `from` on
  Demand demand = Demand::Answer;
  PropositionSet opening = 0;  // none: open from the start
  PropositionSet closing = 0;  // none: never closes
  bool must_open = false;      // a run in which it never opens is a violation
};

// The modes of the observer: one word beside the state of the system.
class PatternObserver {
 public:
  explicit PatternObserver(const TimedPattern& pattern) : pattern_(pattern) {
    assert(0 <= pattern.from && pattern.from <= pattern.to);
  }

  static constexpr Word kShut = 0;
  static constexpr Word kIdle = 1;
  static constexpr Word kSatisfied = 2;  // nothing more can go wrong
  static constexpr Word kBroken = 3;     // a violation once the scope closes
  static constexpr Word kViolated = 4;

  const TimedPattern& pattern() const { return pattern_; }

  static bool is_pending(Word mode) { return mode > kViolated; }
  static bool has_begun(Word mode) { return mode > kIdle; }
  // A run whose observer stays in such modes for ever violates the pattern.
  bool is_due(Word mode) const {
    if (mode == kViolated) return true;
    if (mode == kShut) return pattern_.must_open;
    return is_pending(mode) && waits_for_answer() && pattern_.closing == 0;
  }
  bool waits_for_answer() const {
    return pattern_.demand == Demand::Answer ||
           pattern_.demand == Demand::FirstAnswer;
  }
  bool triggers(PropositionSet label) const {
    return (label & pattern_.trigger) != 0;
  }
  // The age in a pending mode; with kNoEnd it is not counted beyond `from`.
  static Word age(Word mode) { return mode - kPending; }

  // Calls found(mode) for each mode that may follow `mode` when `elapsed`
  // units of time lead to a state with this label; an initial state comes after
  // kShut.
  template <class Found>
  void follow(Word mode, Word elapsed, PropositionSet label,
              Found&& found) const {
    switch (mode) {
      case kShut:
        return wait_for_opening(label, found);
      case kIdle:
        return watch(label, found);
      case kBroken:
        return found(closes(label) ? kViolated : kBroken);
      case kSatisfied:
      case kViolated:
        return found(mode);
      default:
        return found(judged(age(mode) + elapsed, label));
    }
  }

 private:
  static constexpr Word kPending = 5;  // at age 0

  bool closes(PropositionSet label) const {
    return (label & pattern_.closing) != 0;
  }

  template <class Found>
  void wait_for_opening(PropositionSet label, Found&& found) const {
    const bool opens = pattern_.opening == 0 || (label & pattern_.opening) != 0;
    if (!opens) return found(kShut);
    if (pattern_.trigger == 0) return found(judged(0, label));
    watch(label, found);
  }

  // Stays idle at a state, and where it triggers also begins to count.
  template <class Found>
  void watch(PropositionSet label, Found&& found) const {
    if (closes(label)) return found(kSatisfied);
    found(kIdle);
    if (triggers(label)) found(judged(0, label));
  }

  // What a state says of an occurrence that is `age` units of time old.
  Word judged(Word age, PropositionSet label) const {
    const bool has_answer = (label & pattern_.answer) != 0;
    const bool is_over =
        pattern_.to != kNoEnd && age > static_cast<Word>(pattern_.to);
    const bool is_in_time = !is_over && age >= static_cast<Word>(pattern_.from);
    // An answer must come before the scope closes, and matters only if it does.
    const Word missed =
        pattern_.closing == 0 || closes(label) ? kViolated : kBroken;
    if (waits_for_answer()) {
      if (is_over || closes(label)) return missed;
      if (has_answer && is_in_time) return kSatisfied;
      if (has_answer && pattern_.demand == Demand::FirstAnswer) return missed;
    } else {
      if (is_over) return kSatisfied;
      const bool is_wrong = pattern_.demand == Demand::Lasting
                                ? !has_answer
                                : has_answer && is_in_time;
      if (is_wrong) return kViolated;
    }
    const Word counted = pattern_.to == kNoEnd
                             ? std::min(age, static_cast<Word>(pattern_.from))
                             : age;
    return kPending + counted;
  }

  TimedPattern pattern_;
};

}  // namespace btcheck
