// SPDX-License-Identifier: MIT
//
// Formulas of linear and branching time over numbered atoms, each stored once.
#pragma once

#include <cstdint>
#include <functional>
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
// It speaks of more than one state.
constexpr bool is_temporal(FormulaKind kind) {
  return kind >= FormulaKind::Next;
}
// X, F, G, U, W, R: what a path quantifier may stand in front of.
constexpr bool is_path_operator(FormulaKind kind) {
  return is_temporal(kind) && !is_path_quantifier(kind);
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
  // No simplification beyond sharing: what is written is what is kept.
  FormulaId unary(FormulaKind kind, FormulaId of);
  FormulaId binary(FormulaKind kind, FormulaId left, FormulaId right);

  const FormulaNode& operator[](FormulaId id) const {
    return nodes_[index(id)];
  }
  std::size_t size() const { return nodes_.size(); }

  // The nodes of a formula, each once, operands before operators.
  std::vector<FormulaId> nodes(FormulaId id) const;

  // True when no temporal operator occurs in it.
  bool is_state_formula(FormulaId id) const;
  // True when a path quantifier occurs in it: CTL, not LTL.
  bool is_branching(FormulaId id) const;
  // True when Next occurs in it.
  bool has_next(FormulaId id) const;
  // The atoms that occur in it, ascending.
  std::vector<std::uint32_t> atoms(FormulaId id) const;

  // Fully determined text, `[] (a => <> b)`, with the fewest parentheses that
  // no tool of the field reads in another way.
  std::string text(FormulaId id,
                   const std::function<std::string(std::uint32_t)>& atom) const;

 private:
  FormulaId intern(FormulaNode node);
  void grow();

  std::vector<FormulaNode> nodes_;
  std::vector<std::uint32_t> slots_;  // open addressing over nodes_
};

}  // namespace btcheck
