// SPDX-License-Identifier: MIT
//
// Formulas of linear and branching time over numbered atoms, each stored once.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace btcheck {

enum class FormulaKind : std::uint8_t {
  True,
  False,
  Atom,
  Not,
  And,
  Or,
  Implies,
  Equivalent,
  Next,
  Eventually,
  Always,
  Until,
  WeakUntil,
  Release,
  ExistsPath,  // E: on some run from here; branching time only
  ForAllPaths  // A: on every run from here
};

constexpr bool is_leaf(FormulaKind kind) {
  return kind == FormulaKind::True || kind == FormulaKind::False ||
         kind == FormulaKind::Atom;
}
constexpr bool is_path_quantifier(FormulaKind kind) {
  return kind == FormulaKind::ExistsPath || kind == FormulaKind::ForAllPaths;
}
constexpr bool is_unary(FormulaKind kind) {
  return kind == FormulaKind::Not || kind == FormulaKind::Next ||
         kind == FormulaKind::Eventually || kind == FormulaKind::Always ||
         is_path_quantifier(kind);
}
// Its truth depends on more than one state.
constexpr bool is_temporal(FormulaKind kind) {
  return kind >= FormulaKind::Next;
}
// X, F, G, U, W, R: what a path quantifier may stand in front of.
constexpr bool is_path_operator(FormulaKind kind) {
  return is_temporal(kind) && !is_path_quantifier(kind);
}
// not (a U b) = (not a) R (not b), and so on; operators without a dual of their
// own are returned as they are. The dual of W is U on other operands.
constexpr FormulaKind dual(FormulaKind kind) {
  switch (kind) {
    case FormulaKind::And:
      return FormulaKind::Or;
    case FormulaKind::Or:
      return FormulaKind::And;
    case FormulaKind::Eventually:
      return FormulaKind::Always;
    case FormulaKind::Always:
      return FormulaKind::Eventually;
    case FormulaKind::Until:
      return FormulaKind::Release;
    case FormulaKind::Release:
      return FormulaKind::Until;
    default:
      return kind;
  }
}

enum class FormulaId : std::uint32_t {};
constexpr std::uint32_t index(FormulaId id) {
  return static_cast<std::uint32_t>(id);
}

struct FormulaNode {
  FormulaKind kind = FormulaKind::True;
  std::uint32_t atom = 0;  // Atom only
  FormulaId left{};        // the operand of a unary operator
  FormulaId right{};

  friend bool operator==(const FormulaNode&, const FormulaNode&) = default;
};

// Owns formulas. Equal formulas have equal ids, and an operand's id is always
// smaller than its operator's: a loop over ids visits operands first, so
// nothing needs to recurse.
class FormulaPool {
 public:
  FormulaPool();

  FormulaId constant(bool value) const { return FormulaId{value ? 0u : 1u}; }
  FormulaId atom(std::uint32_t number);
  // Nothing is simplified: `not not a` stays as it is.
  FormulaId unary(FormulaKind kind, FormulaId of);
  FormulaId binary(FormulaKind kind, FormulaId left, FormulaId right);

  const FormulaNode& operator[](FormulaId id) const {
    return nodes_[index(id)];
  }
  std::size_t size() const { return nodes_.size(); }

  // The nodes of a formula, each once, operands before operators.
  std::vector<FormulaId> nodes(FormulaId id) const;

  // No temporal operator occurs in it.
  bool is_state_formula(FormulaId id) const;
  // A path quantifier occurs in it: CTL, not LTL.
  bool is_branching(FormulaId id) const;
  // Next occurs in it.
  bool has_next(FormulaId id) const;
  // The atoms that occur in it, ascending.
  std::vector<std::uint32_t> atoms(FormulaId id) const;

  // Text such as `[] (a => <> b)`, with as few parentheses as make every tool
  // of the field read it in the same way.
  std::string text(FormulaId id,
                   const std::function<std::string(std::uint32_t)>& atom) const;

 private:
  FormulaId intern(FormulaNode node);
  void grow();

  std::vector<FormulaNode> nodes_;
  std::vector<std::uint32_t> slots_;  // open addressing over nodes_
};

// The first subformula, as the formula is read, that makes it something else
// than CTL, if there is one: a temporal operator without a path quantifier
// directly above it, or a quantifier without a temporal operator directly
// below it (Clarke and Emerson 1981).
std::optional<FormulaId> first_non_ctl(const FormulaPool& formulas,
                                       FormulaId formula);

enum class Polarity : std::uint8_t { None, Positive, Negative, Both };

// How each part stands in the whole, by id: under an even number of negations,
// an odd one, or both; None for what does not occur in it.
std::vector<Polarity> polarities(const FormulaPool& pool, FormulaId whole);

}  // namespace btcheck
