// SPDX-License-Identifier: MIT
//
// What holds no temporal operator becomes a single predicate: the automaton of
// a formula sees `battery = Critical and measure_battery.done` as one
// proposition, which keeps it small. Operands are visited before operators
// (FormulaPool), so nothing recurses.
#include <algorithm>
#include <cassert>
#include <map>

#include "check/bind/bind.hpp"

namespace btcheck {
namespace {

const Expression& when_dead(const StatePredicate& predicate) {
  return predicate.when_dead ? *predicate.when_dead : predicate.expression;
}

// The operator applied to predicates, in live and in dead states alike.
StatePredicate combined(FormulaKind kind, const StatePredicate& left,
                        const StatePredicate& right) {
  auto apply_to = [kind](const Expression& a, const Expression& b) {
    switch (kind) {
      case FormulaKind::Not:
        return Expression::unary(Operation::Not, a);
      case FormulaKind::And:
        return both(a, b);
      case FormulaKind::Implies:
        return Expression::binary(Operation::Or,
                                  Expression::unary(Operation::Not, a), b);
      case FormulaKind::Or:
        return Expression::binary(Operation::Or, a, b);
      default:
        assert(kind == FormulaKind::Equivalent);
        return Expression::binary(Operation::Equal, a, b);
    }
  };
  StatePredicate result{apply_to(left.expression, right.expression), {}};
  if (left.when_dead || right.when_dead) {
    result.when_dead = apply_to(when_dead(left), when_dead(right));
  }
  return result;
}

StatePredicate opposite(const StatePredicate& of) {
  return combined(FormulaKind::Not, of, of);
}

// The operator in Kleene's logic.
DefinitePredicates combined(FormulaKind kind, const DefinitePredicates& left,
                            const DefinitePredicates& right) {
  switch (kind) {
    case FormulaKind::Not:
      return {opposite(left.may_hold), opposite(left.holds)};
    case FormulaKind::Implies:
      return {combined(kind, left.may_hold, right.holds),
              combined(kind, left.holds, right.may_hold)};
    case FormulaKind::Equivalent: {
      const auto there = combined(FormulaKind::Implies, left, right);
      const auto back = combined(FormulaKind::Implies, right, left);
      return combined(FormulaKind::And, there, back);
    }
    default:
      return {combined(kind, left.holds, right.holds),
              combined(kind, left.may_hold, right.may_hold)};
  }
}

std::size_t size_of(const StatePredicate& predicate) {
  return predicate.expression.terms().size() +
         (predicate.when_dead ? predicate.when_dead->terms().size() : 0);
}

// Replaces the greatest parts without temporal operators by propositions.
class Abstraction {
 public:
  Abstraction(const FormulaPool& formulas,
              const std::vector<Proposition>& atoms)
      : formulas_(formulas), atoms_(atoms) {}

  std::optional<BoundFormula> run(FormulaId formula) {
    for (const FormulaId part : formulas_.nodes(formula)) {
      if (is_proposition(part)) continue;
      const FormulaNode& node = formulas_[part];
      const auto left = image(node.left);
      const auto right = is_unary(node.kind) ? left : image(node.right);
      if (!left || !right) return std::nullopt;
      images_[part] = is_unary(node.kind)
                          ? bound_.pool.unary(node.kind, *left)
                          : bound_.pool.binary(node.kind, *left, *right);
    }
    const auto whole = image(formula);
    if (!whole) return std::nullopt;
    bound_.formula = *whole;
    return std::move(bound_);
  }

 private:
  // A part that becomes one proposition, if nothing above it does: an event of
  // steps, or what speaks of single states only.
  bool is_proposition(FormulaId part) const {
    return formulas_[part].kind == FormulaKind::Atom ||
           (formulas_.is_state_formula(part) &&
            !speaks_of_steps(formulas_, part, atoms_));
  }

  // What stands for a part: known already, or a proposition made now.
  std::optional<FormulaId> image(FormulaId part) {
    auto known = images_.find(part);
    if (known != images_.end()) return known->second;
    const FormulaNode& node = formulas_[part];
    if (node.kind == FormulaKind::True || node.kind == FormulaKind::False) {
      return bound_.pool.constant(node.kind == FormulaKind::True);
    }
    const auto number = static_cast<std::uint32_t>(bound_.propositions.size());
    if (number >= kMaxPropositions) return std::nullopt;
    if (node.kind == FormulaKind::Atom) {
      bound_.propositions.push_back(atoms_[node.atom]);
    } else {
      auto predicate = predicate_of(formulas_, part, atoms_);
      if (!predicate) return std::nullopt;
      bound_.propositions.push_back(
          {std::move(*predicate), PropositionKind::State, {}});
    }
    bound_.sources.push_back(part);
    return images_[part] = bound_.pool.atom(number);
  }

  const FormulaPool& formulas_;
  const std::vector<Proposition>& atoms_;
  BoundFormula bound_;
  std::map<FormulaId, FormulaId> images_;
};

}  // namespace

bool speaks_of_steps(const FormulaPool& formulas, FormulaId formula,
                     const std::vector<Proposition>& atoms) {
  return std::ranges::any_of(formulas.atoms(formula), [&](std::uint32_t atom) {
    return atoms[atom].kind != PropositionKind::State;
  });
}

std::optional<StatePredicate> predicate_of(
    const FormulaPool& formulas, FormulaId formula,
    const std::vector<Proposition>& atoms) {
  std::map<FormulaId, StatePredicate> made;
  for (const FormulaId part : formulas.nodes(formula)) {
    const FormulaNode& node = formulas[part];
    StatePredicate predicate;
    if (node.kind == FormulaKind::Atom) {
      predicate = atoms[node.atom].of;
    } else if (is_leaf(node.kind)) {
      predicate.expression =
          Expression::constant(node.kind == FormulaKind::True ? 1 : 0);
    } else {
      const StatePredicate& left = made.at(node.left);
      predicate = combined(node.kind, left,
                           is_unary(node.kind) ? left : made.at(node.right));
    }
    if (size_of(predicate) > kMostTerms) return std::nullopt;
    made[part] = std::move(predicate);
  }
  return made.at(formula);
}

std::optional<DefinitePredicates> definite_predicates(
    const FormulaPool& formulas, FormulaId formula,
    const std::vector<Proposition>& atoms,
    const std::vector<GivenArguments>& given) {
  std::map<FormulaId, DefinitePredicates> made;
  for (const FormulaId part : formulas.nodes(formula)) {
    const FormulaNode& node = formulas[part];
    DefinitePredicates both;
    if (node.kind == FormulaKind::Atom) {
      both.holds = both.may_hold = atoms[node.atom].of;
      const bool is_partial =
          node.atom < given.size() && !given[node.atom].nodes.empty();
      if (is_partial) {
        both.may_hold =
            combined(FormulaKind::Implies,
                     StatePredicate{given[node.atom].where, {}}, both.holds);
      }
    } else if (is_leaf(node.kind)) {
      both.holds.expression =
          Expression::constant(node.kind == FormulaKind::True ? 1 : 0);
      both.may_hold = both.holds;
    } else {
      const DefinitePredicates& left = made.at(node.left);
      both = combined(node.kind, left,
                      is_unary(node.kind) ? left : made.at(node.right));
    }
    if (size_of(both.holds) + size_of(both.may_hold) > kMostTerms) {
      return std::nullopt;
    }
    made[part] = std::move(both);
  }
  return made.at(formula);
}

std::optional<BoundFormula> bind_formula(
    const FormulaPool& formulas, FormulaId formula,
    const std::vector<Proposition>& atoms) {
  return Abstraction(formulas, atoms).run(formula);
}

}  // namespace btcheck
