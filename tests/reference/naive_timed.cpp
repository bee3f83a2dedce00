// SPDX-License-Identifier: MIT
//
// Each state once for each thing that can be true of the occurrence picked.
// What is fine is left out, and so are all ways from there.
#include "reference/naive_timed.hpp"

#include <algorithm>
#include <vector>

namespace btcheck::reference {

namespace {

enum Phase : int { Shut, Open, Lost, LostOnceClosed, Picked };  // + age

class Phases {
 public:
  explicit Phases(const TimedPattern& pattern)
      : pattern_(pattern),
        oldest_(pattern.to == kNoEnd ? pattern.from : pattern.to) {}

  int count() const { return Picked + oldest_ + 1; }

  bool is_due(int phase) const {
    if (phase >= Picked) return waits() && pattern_.closing == 0;
    return phase == Lost || (phase == Shut && pattern_.must_open);
  }

  std::vector<int> begin(PropositionSet label) const {
    return after(pattern_.opening == 0 ? Open : Shut, 0, label, true);
  }

  std::vector<int> after(int phase, int elapsed, PropositionSet label,
                         bool is_first = false) const {
    const bool closes = (label & pattern_.closing) != 0;
    if (phase == Lost) return {Lost};
    if (phase == LostOnceClosed) return {closes ? Lost : LostOnceClosed};
    if (phase >= Picked) return judged(phase - Picked + elapsed, label);
    if (phase == Shut && (label & pattern_.opening) == 0) return {Shut};
    if (pattern_.trigger == 0) {
      const bool opens_here = phase == Shut || is_first;
      return opens_here ? judged(0, label) : std::vector<int>{};
    }
    if (closes) return {};
    std::vector<int> phases = {Open};
    if ((label & pattern_.trigger) != 0) {
      for (const int picked : judged(0, label)) phases.push_back(picked);
    }
    return phases;
  }

 private:
  bool waits() const {
    return pattern_.demand == Demand::Answer ||
           pattern_.demand == Demand::FirstAnswer;
  }

  std::vector<int> judged(int age, PropositionSet label) const {
    const bool answers = (label & pattern_.answer) != 0;
    const bool closes = (label & pattern_.closing) != 0;
    const bool is_over = pattern_.to != kNoEnd && age > pattern_.to;
    const bool is_in_time = age >= pattern_.from && !is_over;
    const std::vector<int> undecided = {Picked + std::min(age, oldest_)};
    if (pattern_.demand == Demand::Lasting) {
      if (is_over) return {};
      return answers ? undecided : std::vector<int>{Lost};
    }
    if (pattern_.demand == Demand::NoAnswer) {
      if (answers && is_in_time) return {Lost};
      return is_over ? std::vector<int>{} : undecided;
    }
    if (answers && is_in_time && !closes) return {};
    const bool spoils = pattern_.demand == Demand::FirstAnswer && answers;
    if (closes) return {Lost};
    if (!is_over && !spoils) return undecided;
    return {pattern_.closing == 0 ? Lost : LostOnceClosed};
  }

  const TimedPattern& pattern_;
  int oldest_;
};

}  // namespace

ToySystem with_occurrence(const ToySystem& system,
                          const TimedPattern& pattern) {
  const Phases phases(pattern);
  const auto count = static_cast<std::uint32_t>(phases.count());
  const auto place = [&](std::uint32_t state, int phase) {
    return state * count + static_cast<std::uint32_t>(phase);
  };
  ToySystem result;
  for (std::uint32_t s = 0; s < system.size(); ++s) {
    for (int phase = 0; phase < phases.count(); ++phase) {
      std::vector<ToySystem::ToyStep> steps;
      for (const ToySystem::ToyStep& step : system.steps(s)) {
        for (const int next : phases.after(phase, step.step.elapsed,
                                           system.label_of(step.target))) {
          steps.push_back({place(step.target, next), step.step});
        }
      }
      const PropositionSet due = phases.is_due(phase) ? 1 : 0;
      result.add(system.label_of(s) | due << kDue, std::move(steps));
    }
  }
  for (const std::uint32_t state : system.initial()) {
    for (const int phase : phases.begin(system.label_of(state))) {
      result.add_initial(place(state, phase));
    }
  }
  return result;
}

}  // namespace btcheck::reference
