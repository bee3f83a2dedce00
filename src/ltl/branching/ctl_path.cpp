// SPDX-License-Identifier: MIT
//
// Showing a claim by one path (after Clarke, Grumberg, McMillan and Zhao 1995).
//
// What is to be shown is taken apart until it is about a run: of a disjunction
// a part that is true and that a path shows best, of a conjunction the part
// that is worth showing, the rest being noted as unshown. Then the plan of the
// quantifier is walked, and what is claimed of the state where it ends is
// shown from there. That is a loop: a path has one end.
#include "ltl/branching/ctl.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace btcheck {
namespace {

// How a claim may be demonstrated, best first.
enum class Demonstration : unsigned char {
  State,  // by looking at the state
  Path,   // by one path
  Tree    // not by one path, or not entirely
};

// A claim about a boolean operator as claims about its operands.
struct Parts {
  bool all_needed = false;  // or else one of them
  std::vector<Claim> claims;
};

bool is_boolean(FormulaKind kind) {
  return !is_leaf(kind) && !is_temporal(kind);
}

// Equivalences are taken for what is claimed if `left_holds`.
Parts parts_of(const FormulaNode& node, bool holds, bool left_holds) {
  switch (node.kind) {
    case FormulaKind::Not:
      return {true, {{node.left, !holds}}};
    case FormulaKind::And:
      return {holds, {{node.left, holds}, {node.right, holds}}};
    case FormulaKind::Or:
      return {!holds, {{node.left, holds}, {node.right, holds}}};
    case FormulaKind::Implies:
      return {!holds, {{node.left, !holds}, {node.right, holds}}};
    case FormulaKind::Equivalent:
      return {true,
              {{node.left, left_holds}, {node.right, left_holds == holds}}};
    default:
      break;
  }
  assert(false && "a boolean operator");
  return {};
}

bool is_run(FormulaKind kind, bool holds) {
  return kind == (holds ? FormulaKind::ExistsPath : FormulaKind::ForAllPaths);
}

// For each claim about a part of a formula, how it may be demonstrated in the
// worst case.
class Demonstrations {
 public:
  Demonstrations(const FormulaPool& formulas, FormulaId formula)
      : formulas_(formulas), of_(2 * (index(formula) + 1)) {
    for (const FormulaId id : formulas.nodes(formula)) {
      for (const bool holds : {false, true}) {
        of_[place({id, holds})] = judge({id, holds});
      }
    }
  }

  Demonstration of(Claim claim) const { return of_[place(claim)]; }

  // Of claims that are all needed. The one that takes a path is gone on with.
  Demonstration of_all(const std::vector<Claim>& claims) const {
    const auto not_by_state = std::ranges::count_if(
        claims, [&](Claim claim) { return of(claim) != Demonstration::State; });
    return not_by_state > 1 ? Demonstration::Tree : worst(claims);
  }

 private:
  static std::size_t place(Claim claim) {
    return 2 * index(claim.formula) + (claim.holds ? 1 : 0);
  }

  Demonstration worst(const std::vector<Claim>& claims) const {
    Demonstration found = Demonstration::State;
    for (const Claim claim : claims) found = std::max(found, of(claim));
    return found;
  }

  Demonstration judge(Claim claim) const {
    const FormulaNode& node = formulas_[claim.formula];
    if (is_leaf(node.kind)) return Demonstration::State;
    if (is_boolean(node.kind)) return judge_boolean(node, claim.holds);
    if (!is_run(node.kind, claim.holds)) return Demonstration::Tree;
    const RunPlan plan = plan_of(formulas_, claim.formula);
    const bool is_shown = of_all(plan.hold) == Demonstration::State &&
                          of_all(plan.target) != Demonstration::Tree;
    return is_shown ? Demonstration::Path : Demonstration::Tree;
  }

  Demonstration judge_boolean(const FormulaNode& node, bool holds) const {
    const Parts parts = parts_of(node, holds, true);
    if (!parts.all_needed) return worst(parts.claims);
    Demonstration found = of_all(parts.claims);
    if (node.kind == FormulaKind::Equivalent) {
      found = std::max(found, of_all(parts_of(node, holds, false).claims));
    }
    return found;
  }

  const FormulaPool& formulas_;
  std::vector<Demonstration> of_;
};

class PathMaker {
 public:
  PathMaker(CtlChecker& checker, FormulaId formula, StateId start)
      : checker_(checker),
        formulas_(checker.formulas()),
        demonstrations_(formulas_, formula) {
    path_.states.push_back(start);
  }

  std::optional<GraphPath> make(Claim claim) {
    std::optional<Claim> next = about_runs({claim});
    bool shows_something = path_.is_complete() && !next;
    while (next) {
      const FormulaKind kind = formulas_[next->formula].kind;
      if (!is_run(kind, next->holds)) {
        leave_unshown(*next, last(), last());
        break;
      }
      shows_something = true;
      next = walk(plan_of(formulas_, next->formula));
    }
    if (!shows_something) return std::nullopt;
    return std::move(path_);
  }

 private:
  std::size_t last() const { return path_.states.size() - 1; }
  StateId end() const { return path_.states.back(); }

  void leave_unshown(Claim claim, std::size_t first, std::size_t to) {
    path_.unshown.push_back({claim, first, to});
  }

  // Takes claims that are all true of the last state apart; what remains is
  // about a quantifier. Nothing: to look at the state is enough.
  std::optional<Claim> about_runs(std::vector<Claim> claims) {
    while (true) {
      const auto best = std::ranges::min_element(
          claims, {}, [&](Claim claim) { return usefulness(claim); });
      if (best == claims.end()) return std::nullopt;
      const Claim chosen = *best;
      claims.erase(best);
      for (const Claim other : claims) {
        if (demonstrations_.of(other) == Demonstration::State) continue;
        leave_unshown(other, last(), last());
      }
      if (demonstrations_.of(chosen) == Demonstration::State) {
        return std::nullopt;
      }
      if (!is_boolean(formulas_[chosen.formula].kind)) return chosen;
      claims = true_parts(chosen);
    }
  }

  // Of several needed claims one that a path shows is the best to go on with.
  int usefulness(Claim claim) const {
    constexpr int kByDemonstration[] = {2, 0, 1};
    return kByDemonstration[static_cast<int>(demonstrations_.of(claim))];
  }

  // All parts of a conjunction; of a disjunction the true one shown best.
  std::vector<Claim> true_parts(Claim claim) {
    const FormulaNode& node = formulas_[claim.formula];
    const Parts parts =
        parts_of(node, claim.holds, checker_.is_true({node.left, true}, end()));
    if (parts.all_needed) return parts.claims;
    std::optional<Claim> best;
    for (const Claim part : parts.claims) {
      if (!checker_.is_true(part, end())) continue;
      if (!best || demonstrations_.of(part) < demonstrations_.of(*best)) {
        best = part;
      }
    }
    assert(best);
    return {*best};
  }

  // Goes where the plan leads; what remains is to be shown of its end.
  std::optional<Claim> walk(const RunPlan& plan) {
    if (plan.shape == RunPlan::Shape::Next) return step_to(plan.target);
    const std::size_t first = last();
    const StateSet hold = checker_.where(plan.hold);
    const bool is_reached = plan.shape != RunPlan::Shape::Always &&
                            reach(hold, target_of(plan.target));
    if (!is_reached) circle(hold);
    // The target itself need not hold what leads up to it.
    const std::size_t end_of_hold = is_reached ? last() : last() + 1;
    for (const Claim claim : plan.hold) {
      if (demonstrations_.of(claim) == Demonstration::State) continue;
      if (first < end_of_hold) leave_unshown(claim, first, end_of_hold - 1);
    }
    return is_reached ? about_runs(plan.target) : std::nullopt;
  }

  // Finite paths end where a fair run goes on.
  StateSet target_of(const std::vector<Claim>& target) const {
    return checker_.where(target) & checker_.runs().starts();
  }

  std::optional<Claim> step_to(const std::vector<Claim>& target) {
    const StateSet states = target_of(target);
    const auto arcs = checker_.runs().graph().arcs(index(end()));
    const auto arc =
        std::ranges::find_if(arcs, [&](Arc a) { return states[a.target()]; });
    assert(arc != arcs.end());
    path_.states.push_back(StateId{arc->target()});
    return about_runs(target);
  }

  // Whether the path could be continued through `hold` into `goal`.
  bool reach(const StateSet& hold, const StateSet& goal) {
    const std::vector<StateId> leg =
        checker_.runs().graph().shortest_path(end(), hold, goal);
    if (leg.empty()) return false;
    append(leg);
    return true;
  }

  // Continues the path with a fair run that stays in `hold`.
  void circle(const StateSet& hold) {
    const StateSet fair = fair_components(checker_.runs().graph(), hold,
                                          checker_.runs().conditions());
    [[maybe_unused]] const bool is_reached = reach(hold, fair);
    assert(is_reached);
    path_.loop = last();
    append(fair_cycle(checker_.runs().graph(), fair, end(),
                      checker_.runs().conditions()));
  }

  void append(const std::vector<StateId>& leg) {
    assert(leg.front() == end());
    path_.states.insert(path_.states.end(), std::next(leg.begin()), leg.end());
  }

  CtlChecker& checker_;
  const FormulaPool& formulas_;
  Demonstrations demonstrations_;
  GraphPath path_;
};

}  // namespace

std::optional<GraphPath> demonstrate(CtlChecker& checker, Claim claim,
                                     StateId state) {
  if (!checker.is_true(claim, state)) return std::nullopt;
  return PathMaker(checker, claim.formula, state).make(claim);
}

}  // namespace btcheck
