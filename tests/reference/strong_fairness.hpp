// SPDX-License-Identifier: MIT
//
// Strong fairness on toy systems, told and searched from its definition.
#pragma once

#include <boost/dynamic_bitset.hpp>
#include <cstdint>
#include <vector>

#include "ltl/formula/formula.hpp"
#include "ltl/product/strong_fairness.hpp"
#include "reference/ltl_on_lassos.hpp"
#include "reference/toy_system.hpp"

namespace btcheck::reference {

// Requested infinitely often, granted infinitely often: two propositions.
struct Condition {
  std::uint32_t requested = 0;
  std::uint32_t granted = 0;
};

// What a search asks of conditions (ltl/product/strong_fairness.hpp), for a toy
// system or a product of one. Counts how often a state was asked for its marks.
class ToyFairness {
 public:
  ToyFairness(const ToySystem& system, std::vector<Condition> conditions)
      : system_(system), conditions_(std::move(conditions)) {}

  // Refers to this.
  StrongFairness fairness() const {
    return {conditions_.size(),
            [this](StateView state, auto& requested, auto& granted) {
              mark(state, requested, granted);
            }};
  }
  std::uint64_t asked() const { return asked_; }

 private:
  void mark(StateView state, boost::dynamic_bitset<>& requested,
            boost::dynamic_bitset<>& granted) const;

  const ToySystem& system_;
  std::vector<Condition> conditions_;
  mutable std::uint64_t asked_ = 0;
};

// Whether prefix · cycle · cycle · … satisfies every condition.
bool is_strongly_fair(const LassoWord& word,
                      const std::vector<Condition>& conditions);

// (⋀ ([]<> requested => []<> granted)) => formula.
FormulaId under_conditions(FormulaPool& pool,
                           const std::vector<Condition>& conditions,
                           FormulaId formula);

// Whether the system has a run with infinitely many steps of progress that
// satisfies every condition. Exponential in the number of conditions.
bool has_strongly_fair_run(const ToySystem& system,
                           const std::vector<Condition>& conditions);

}  // namespace btcheck::reference
