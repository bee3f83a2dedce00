// SPDX-License-Identifier: MIT
//
// CTL over the fair runs of a toy system, by enumerating sets of states.
#pragma once

#include <cstdint>
#include <vector>

#include "ltl/formula/formula.hpp"
#include "reference/toy_system.hpp"

namespace btcheck::reference {

// A set of states of a toy system, of which there are at most 32.
using StateMask = std::uint32_t;

struct NaiveFairness {
  StateMask requested = 0;
  StateMask granted = 0;
};

class NaiveCtl {
 public:
  NaiveCtl(const ToySystem& system, std::vector<NaiveFairness> conditions);

  // The states where the formula holds; atom i is bit i of a label.
  StateMask satisfying(const FormulaPool& pool, FormulaId id) const;

  // Whether a run that sees just these states again and again may be fair:
  // they are strongly connected, with progress, and no condition is broken.
  bool can_recur(StateMask states) const;
  // The states where a fair run begins that never leaves `hold`.
  StateMask fair_within(StateMask hold) const;

 private:
  StateMask one_step_into(StateMask target) const;
  StateMask leading_to(StateMask hold, StateMask target) const;
  StateMask quantified(const FormulaPool& pool, FormulaId id) const;

  const ToySystem& system_;
  std::vector<NaiveFairness> conditions_;
  StateMask all_;
  std::vector<StateMask> recurring_;  // all sets that can recur
};

}  // namespace btcheck::reference
