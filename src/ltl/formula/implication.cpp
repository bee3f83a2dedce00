// SPDX-License-Identifier: MIT
//
// The rules of syntactic implication.
#include "ltl/formula/implication.hpp"

#include <cassert>

#include "ltl/formula/duality.hpp"

namespace btcheck {

NormalPool::NormalPool() {
  facts_.resize(2);
  add(constant(true), constant(false));
  add(constant(false), constant(true));
}

FormulaId NormalPool::atom(std::uint32_t number) {
  const FormulaId positive = pool_.atom(number);
  if (index(positive) < facts_.size()) return positive;
  const FormulaId negative = pool_.unary(FormulaKind::Not, positive);
  facts_.resize(pool_.size());
  add(positive, negative);
  add(negative, positive);
  return positive;
}

FormulaId NormalPool::make(FormulaKind kind, FormulaId left, FormulaId right) {
  const bool is_next = kind == FormulaKind::Next;
  const auto stored = [&](FormulaKind of, FormulaId l, FormulaId r) {
    return is_next ? pool_.unary(of, l) : pool_.binary(of, l, r);
  };
  const FormulaId id = stored(kind, left, right);
  if (index(id) < facts_.size()) return id;
  const FormulaId negated_left = negation(left);
  const FormulaId negated_right = is_next ? FormulaId{} : negation(right);
  const FormulaId other = stored(dual(kind), negated_left, negated_right);
  assert(index(other) == index(id) + 1);
  facts_.resize(pool_.size());
  add(id, other);
  add(other, id);
  return id;
}

void NormalPool::add(FormulaId id, FormulaId negation) {
  facts_[index(id)] = facts_of(id, negation);
  if (implied_.size() == index(id) && implied_.size() < kMostCompared) {
    compare_with_earlier(id);
  }
}

NormalPool::Facts NormalPool::facts_of(FormulaId id, FormulaId negation) const {
  const FormulaNode& node = pool_[id];
  const Facts& left = facts_[index(node.left)];
  const Facts& right = facts_[index(node.right)];
  switch (node.kind) {
    case FormulaKind::True:
    case FormulaKind::False:
      return {negation, true, true};
    case FormulaKind::Next:
      return {negation, left.eventual, left.universal};
    case FormulaKind::And:
    case FormulaKind::Or:
      return {negation, left.eventual && right.eventual,
              left.universal && right.universal};
    case FormulaKind::Until:
      return {negation, node.left == constant(true) || right.eventual,
              right.universal};
    case FormulaKind::Release:
      return {negation, right.eventual,
              node.left == constant(false) || right.universal};
    default:
      return {negation, false, false};
  }
}

bool NormalPool::implies(FormulaId left, FormulaId right) const {
  if (left == right) return true;
  if (index(left) >= implied_.size() || index(right) >= implied_.size()) {
    return left == constant(false) || right == constant(true);
  }
  return implied_[index(left)][index(right)];
}

void NormalPool::compare_with_earlier(FormulaId id) {
  const std::uint32_t number = index(id);
  implied_.emplace_back(number + 1);
  implied_[number][number] = true;
  for (std::uint32_t i = 0; i < number; ++i) {
    const FormulaId other{i};
    implied_[number][i] = derives(id, other);
    // One more entry in the row of `other`: each row has as many as there
    // are formulas.
    const bool is_implied = derives(other, id);
    implied_[i].push_back(is_implied);
  }
}

bool NormalPool::derives(FormulaId left, FormulaId right) const {
  if (left == constant(false) || right == constant(true)) return true;
  if (left == constant(true) || right == constant(false)) return false;
  return derives_from_left(left, right) || derives_from_right(left, right) ||
         derives_from_both(left, right);
}

bool NormalPool::derives_from_left(FormulaId left, FormulaId right) const {
  const FormulaNode& node = pool_[left];
  switch (node.kind) {
    case FormulaKind::And:
      return implies(node.left, right) || implies(node.right, right);
    case FormulaKind::Or:
      return implies(node.left, right) && implies(node.right, right);
    case FormulaKind::Next:
      return is_eventual(right) && implies(node.left, right);
    case FormulaKind::Until:
      return implies(node.right, right) &&
             (is_eventual(right) || implies(node.left, right));
    case FormulaKind::Release:
      return implies(node.right, right);
    default:
      return false;
  }
}

bool NormalPool::derives_from_right(FormulaId left, FormulaId right) const {
  const FormulaNode& node = pool_[right];
  switch (node.kind) {
    case FormulaKind::And:
      return implies(left, node.left) && implies(left, node.right);
    case FormulaKind::Or:
      return implies(left, node.left) || implies(left, node.right);
    case FormulaKind::Next:
      return is_universal(left) && implies(left, node.left);
    case FormulaKind::Until:
      return implies(left, node.right);
    case FormulaKind::Release:
      return implies(left, node.right) &&
             (is_universal(left) || implies(left, node.left));
    default:
      return false;
  }
}

bool NormalPool::derives_from_both(FormulaId left, FormulaId right) const {
  const FormulaNode& from = pool_[left];
  const FormulaNode& to = pool_[right];
  if (from.kind != to.kind) return false;
  switch (from.kind) {
    case FormulaKind::Next:
      return implies(from.left, to.left);
    case FormulaKind::Until:
    case FormulaKind::Release:
      return implies(from.left, to.left) && implies(from.right, to.right);
    default:
      return false;
  }
}

}  // namespace btcheck
