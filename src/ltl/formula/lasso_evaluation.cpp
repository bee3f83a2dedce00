// SPDX-License-Identifier: MIT
//
// Every sub-formula gets its truth at every position, operands before
// operators. An ultimately periodic word has finitely many different suffixes,
// one per position, so Until is a least fixpoint over them and Release a
// greatest one: going backwards twice round the loop reaches it. This is the
// second opinion on every lasso that a search finds; it shares nothing with
// the automata that found it.
#include "ltl/formula/lasso_evaluation.hpp"

#include <cassert>

namespace btcheck {
namespace {

using Truth = std::vector<bool>;  // by position

class Evaluation {
 public:
  Evaluation(const FormulaPool& formulas,
             std::span<const PropositionSet> labels, std::size_t loop)
      : formulas_(formulas), labels_(labels), loop_(loop) {}

  bool at_start(FormulaId formula) {
    truths_.resize(index(formula) + 1);
    for (std::uint32_t i = 0; i <= index(formula); ++i) {
      truths_[i] = truth_of(formulas_[FormulaId{i}]);
    }
    return truths_[index(formula)][0];
  }

 private:
  std::size_t after(std::size_t position) const {
    return position + 1 < labels_.size() ? position + 1 : loop_;
  }

  // The solution of X = now or (and) step with X at the next position:
  // least when it starts from false, greatest when from true.
  template <class Rule>
  Truth fixpoint(bool start, Rule rule) const {
    Truth truth(labels_.size(), start);
    for (int round = 0; round < 2; ++round) {
      for (std::size_t i = labels_.size(); i-- > 0;) {
        truth[i] = rule(i, truth[after(i)]);
      }
    }
    return truth;
  }

  template <class Rule>
  Truth everywhere(Rule rule) const {
    Truth truth(labels_.size());
    for (std::size_t i = 0; i < labels_.size(); ++i) truth[i] = rule(i);
    return truth;
  }

  Truth truth_of(const FormulaNode& node) const {
    const auto left = [&](std::size_t i) -> bool {
      return truths_[index(node.left)][i];
    };
    const auto right = [&](std::size_t i) -> bool {
      return truths_[index(node.right)][i];
    };
    switch (node.kind) {
      case FormulaKind::True:
        return Truth(labels_.size(), true);
      case FormulaKind::False:
        return Truth(labels_.size(), false);
      case FormulaKind::Atom:
        return everywhere(
            [&](std::size_t i) -> bool { return labels_[i] >> node.atom & 1; });
      case FormulaKind::Not:
        return everywhere([&](std::size_t i) { return !left(i); });
      case FormulaKind::And:
        return everywhere([&](std::size_t i) { return left(i) && right(i); });
      case FormulaKind::Or:
        return everywhere([&](std::size_t i) { return left(i) || right(i); });
      case FormulaKind::Implies:
        return everywhere([&](std::size_t i) { return !left(i) || right(i); });
      case FormulaKind::Equivalent:
        return everywhere([&](std::size_t i) { return left(i) == right(i); });
      case FormulaKind::Next:
        return everywhere([&](std::size_t i) { return left(after(i)); });
      case FormulaKind::Eventually:
        return fixpoint(
            false, [&](std::size_t i, bool next) { return left(i) || next; });
      case FormulaKind::Always:
        return fixpoint(
            true, [&](std::size_t i, bool next) { return left(i) && next; });
      case FormulaKind::Until:
        return fixpoint(false, [&](std::size_t i, bool next) {
          return right(i) || (left(i) && next);
        });
      case FormulaKind::WeakUntil:
        return fixpoint(true, [&](std::size_t i, bool next) {
          return right(i) || (left(i) && next);
        });
      case FormulaKind::Release:
        return fixpoint(true, [&](std::size_t i, bool next) {
          return right(i) && (left(i) || next);
        });
      case FormulaKind::ExistsPath:
      case FormulaKind::ForAllPaths:
        break;  // one run does not tell what others do
    }
    return {};
  }

  const FormulaPool& formulas_;
  std::span<const PropositionSet> labels_;
  std::size_t loop_;
  std::vector<Truth> truths_;  // by FormulaId
};

}  // namespace

bool holds_on_lasso(const FormulaPool& formulas, FormulaId formula,
                    std::span<const PropositionSet> labels, std::size_t loop) {
  assert(loop < labels.size());
  return Evaluation(formulas, labels, loop).at_start(formula);
}

}  // namespace btcheck
