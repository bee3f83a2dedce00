// SPDX-License-Identifier: MIT
//
// A condition that stands positively is replaced by false, one that stands
// negatively by true: if the property still holds, it did not matter. The
// smallest parts are enough: what is vacuous in a larger part is so in each
// smaller one. Conditions that stand both ways are left alone. The trigger of
// `[] (P => …)` never matters exactly if no reachable state has P: one
// breadth-first search counts those states for all properties.
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

std::vector<VacuousPart> vacuous_parts(const FileSearch& all,
                                       const BoundProperty& bound) {
  std::vector<VacuousPart> parts;
  const BoundFormula& whole = bound.formula;
  const std::vector<FairnessPair>& strong = all.file.assumptions.strong;
  const SearchedNetwork searched(
      all.system, observed_by(all.system.network(), whole, strong),
      all.reduction, all.in_parts);
  const std::vector<Polarity> polarity = polarities(whole.pool, whole.formula);
  std::size_t tried = 0;
  for (const std::uint32_t atom : whole.pool.atoms(whole.formula)) {
    BoundFormula weaker = whole;
    const Polarity stands = polarity[index(weaker.pool.atom(atom))];
    const bool as_if_true = stands == Polarity::Negative;
    if (stands == Polarity::Both || bound.origins[atom].text.empty()) continue;
    if (tried++ == kMostVacuityChecks) break;
    weaker.formula = replaced(weaker.pool, whole.formula, atom, as_if_true);
    if (exists_run_against(searched.system(), weaker, strong, all.limits) ==
        SearchOutcome::Empty) {
      parts.push_back(
          {bound.origins[atom].text, as_if_true, bound.origins[atom].is_scope});
    }
  }
  return parts;
}

// Counts the states of each predicate, and notes the first fault.
struct Census : public ReachabilityVisitor {
  Census(const ReducedNetwork& of,
         const std::vector<StatePredicate>& predicates)
      : system(of.network()),
        labels(of, predicates),
        counts(predicates.size(), 0) {}

  GoOn expanded(StateId, StateView state, bool is_dead) {
    for (std::size_t i = 0; i < counts.size(); ++i) {
      counts[i] += labels.holds(i, state, is_dead);
    }
    const auto fault = system.network().fault;
    has_fault |= fault && system.value(state, *fault) != 0;
    return counts.empty() && has_fault ? GoOn::No : GoOn::Yes;
  }

  const CompiledNetwork& system;
  LabelledNetwork labels;
  std::vector<std::uint64_t> counts;
  bool has_fault = false;
};

}  // namespace

void judge_vacuity(const FileSearch& all) {
  for (std::size_t i = 0; i < all.verdicts.size(); ++i) {
    if (all.limits.reached({}) != StopReason::None) return;
    const BoundProperty& bound = all.file.properties[i];
    PropertyVerdict& verdict = all.verdicts[i];
    if (bound.form == PropertyForm::Ltl && !verdict.no_run &&
        verdict.verdict == Verdict::Holds) {
      verdict.vacuous = vacuous_parts(all, bound);
    }
  }
}

bool take_census(const FileSearch& all) {
  const Network& network = all.system.network();
  std::vector<std::size_t> counted;
  std::vector<StatePredicate> triggers;
  for (std::size_t i = 0; i < all.verdicts.size(); ++i) {
    const auto& trigger = all.file.properties[i].trigger;
    if (!trigger || all.verdicts[i].verdict != Verdict::Holds) continue;
    counted.push_back(i);
    triggers.push_back(trigger->predicate);
  }
  if (counted.empty() && !network.fault) return false;
  // What is seen of all has to stand at the same time.
  std::vector<std::vector<std::size_t>> groups(1);
  for (std::size_t k = 0; k < counted.size(); ++k) {
    if (all.in_parts != nullptr && k > 0) groups.emplace_back();
    groups.back().push_back(k);
  }
  bool has_fault = false;
  for (const std::vector<std::size_t>& group : groups) {
    std::vector<StatePredicate> asked;
    for (const std::size_t k : group) asked.push_back(triggers[k]);
    const SearchedNetwork searched(all.system, observed_alone(network, asked),
                                   all.reduction, all.in_parts);
    Census census(searched.system(), asked);
    const ReachabilityResult result =
        BreadthFirst(searched.system(), all.limits).run(census);
    has_fault = has_fault || census.has_fault;
    for (std::size_t i = 0; i < group.size() && result.is_complete; ++i) {
      PropertyVerdict& verdict = all.verdicts[counted[group[i]]];
      verdict.triggers = census.counts[i];
      if (verdict.triggers == 0u) {
        verdict.idle = all.file.properties[counted[group[i]]].trigger->text;
      }
    }
  }
  return has_fault;
}

}  // namespace btcheck
