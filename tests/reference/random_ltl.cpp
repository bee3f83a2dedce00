// SPDX-License-Identifier: MIT
//
// Random formulas and words, and how a failing formula is made smaller.
#include "reference/random_ltl.hpp"

#include <optional>
#include <vector>

namespace btcheck::reference {

namespace {

constexpr FormulaKind kUnary[] = {FormulaKind::Not, FormulaKind::Next,
                                  FormulaKind::Eventually, FormulaKind::Always};
constexpr FormulaKind kBinary[] = {FormulaKind::And,       FormulaKind::Or,
                                   FormulaKind::Implies,   FormulaKind::Until,
                                   FormulaKind::WeakUntil, FormulaKind::Release,
                                   FormulaKind::Equivalent};

int below(std::mt19937& random, int bound) {
  return static_cast<int>(random() % static_cast<unsigned>(bound));
}

FormulaId rebuilt(FormulaPool& pool, const FormulaNode& node, FormulaId left,
                  FormulaId right) {
  return is_unary(node.kind) ? pool.unary(node.kind, left)
                             : pool.binary(node.kind, left, right);
}

// All formulas made from `id` by one smaller replacement somewhere.
std::vector<FormulaId> smaller(FormulaPool& pool, FormulaId id) {
  const FormulaNode node = pool[id];
  if (id == pool.constant(true) || id == pool.constant(false)) return {};
  std::vector<FormulaId> found{pool.constant(true), pool.constant(false)};
  if (is_leaf(node.kind)) return found;
  found.push_back(node.left);
  for (const FormulaId left : smaller(pool, node.left)) {
    found.push_back(rebuilt(pool, node, left, node.right));
  }
  if (is_unary(node.kind)) return found;
  found.push_back(node.right);
  for (const FormulaId right : smaller(pool, node.right)) {
    found.push_back(rebuilt(pool, node, node.left, right));
  }
  return found;
}

std::vector<PropositionSet> random_labels(std::mt19937& random,
                                          std::uint32_t atoms, int count) {
  std::vector<PropositionSet> labels;
  for (int i = 0; i < count; ++i) {
    labels.push_back(random() % (PropositionSet{1} << atoms));
  }
  return labels;
}

}  // namespace

FormulaId random_formula(FormulaPool& pool, std::mt19937& random, int size,
                         std::uint32_t atoms) {
  if (size <= 1) {
    return below(random, 16) == 0
               ? pool.constant(below(random, 2) == 0)
               : pool.atom(static_cast<std::uint32_t>(random() % atoms));
  }
  if (size == 2 || below(random, 3) == 0) {
    const FormulaKind kind = kUnary[below(random, std::size(kUnary))];
    return pool.unary(kind, random_formula(pool, random, size - 1, atoms));
  }
  const FormulaKind kind = kBinary[below(random, std::size(kBinary))];
  const int left_size = 1 + below(random, size - 2);
  const FormulaId left = random_formula(pool, random, left_size, atoms);
  const FormulaId right =
      random_formula(pool, random, size - 1 - left_size, atoms);
  return pool.binary(kind, left, right);
}

LassoWord random_word(std::mt19937& random, std::uint32_t atoms, int longest) {
  const int prefix = below(random, longest + 1);
  const int cycle = 1 + below(random, longest);
  LassoWord word;
  word.prefix = random_labels(random, atoms, prefix);
  word.cycle = random_labels(random, atoms, cycle);
  return word;
}

FormulaId shrunk(FormulaPool& pool, FormulaId id,
                 const std::function<bool(FormulaId)>& fails) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const FormulaId candidate : smaller(pool, id)) {
      if (!fails(candidate)) continue;
      id = candidate;
      changed = true;
      break;
    }
  }
  return id;
}

std::string shown(const FormulaPool& pool, FormulaId id) {
  return pool.text(id, [](std::uint32_t atom) {
    return std::string(1, static_cast<char>('a' + atom));
  });
}

}  // namespace btcheck::reference
