// SPDX-License-Identifier: MIT
//
// Branching time: which states of a stored graph satisfy a formula of CTL.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "explore/search/stored_graph.hpp"
#include "ltl/branching/fair_components.hpp"
#include "ltl/formula/formula.hpp"

namespace btcheck {

// That a formula holds in some state, or that it does not.
struct Claim {
  FormulaId formula{};
  bool holds = true;

  friend bool operator==(const Claim&, const Claim&) = default;
};

// What a run has to be like so that it shows E… holding or A… failing. Each
// list of claims is a conjunction; an empty one is true.
struct RunPlan {
  enum class Shape : unsigned char {
    Next,          // `target` in the second state
    Until,         // `hold` up to a state with `target`
    Always,        // `hold` for ever
    UntilOrAlways  // one of the two
  };

  Shape shape = Shape::Next;
  std::vector<Claim> hold;
  std::vector<Claim> target;
};

// The plan of a quantified formula of CTL: for E ψ a run with ψ, for A ψ one
// without.
RunPlan plan_of(const FormulaPool& formulas, FormulaId quantified);

// Decides CTL over fair runs on one graph. Quantifiers range over fair runs
// only: a state where none begins satisfies every A… and no E….
class CtlChecker {
 public:
  // `propositions` has a set of states for each atom number that occurs. The
  // pool, which may grow meanwhile, and the graph must outlive the checker.
  CtlChecker(std::shared_ptr<const FairRuns> runs, const FormulaPool& formulas,
             std::vector<StateSet> propositions);

  // The states where a formula of CTL holds: linear time for each operator.
  // The set is kept, and stays where it is as long as the checker.
  const StateSet& satisfying(FormulaId formula);
  bool is_true(Claim claim, StateId state) {
    return satisfying(claim.formula)[index(state)] == claim.holds;
  }

  // The states where all claims are true, each about a part of a formula that
  // `satisfying` was asked for.
  StateSet where(std::span<const Claim> claims) const;

  const FairRuns& runs() const { return *runs_; }
  const FormulaPool& formulas() const { return formulas_; }

 private:
  const StateSet& found(FormulaId formula) const;
  StateSet evaluate(FormulaId formula) const;
  // The states where a fair run of the plan begins.
  StateSet starts_of(const RunPlan& plan) const;

  std::size_t size() const { return runs_->graph().size(); }

  std::shared_ptr<const FairRuns> runs_;
  const FormulaPool& formulas_;
  std::vector<StateSet> propositions_;
  std::map<FormulaId, StateSet> satisfying_;
};

}  // namespace btcheck
