// SPDX-License-Identifier: MIT
//
// Thirty formulas as the catalogue of Dwyer, Avrunin and Corbett prints them,
// with its Q called a, and each row on its own: nothing is composed of parts.
// Exclusion, which it lacks, is response with `not q for the rest of the
// scope` in the place of `q some time in it`.
#include "reference/pattern_catalogue.hpp"

#include <array>

namespace btcheck::reference {

namespace {

// A formula that reads as one.
struct Operand {
  FormulaPool& pool;
  FormulaId id;

  Operand unary(FormulaKind kind) const { return {pool, pool.unary(kind, id)}; }
  Operand binary(FormulaKind kind, Operand right) const {
    return {pool, pool.binary(kind, id, right.id)};
  }
};
Operand operator!(Operand of) { return of.unary(FormulaKind::Not); }
Operand operator&(Operand l, Operand r) {
  return l.binary(FormulaKind::And, r);
}
Operand operator|(Operand l, Operand r) { return l.binary(FormulaKind::Or, r); }
Operand operator>>(Operand l, Operand r) {
  return l.binary(FormulaKind::Implies, r);
}
Operand G(Operand of) { return of.unary(FormulaKind::Always); }
Operand F(Operand of) { return of.unary(FormulaKind::Eventually); }
Operand U(Operand l, Operand r) { return l.binary(FormulaKind::Until, r); }
Operand W(Operand l, Operand r) { return l.binary(FormulaKind::WeakUntil, r); }

// By scope: globally, before r, after a, between a and r, after a until r.
using Rows = std::array<Operand, 5>;

Rows absence(Operand p, Operand a, Operand r) {
  return {G(!p), F(r) >> U(!p, r), G(a >> G(!p)),
          G((a & !r & F(r)) >> U(!p, r)), G((a & !r) >> W(!p, r))};
}

Rows universality(Operand p, Operand a, Operand r) {
  return {G(p), F(r) >> U(p, r), G(a >> G(p)), G((a & !r & F(r)) >> U(p, r)),
          G((a & !r) >> W(p, r))};
}

Rows existence(Operand p, Operand a, Operand r) {
  return {F(p), W(!r, p & !r), G(!a) | F(a & F(p)),
          G((a & !r) >> W(!r, p & !r)), G((a & !r) >> U(!r, p & !r))};
}

// q responds to p.
Rows response(Operand p, Operand q, Operand a, Operand r) {
  return {G(p >> F(q)), F(r) >> U(p >> U(!r, q & !r), r), G(a >> G(p >> F(q))),
          G((a & !r & F(r)) >> U(p >> U(!r, q & !r), r)),
          G((a & !r) >> W(p >> U(!r, q & !r), r))};
}

// p precedes q.
Rows precedence(Operand p, Operand q, Operand a, Operand r) {
  return {W(!q, p), F(r) >> U(!q, p | r), G(!a) | F(a & W(!q, p)),
          G((a & !r & F(r)) >> U(!q, p | r)), G((a & !r) >> W(!q, p | r))};
}

Rows exclusion(Operand p, Operand q, Operand a, Operand r) {
  return {G(p >> G(!q)), F(r) >> U(p >> U(!q, r), r), G(a >> G(p >> G(!q))),
          G((a & !r & F(r)) >> U(p >> U(!q, r), r)),
          G((a & !r) >> W(p >> W(!q, r), r))};
}

Rows rows(Pattern pattern, Operand p, Operand q, Operand a, Operand r) {
  switch (pattern) {
    case Pattern::Absence:
      return absence(p, a, r);
    case Pattern::Universality:
      return universality(p, a, r);
    case Pattern::Existence:
      return existence(p, a, r);
    case Pattern::Response:
      return response(p, q, a, r);
    case Pattern::Precedence:
      return precedence(p, q, a, r);
    case Pattern::Exclusion:
      break;
  }
  return exclusion(p, q, a, r);
}

}  // namespace

FormulaId catalogued(FormulaPool& pool, Pattern pattern, ScopeKind scope,
                     FormulaId p, FormulaId q, FormulaId a, FormulaId r) {
  const Rows table = rows(pattern, {pool, p}, {pool, q}, {pool, a}, {pool, r});
  switch (scope) {
    case ScopeKind::Globally:
      return table[0].id;
    case ScopeKind::Before:
      return table[1].id;
    case ScopeKind::After:
      return table[2].id;
    case ScopeKind::Between:
      return table[3].id;
    case ScopeKind::AfterUntil:
      break;
  }
  return table[4].id;
}

}  // namespace btcheck::reference
