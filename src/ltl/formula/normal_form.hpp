// SPDX-License-Identifier: MIT
//
// Negation normal form, which formulas in it imply which, and the rewriting
// that makes them small.
#pragma once

#include <vector>

#include "ltl/formula/formula.hpp"

namespace btcheck {

// An equivalent formula of True, False, literals, And, Or, Next, Until and
// Release alone; a negation stands in front of atoms only. Eventually is
// written `true U a` and Always `false R a`. Linear in the formula as a graph.
FormulaId negation_normal_form(FormulaPool& pool, FormulaId id);

// An equivalent formula in negation normal form, made small by rewriting.
FormulaId simplify(FormulaPool& pool, FormulaId id);

// Formulas in negation normal form, for rewriting.
//
// Every formula is stored together with its negation, so negating is a look-up
// and each law of rewriting is written only once: the other half follows by
// duality. Implication is syntactic, by the rules of Somenzi and Bloem
// ("Efficient Büchi automata from LTL formulae", CAV 2000): sound, far from
// complete. It is a table that grows with each formula; since operands come
// first, each entry needs only earlier ones. Beyond kMostCompared formulas the
// table does not grow, and a formula implies only itself.
class NormalPool {
 public:
  NormalPool();

  FormulaId constant(bool value) const { return pool_.constant(value); }
  FormulaId atom(std::uint32_t number);
  // As written, without rewriting. `kind` is Next, And, Or, Until or Release;
  // `right` is ignored for Next.
  FormulaId make(FormulaKind kind, FormulaId left, FormulaId right);

  const FormulaNode& operator[](FormulaId id) const { return pool_[id]; }
  std::vector<FormulaId> nodes(FormulaId id) const { return pool_.nodes(id); }
  FormulaId negation(FormulaId id) const { return facts_[index(id)].negation; }

  // If true of a suffix of a word, then true of the word.
  bool is_eventual(FormulaId id) const { return facts_[index(id)].eventual; }
  // If true of a word, then true of its suffixes.
  bool is_universal(FormulaId id) const { return facts_[index(id)].universal; }
  // Both: true of all suffixes of a word or of none, as `[] <> a`.
  bool is_suspendable(FormulaId id) const {
    return is_eventual(id) && is_universal(id);
  }

  // True only if every word of `left` is one of `right`.
  bool implies(FormulaId left, FormulaId right) const;

 private:
  // What is known of a formula (Etessami and Holzmann, CONCUR 2000).
  struct Facts {
    FormulaId negation{};
    bool eventual = false;
    bool universal = false;
  };

  static constexpr std::size_t kMostCompared = 1500;

  void add(FormulaId id, FormulaId negation);
  Facts facts_of(FormulaId id, FormulaId negation) const;
  void compare_with_earlier(FormulaId id);
  bool derives(FormulaId left, FormulaId right) const;
  bool derives_from_both(const FormulaNode& from, const FormulaNode& to) const;

  FormulaPool pool_;
  std::vector<Facts> facts_;                // by formula
  std::vector<std::vector<bool>> implied_;  // by left, right
};

}  // namespace btcheck
