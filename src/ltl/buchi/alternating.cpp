// SPDX-License-Identifier: MIT
//
// The very weak alternating automaton, from the leaves of the formula up.
#include "ltl/buchi/alternating.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace btcheck {

namespace {

bool is_implied_by(const Obligations& one, const Obligations& other) {
  return is_subset(other, one);
}

bool can_be(const Obligations&) { return true; }

Obligations conjunction_of(const Obligations& left, const Obligations& right) {
  return union_of(left, right);
}

// Adds one unless another implies it.
template <class T>
void keep(std::vector<T>& kept, T one) {
  keep_weakest(kept, std::move(one), [](const T& other, const T& added) {
    return is_implied_by(added, other);
  });
}

// Removes what another element implies.
template <class T>
void simplify(std::vector<T>& all) {
  std::vector<T> kept;
  for (T& one : all) keep(kept, std::move(one));
  all = std::move(kept);
}

// Of each list one at a time, without those that another implies. When there
// are too many, more than kMostTransitions, and not all.
template <class T>
std::vector<T> conjunction_of(const std::vector<T>& left,
                              const std::vector<T>& right) {
  std::vector<T> all;
  for (const T& l : left) {
    for (const T& r : right) {
      T both = conjunction_of(l, r);
      if (can_be(both)) keep(all, std::move(both));
    }
    if (all.size() > AlternatingAutomaton::kMostTransitions) break;
  }
  return all;
}

template <class T>
std::vector<T> concatenation(std::vector<T> left, const std::vector<T>& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

// A formula in negation normal form as a disjunction of sets of states.
std::vector<Obligations> ways_of(
    const FormulaPool& pool, FormulaId id,
    const std::vector<std::vector<Obligations>>& ways) {
  const FormulaNode& node = pool[id];
  const auto& left = ways[index(node.left)];
  const auto& right = ways[index(node.right)];
  switch (node.kind) {
    case FormulaKind::True:
      return {Obligations{}};
    case FormulaKind::False:
      return {};
    case FormulaKind::And:
      return conjunction_of(left, right);
    case FormulaKind::Or:
      return concatenation(left, right);
    default:
      return {Obligations{id}};
  }
}

}  // namespace

Obligations union_of(const Obligations& left, const Obligations& right) {
  Obligations all;
  std::set_union(left.begin(), left.end(), right.begin(), right.end(),
                 std::back_inserter(all));
  return all;
}

bool is_subset(const Obligations& inner, const Obligations& outer) {
  return std::includes(outer.begin(), outer.end(), inner.begin(), inner.end());
}

AlternatingTransition conjunction_of(const AlternatingTransition& left,
                                     const AlternatingTransition& right) {
  return {left.present | right.present, left.absent | right.absent,
          union_of(left.next, right.next)};
}

std::optional<AlternatingAutomaton> AlternatingAutomaton::of(
    const FormulaPool& pool, FormulaId root,
    std::span<const int> proposition_of) {
  AlternatingAutomaton automaton;
  automaton.transitions_.resize(index(root) + 1);
  automaton.ways_.resize(index(root) + 1);
  for (const FormulaId id : pool.nodes(root)) {
    auto& ways = automaton.ways_[index(id)];
    auto& transitions = automaton.transitions_[index(id)];
    ways = ways_of(pool, id, automaton.ways_);
    if (ways.size() > kMostTransitions) return std::nullopt;
    simplify(ways);
    transitions = automaton.transitions_of(pool, id, proposition_of);
    if (transitions.size() > kMostTransitions) return std::nullopt;
    simplify(transitions);
  }
  automaton.initial_ = automaton.ways_[index(root)];
  automaton.collect_untils(pool);
  return automaton;
}

AlternatingTransitions AlternatingAutomaton::transitions_of(
    const FormulaPool& pool, FormulaId id,
    std::span<const int> proposition_of) {
  const FormulaNode& node = pool[id];
  const AlternatingTransitions& left = transitions_[index(node.left)];
  const AlternatingTransitions& right = transitions_[index(node.right)];
  const AlternatingTransitions stay = {{0, 0, {id}}};
  const auto bit = [&](FormulaId atom) {
    return PropositionSet{1} << proposition_of[pool[atom].atom];
  };
  switch (node.kind) {
    case FormulaKind::True:
      return {{}};
    case FormulaKind::False:
      return {};
    case FormulaKind::Atom:
      return {{bit(id), 0, {}}};
    case FormulaKind::Not:
      return {{0, bit(node.left), {}}};
    case FormulaKind::And:
      return conjunction_of(left, right);
    case FormulaKind::Or:
      return concatenation(left, right);
    case FormulaKind::Until:
      return concatenation(right, conjunction_of(left, stay));
    case FormulaKind::Release:
      return conjunction_of(right, concatenation(left, stay));
    default:
      break;
  }
  assert(node.kind == FormulaKind::Next);
  AlternatingTransitions all;
  for (const Obligations& way : ways_[index(node.left)]) {
    all.push_back({0, 0, way});
  }
  return all;
}

void AlternatingAutomaton::collect_untils(const FormulaPool& pool) {
  const auto collect = [&](const Obligations& states) {
    for (const FormulaId state : states) {
      if (pool[state].kind == FormulaKind::Until) untils_.push_back(state);
    }
  };
  for (const Obligations& way : initial_) collect(way);
  for (const AlternatingTransitions& transitions : transitions_) {
    for (const auto& transition : transitions) collect(transition.next);
  }
  std::sort(untils_.begin(), untils_.end());
  untils_.erase(std::unique(untils_.begin(), untils_.end()), untils_.end());
}

}  // namespace btcheck
