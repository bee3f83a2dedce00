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

// Removes what another element implies.
template <class T>
void simplify(std::vector<T>& all) {
  std::vector<T> kept;
  for (T& one : all) {
    keep_weakest(kept, std::move(one), [](const T& other, const T& added) {
      return is_implied_by(added, other);
    });
  }
  all = std::move(kept);
}

std::vector<Obligations> conjunction_of(const std::vector<Obligations>& left,
                                        const std::vector<Obligations>& right) {
  std::vector<Obligations> all;
  for (const Obligations& l : left) {
    for (const Obligations& r : right) all.push_back(union_of(l, r));
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

AlternatingTransitions conjunction_of(const AlternatingTransitions& left,
                                      const AlternatingTransitions& right) {
  AlternatingTransitions all;
  for (const AlternatingTransition& l : left) {
    for (const AlternatingTransition& r : right) {
      const PropositionSet present = l.present | r.present;
      const PropositionSet absent = l.absent | r.absent;
      if ((present & absent) != 0) continue;
      all.push_back({present, absent, union_of(l.next, r.next)});
    }
  }
  return all;
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
