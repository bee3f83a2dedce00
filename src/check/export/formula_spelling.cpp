// SPDX-License-Identifier: MIT
//
// Formulas as other model checkers write them. Operands come before operators
// in a pool, so one pass makes all texts, and nothing recurses. Each operator
// gets its parentheses: how tightly operators bind is where tools differ.
#include "check/export/formula_spelling.hpp"

#include <fmt/format.h>

#include <cassert>
#include <map>

namespace btcheck {
namespace {

using Texts = std::map<FormulaId, std::string>;
constexpr std::size_t kLongest = 200'000;  // characters

std::string_view sign_of(FormulaKind kind, const LinearSigns& signs) {
  switch (kind) {
    case FormulaKind::Not:
      return signs.negation;
    case FormulaKind::Always:
      return signs.always;
    case FormulaKind::Eventually:
      return signs.eventually;
    case FormulaKind::Next:
      return signs.next;
    case FormulaKind::And:
      return signs.conjunction;
    case FormulaKind::Or:
      return signs.disjunction;
    case FormulaKind::Implies:
      return signs.implication;
    case FormulaKind::Equivalent:
      return signs.equivalence;
    case FormulaKind::Until:
      return signs.until;
    case FormulaKind::Release:
      return signs.release;
    default:
      assert(false && "an operator of linear time");
      return {};
  }
}

// Without the parentheses around all of it.
std::string opened(const FormulaNode& node, std::string text) {
  return is_leaf(node.kind) ? text : text.substr(1, text.size() - 2);
}

// A part without path quantifiers around it; the operands are known.
std::string linear_part(const FormulaNode& node, const Texts& texts,
                        const LinearSigns& signs) {
  if (node.kind == FormulaKind::Atom) return fmt::format("p{}", node.atom);
  if (node.kind == FormulaKind::True) return std::string(signs.truth);
  if (node.kind == FormulaKind::False) return std::string(signs.falsehood);
  const std::string& left = texts.at(node.left);
  if (is_unary(node.kind)) {
    return fmt::format("({}{})", sign_of(node.kind, signs), left);
  }
  const std::string& right = texts.at(node.right);
  if (node.kind == FormulaKind::WeakUntil) {
    return fmt::format("({1} {2} ({0} {3} {1}))", left, right, signs.release,
                       signs.disjunction);
  }
  if (node.kind == FormulaKind::Equivalent && signs.equivalence.empty()) {
    return fmt::format("(({0} {2} {1}) {3} ({1} {2} {0}))", left, right,
                       signs.implication, signs.conjunction);
  }
  return fmt::format("({} {} {})", left, sign_of(node.kind, signs), right);
}

// E or A before the operator of a path.
std::string quantified(char letter, const FormulaNode& path,
                       const Texts& texts) {
  const std::string& left = texts.at(path.left);
  if (is_unary(path.kind)) {
    const char sign = path.kind == FormulaKind::Always       ? 'G'
                      : path.kind == FormulaKind::Eventually ? 'F'
                                                             : 'X';
    return fmt::format("({}{} {})", letter, sign, left);
  }
  const std::string& right = texts.at(path.right);
  if (path.kind == FormulaKind::Until) {
    return fmt::format("{} [{} U {}]", letter, left, right);
  }
  // By duality: A (a R b) is not E (not a U not b), and E likewise.
  const char dual = letter == 'A' ? 'E' : 'A';
  if (path.kind == FormulaKind::Release) {
    return fmt::format("(!{} [(!{}) U (!{})])", dual, left, right);
  }
  return fmt::format("(!{0} [(!{2}) U ((!{1}) & (!{2}))])", dual, left, right);
}

}  // namespace

std::string linear_spelling(const FormulaPool& pool, FormulaId formula,
                            const LinearSigns& signs) {
  Texts texts;
  for (const FormulaId part : pool.nodes(formula)) {
    texts[part] = linear_part(pool[part], texts, signs);
    if (texts[part].size() > kLongest) return {};
  }
  return opened(pool[formula], texts.at(formula));
}

std::string smv_branching_spelling(const FormulaPool& pool, FormulaId formula) {
  Texts texts;
  for (const FormulaId part : pool.nodes(formula)) {
    const FormulaNode& node = pool[part];
    if (is_path_operator(node.kind)) continue;  // its quantifier writes it
    texts[part] =
        is_path_quantifier(node.kind)
            ? quantified(node.kind == FormulaKind::ExistsPath ? 'E' : 'A',
                         pool[node.left], texts)
            : linear_part(node, texts, kSmvSigns);
    if (texts[part].size() > kLongest) return {};
  }
  return texts.at(formula);
}

}  // namespace btcheck
