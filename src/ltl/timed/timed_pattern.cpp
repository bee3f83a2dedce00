// SPDX-License-Identifier: MIT
//
// What a state says of an occurrence that is `age` units of time old.
#include "ltl/timed/timed_pattern.hpp"

namespace btcheck {

Word PatternObserver::judged(Word age, PropositionSet label) const {
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

}  // namespace btcheck
