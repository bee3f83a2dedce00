// SPDX-License-Identifier: MIT
//
// Every subformula gets its truth at every position, operands before
// operators. An ultimately periodic word has finitely many different suffixes,
// one per position, so Until is a least fixpoint over them and Release a
// greatest one: going backwards twice round the loop reaches it. This is the
// second opinion on every lasso that a search finds; it shares nothing with
// the automata that found it.
#include "ltl/formula/lasso_evaluation.hpp"

#include <cassert>
#include <utility>

namespace btcheck {
namespace {

class Evaluation {
 public:
  Evaluation(const FormulaPool& formulas,
             std::span<const PropositionSet> labels, std::size_t loop)
      : formulas_(formulas), labels_(labels), loop_(loop) {}

  std::vector<std::vector<bool>> up_to(FormulaId formula) {
    for (std::uint32_t i = 0; i <= index(formula); ++i) {
      evaluate(formulas_[FormulaId{i}]);
    }
    return std::move(truths_);
  }

 private:
  std::size_t after(std::size_t position) const {
    return position + 1 < labels_.size() ? position + 1 : loop_;
  }

  // Least fixpoints start from false, greatest ones from true.
  void evaluate(const FormulaNode& node) {
    const bool is_greatest = node.kind == FormulaKind::Always ||
                             node.kind == FormulaKind::WeakUntil ||
                             node.kind == FormulaKind::Release;
    std::vector<bool> truth(labels_.size(), is_greatest);
    for (int round = 0; round < 2; ++round) {
      for (std::size_t i = labels_.size(); i-- > 0;) {
        truth[i] = truth_of(node, i, truth[after(i)]);
      }
    }
    truths_.push_back(std::move(truth));
  }

  // At a position, `next` being the truth of the same node at the next one.
  bool truth_of(const FormulaNode& node, std::size_t at, bool next) const {
    const auto left = [&] { return truths_[index(node.left)][at]; };
    const auto right = [&] { return truths_[index(node.right)][at]; };
    switch (node.kind) {
      case FormulaKind::True:
        return true;
      case FormulaKind::False:
        return false;
      case FormulaKind::Atom:
        return (labels_[at] >> node.atom & 1) != 0;
      case FormulaKind::Not:
        return !left();
      case FormulaKind::And:
        return left() && right();
      case FormulaKind::Or:
        return left() || right();
      case FormulaKind::Implies:
        return !left() || right();
      case FormulaKind::Equivalent:
        return left() == right();
      case FormulaKind::Next:
        return truths_[index(node.left)][after(at)];
      case FormulaKind::Eventually:
        return left() || next;
      case FormulaKind::Always:
        return left() && next;
      case FormulaKind::Until:
      case FormulaKind::WeakUntil:
        return right() || (left() && next);
      case FormulaKind::Release:
        return right() && (left() || next);
      case FormulaKind::ExistsPath:
      case FormulaKind::ForAllPaths:
        break;  // one run says nothing about others
    }
    return false;
  }

  const FormulaPool& formulas_;
  std::span<const PropositionSet> labels_;
  std::size_t loop_;
  std::vector<std::vector<bool>> truths_;  // by FormulaId, then position
};

}  // namespace

std::vector<std::vector<bool>> truths_on_lasso(
    const FormulaPool& formulas, FormulaId formula,
    std::span<const PropositionSet> labels, std::size_t loop) {
  assert(loop < labels.size());
  return Evaluation(formulas, labels, loop).up_to(formula);
}

bool holds_on_lasso(const FormulaPool& formulas, FormulaId formula,
                    std::span<const PropositionSet> labels, std::size_t loop) {
  return truths_on_lasso(formulas, formula, labels, loop).back()[0];
}

}  // namespace btcheck
