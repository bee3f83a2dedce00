// SPDX-License-Identifier: MIT
//
// Model checking of CTL, operand by operand (Clarke, Emerson and Sistla 1986).
//
// A quantified formula becomes a plan: what a run must be like that shows E…,
// or that refutes A…. The paths shown to the user follow the same plans
// (ctl_path.cpp). Fairness as in Emerson and Lei (1987): a finite path counts
// when a fair run goes on from its end, and a run that has to stay in a set for
// ever ends in a fair component of that set.
#include "ltl/branching/ctl.hpp"

#include <cassert>

namespace btcheck {

RunPlan plan_of(const FormulaPool& formulas, FormulaId quantified) {
  using Shape = RunPlan::Shape;
  const bool holds = formulas[quantified].kind == FormulaKind::ExistsPath;
  const FormulaNode& path = formulas[formulas[quantified].left];
  const Claim left{path.left, holds};
  const Claim right{path.right, holds};
  switch (holds ? path.kind : dual(path.kind)) {
    case FormulaKind::Next:
      return {Shape::Next, {}, {left}};
    case FormulaKind::Eventually:
      return {Shape::Until, {}, {left}};
    case FormulaKind::Always:
      return {Shape::Always, {left}, {}};
    case FormulaKind::Until:
      return {Shape::Until, {left}, {right}};
    case FormulaKind::Release:
      return {Shape::UntilOrAlways, {right}, {left, right}};
    case FormulaKind::WeakUntil:
      if (holds) return {Shape::UntilOrAlways, {left}, {right}};
      // Not (f W g): g fails until both do.
      return {Shape::Until, {right}, {left, right}};
    default:
      break;
  }
  assert(false && "a quantified formula of CTL");
  return {};
}

const StateSet& CtlChecker::satisfying(FormulaId formula) {
  assert(!first_non_ctl(formulas_, formula));
  for (const FormulaId id : formulas_.nodes(formula)) {
    const FormulaKind kind = formulas_[id].kind;
    if (kind == FormulaKind::Atom || is_path_operator(kind)) continue;
    if (!satisfying_.contains(id)) satisfying_.emplace(id, evaluate(id));
  }
  return found(formula);
}

StateSet CtlChecker::evaluate(FormulaId formula) const {
  const FormulaNode& node = formulas_[formula];
  switch (node.kind) {
    case FormulaKind::False:
      return StateSet(size());
    case FormulaKind::Not:
      return ~found(node.left);
    case FormulaKind::And:
      return found(node.left) & found(node.right);
    case FormulaKind::Or:
      return found(node.left) | found(node.right);
    case FormulaKind::Implies:
      return ~(found(node.left) - found(node.right));
    case FormulaKind::Equivalent:
      return ~(found(node.left) ^ found(node.right));
    case FormulaKind::ExistsPath:
      return starts_of(plan_of(formulas_, formula));
    case FormulaKind::ForAllPaths:
      return ~starts_of(plan_of(formulas_, formula));
    default:
      break;
  }
  assert(node.kind == FormulaKind::True);
  return ~StateSet(size());
}

StateSet CtlChecker::where(std::span<const Claim> claims) const {
  StateSet states = ~StateSet(size());
  for (const Claim claim : claims) {
    if (claim.holds) {
      states &= found(claim.formula);
    } else {
      states -= found(claim.formula);
    }
  }
  return states;
}

StateSet CtlChecker::starts_of(const RunPlan& plan) const {
  using Shape = RunPlan::Shape;
  const Predecessors& predecessors = runs_->predecessors();
  const StateSet hold = where(plan.hold);
  if (plan.shape == Shape::Always) return runs_->starts_within(hold);
  const StateSet target = where(plan.target) & runs_->starts();
  if (plan.shape == Shape::Next) return predecessors.before(target);
  StateSet starts = predecessors.leading_to(hold, target);
  if (plan.shape == Shape::UntilOrAlways) starts |= runs_->starts_within(hold);
  return starts;
}

}  // namespace btcheck
