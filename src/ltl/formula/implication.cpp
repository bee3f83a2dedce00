// SPDX-License-Identifier: MIT
//
// NormalPool: which formulas imply which, by the rules of syntactic
// implication.
#include <cassert>

#include "ltl/formula/normal_form.hpp"

namespace btcheck {
namespace {

// The laws for a formula on the left, `node implies other`: `implies` compares
// a part of it with the other side, of which `is_eventual` is known. For one on
// the right they hold with `kind` its dual and universal for eventual.
template <class Implies>
bool derives_from_parts(FormulaKind kind, const FormulaNode& node,
                        bool is_eventual, Implies implies) {
  switch (kind) {
    case FormulaKind::And:
      return implies(node.left) || implies(node.right);
    case FormulaKind::Or:
      return implies(node.left) && implies(node.right);
    case FormulaKind::Next:
      return is_eventual && implies(node.left);
    case FormulaKind::Until:
      return implies(node.right) && (is_eventual || implies(node.left));
    case FormulaKind::Release:
      return implies(node.right);
    default:
      return false;
  }
}

}  // namespace

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
  const FormulaNode& from = pool_[left];
  const FormulaNode& to = pool_[right];
  return derives_from_parts(
             from.kind, from, is_eventual(right),
             [&](FormulaId part) { return implies(part, right); }) ||
         derives_from_parts(
             dual(to.kind), to, is_universal(left),
             [&](FormulaId part) { return implies(left, part); }) ||
         derives_from_both(from, to);
}

bool NormalPool::derives_from_both(const FormulaNode& from,
                                   const FormulaNode& to) const {
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
