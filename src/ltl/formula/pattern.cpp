// SPDX-License-Identifier: MIT
//
// The catalogue's table, by construction: what a pattern means on the whole
// rest of a run, what it means up to a closing R, and how a scope uses the two.
// Only the rows of existence and precedence after Q do not follow from the
// others: the catalogue asks them of one Q and not of each.
#include "ltl/formula/pattern.hpp"

namespace btcheck {
namespace {

class Table {
 public:
  Table(FormulaPool& pool, Pattern pattern, FormulaId p, FormulaId q)
      : pool_(pool), pattern_(pattern), p_(p), q_(q) {}

  FormulaId in(const Scope& scope) {
    const FormulaId opening = scope.opening;
    const FormulaId closing = scope.closing;
    switch (scope.kind) {
      case ScopeKind::Globally:
        break;
      case ScopeKind::Before:
        return pattern_ == Pattern::Existence
                   ? up_to(closing, FormulaKind::Until)
                   : implies(eventually(closing),
                             up_to(closing, FormulaKind::Until));
      case ScopeKind::After:
        return after(opening);
      case ScopeKind::Between:
        return always(implies(
            pattern_ == Pattern::Existence
                ? both(opening, negation(closing))
                : both(both(opening, negation(closing)), eventually(closing)),
            up_to(closing, FormulaKind::Until)));
      case ScopeKind::AfterUntil:
        return always(implies(both(opening, negation(closing)),
                              up_to(closing, FormulaKind::WeakUntil)));
    }
    return from_here_on();
  }

 private:
  FormulaId from_here_on() {
    switch (pattern_) {
      case Pattern::Absence:
        return always(negation(p_));
      case Pattern::Universality:
        return always(p_);
      case Pattern::Existence:
        return eventually(p_);
      case Pattern::Response:
        return always(implies(p_, eventually(q_)));
      case Pattern::Precedence:
        break;
      case Pattern::Exclusion:
        return always(implies(p_, always(negation(q_))));
    }
    return pool_.binary(FormulaKind::WeakUntil, negation(q_), p_);
  }

  // Up to R. With Until R is known to come, or need not; with WeakUntil the
  // pattern must hold also if it never does.
  FormulaId up_to(FormulaId r, FormulaKind until) {
    const FormulaId no_r = negation(r);
    const auto holds_until = [&](FormulaId what, FormulaId end) {
      return pool_.binary(until, what, end);
    };
    switch (pattern_) {
      case Pattern::Absence:
        return holds_until(negation(p_), r);
      case Pattern::Universality:
        return holds_until(p_, r);
      case Pattern::Existence:  // the other way round: R waits for P
        return pool_.binary(until == FormulaKind::Until ? FormulaKind::WeakUntil
                                                        : FormulaKind::Until,
                            no_r, both(p_, no_r));
      case Pattern::Response:
        return holds_until(
            implies(p_, pool_.binary(FormulaKind::Until, no_r, both(q_, no_r))),
            r);
      case Pattern::Precedence:
        break;
      case Pattern::Exclusion:
        return holds_until(implies(p_, holds_until(negation(q_), r)), r);
    }
    return holds_until(negation(q_), pool_.binary(FormulaKind::Or, p_, r));
  }

  FormulaId after(FormulaId opening) {
    const bool asks_of_one =
        pattern_ == Pattern::Existence || pattern_ == Pattern::Precedence;
    if (!asks_of_one) return always(implies(opening, from_here_on()));
    return pool_.binary(FormulaKind::Or, always(negation(opening)),
                        eventually(both(opening, from_here_on())));
  }

  FormulaId negation(FormulaId of) { return pool_.unary(FormulaKind::Not, of); }
  FormulaId always(FormulaId of) {
    return pool_.unary(FormulaKind::Always, of);
  }
  FormulaId eventually(FormulaId of) {
    return pool_.unary(FormulaKind::Eventually, of);
  }
  FormulaId both(FormulaId left, FormulaId right) {
    return pool_.binary(FormulaKind::And, left, right);
  }
  FormulaId implies(FormulaId left, FormulaId right) {
    return pool_.binary(FormulaKind::Implies, left, right);
  }

  FormulaPool& pool_;
  Pattern pattern_;
  FormulaId p_;
  FormulaId q_;
};

}  // namespace

FormulaId pattern_formula(FormulaPool& pool, Pattern pattern, FormulaId p,
                          FormulaId q, const Scope& scope) {
  return Table(pool, pattern, p, q).in(scope);
}

}  // namespace btcheck
