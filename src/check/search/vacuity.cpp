// SPDX-License-Identifier: MIT
//
// A condition that stands positively is replaced by false, one that stands
// negatively by true: if the property still holds, the condition did not
// matter. It is enough to try the smallest parts: what is vacuous in a larger
// part is so in each smaller one within it. Conditions that stand both ways
// are left alone. The trigger of `[] (P => …)` needs no search of its own: the
// property with P => false holds exactly if no reachable state has P, and one
// breadth-first search counts those states for all properties at once.
#include <optional>

#include "check/search/searched_network.hpp"
#include "check/search/searches.hpp"
#include "explore/reduce/labels.hpp"
#include "explore/search/reachability.hpp"
#include "ltl/formula/formula.hpp"

namespace btcheck {
namespace {

// The formula with an atom replaced by a constant.
FormulaId replaced(FormulaPool& pool, FormulaId whole, std::uint32_t atom,
                   bool value) {
  std::vector<FormulaId> images(index(whole) + 1);
  for (const FormulaId id : pool.nodes(whole)) {
    const FormulaNode node = pool[id];
    FormulaId& image = images[index(id)];
    if (node.kind == FormulaKind::Atom && node.atom == atom) {
      image = pool.constant(value);
    } else if (is_leaf(node.kind)) {
      image = id;
    } else if (is_unary(node.kind)) {
      image = pool.unary(node.kind, images[index(node.left)]);
    } else {
      image = pool.binary(node.kind, images[index(node.left)],
                          images[index(node.right)]);
    }
  }
  return images[index(whole)];
}

std::vector<VacuousPart> vacuous_parts(const CompiledNetwork& system,
                                       const BoundProperty& bound,
                                       const BoundAssumptions& assumptions,
                                       Reduction reduction,
                                       const Limits& limits) {
  std::vector<VacuousPart> parts;
  const BoundFormula& whole = bound.formula;
  const SearchedNetwork searched(
      system, observed_by(system.network(), whole, assumptions.strong),
      reduction);
  const std::vector<Polarity> polarity = polarities(whole.pool, whole.formula);
  std::size_t tried = 0;
  for (const std::uint32_t atom : whole.pool.atoms(whole.formula)) {
    BoundFormula weaker = whole;
    const Polarity stands = polarity[index(weaker.pool.atom(atom))];
    const bool as_if_true = stands == Polarity::Negative;
    if (stands == Polarity::Both || bound.origins[atom].text.empty()) continue;
    if (tried++ == kMostVacuityChecks) break;
    weaker.formula = replaced(weaker.pool, whole.formula, atom, as_if_true);
    if (exists_run_against(searched.system(), weaker, assumptions.strong,
                           limits) == SearchOutcome::Empty) {
      parts.push_back(
          {bound.origins[atom].text, as_if_true, bound.origins[atom].is_scope});
    }
  }
  return parts;
}

// Counts the states of each predicate, and notes the first fault.
class Census : public ReachabilityVisitor {
 public:
  Census(const ReducedNetwork& system,
         const std::vector<StatePredicate>& predicates)
      : system_(system.network()),
        labels_(system, predicates),
        counts_(predicates.size(), 0) {}

  GoOn expanded(StateId, StateView state, bool is_dead) {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      counts_[i] += labels_.holds(i, state, is_dead);
    }
    const auto fault = system_.network().fault;
    has_fault_ |= fault && system_.value(state, *fault) != 0;
    return counts_.empty() && has_fault_ ? GoOn::No : GoOn::Yes;
  }

  std::uint64_t count(std::size_t i) const { return counts_[i]; }
  bool has_fault() const { return has_fault_; }

 private:
  const CompiledNetwork& system_;
  LabelledNetwork labels_;
  std::vector<std::uint64_t> counts_;
  bool has_fault_ = false;
};

}  // namespace

void judge_vacuity(const CompiledNetwork& system, const BoundFile& file,
                   Reduction reduction, const Limits& limits,
                   std::vector<PropertyVerdict>& verdicts) {
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const BoundProperty& bound = file.properties[i];
    if (bound.form != PropertyForm::Ltl || verdicts[i].no_run ||
        verdicts[i].verdict != Verdict::Holds) {
      continue;
    }
    verdicts[i].vacuous =
        vacuous_parts(system, bound, file.assumptions, reduction, limits);
  }
}

bool take_census(const CompiledNetwork& system, const BoundFile& file,
                 Reduction reduction, const Limits& limits,
                 std::vector<PropertyVerdict>& verdicts) {
  std::vector<std::size_t> counted;
  std::vector<StatePredicate> triggers;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const auto& trigger = file.properties[i].trigger;
    if (!trigger || verdicts[i].verdict != Verdict::Holds) continue;
    counted.push_back(i);
    triggers.push_back(trigger->predicate);
  }
  if (counted.empty() && !system.network().fault) return false;
  const SearchedNetwork searched(
      system, observed_alone(system.network(), triggers), reduction);
  Census census(searched.system(), triggers);
  const ReachabilityResult result =
      BreadthFirst(searched.system(), limits).run(census);
  for (std::size_t k = 0; k < counted.size() && result.is_complete; ++k) {
    PropertyVerdict& verdict = verdicts[counted[k]];
    verdict.triggers = census.count(k);
    if (verdict.triggers == 0u) {
      verdict.idle = file.properties[counted[k]].trigger->text;
    }
  }
  return census.has_fault();
}

}  // namespace btcheck
