// SPDX-License-Identifier: MIT
//
// From a formula of linear temporal logic to the automaton of its words.
//
// The way of Gastin and Oddoux (CAV 2001): simplify the formula, build its
// very weak alternating automaton, and from that a Büchi automaton with
// acceptance on transitions whose states are the sets of obligations that can
// arise, one acceptance set for each until. Transitions that another implies
// are dropped while it is built. We stop before their last step: nothing is
// degeneralised, as the search for cycles takes any number of acceptance sets.
// What is built is then reduced, see ltl/buchi/simplify.hpp, and where the
// formula is an obligation and its minimal deterministic automaton is no
// larger, replaced by that.
#include "ltl/buchi/translate.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "ltl/buchi/alternating.hpp"
#include "ltl/buchi/simplify.hpp"
#include "ltl/formula/normal_form.hpp"

namespace btcheck {

namespace {

class Construction {
 public:
  Construction(const AlternatingAutomaton& alternating,
               TranslationLimits limits)
      : alternating_(alternating), limits_(limits) {}

  // Nothing when a limit is reached.
  std::optional<BuchiAutomaton> run() {
    for (const Obligations& way : alternating_.initial()) number(way);
    const std::size_t initial_ways = sets_.size();
    for (std::size_t i = 0; i < sets_.size(); ++i) {
      if (!add_transitions_of(sets_[i])) return std::nullopt;
    }
    if (initial_ways == 0) return BuchiAutomaton{};
    BuchiAutomaton automaton;
    automaton.acceptance_sets = static_cast<int>(alternating_.untils().size());
    automaton.transitions = std::move(transitions_);
    begin(automaton, initial_ways);
    return automaton;
  }

 private:
  // A transition while its target is not numbered yet.
  struct Draft {
    AlternatingTransition transition;
    AcceptanceSet accepting = 0;
  };
  using Drafts = std::vector<Draft>;

  // About two seconds of comparing transitions with each other.
  static constexpr std::size_t kMostComparisons = 200'000'000;

  std::uint32_t number(const Obligations& set) {
    const auto [place, is_new] =
        numbers_.emplace(set, static_cast<std::uint32_t>(sets_.size()));
    if (is_new) sets_.push_back(set);
    return place->second;
  }

  bool add_transitions_of(Obligations set) {
    std::optional<std::vector<Draft>> drafts = drafts_of(set);
    if (!drafts) return false;
    std::vector<BuchiTransition> transitions;
    for (const Draft& draft : *drafts) {
      const AlternatingTransition& transition = draft.transition;
      transitions.push_back({transition.present, transition.absent,
                             draft.accepting, number(transition.next)});
    }
    std::sort(transitions.begin(), transitions.end());
    transition_count_ += transitions.size();
    transitions_.push_back(std::move(transitions));
    return sets_.size() <= limits_.max_states &&
           transition_count_ <= limits_.max_transitions;
  }

  // The transitions from a set of obligations: one of each, all at once.
  //
  // Those that another implies go as soon as they arise, or a chain "a, then b,
  // then c ..." has factorially many. Until all are together, those count as
  // accepting that an until of the set takes to be fulfilled: to replace one's
  // own part by a fulfilling one that it implies makes a weaker transition that
  // is accepting in this sense wherever the first is in the sense of
  // accepting_sets. So none is lost that the last step would keep.
  std::optional<Drafts> drafts_of(const Obligations& set) {
    Drafts all = {{}};
    for (const FormulaId state : set) {
      const AcceptanceSet own = set_of(state);
      Drafts both;
      for (const Draft& draft : all) {
        for (const auto& more : alternating_.transitions(state)) {
          Draft joined{conjunction_of(draft.transition, more), draft.accepting};
          if (!contains(more.next, state)) joined.accepting |= own;
          if (!can_be(joined.transition)) continue;
          if (!keep(both, std::move(joined))) return std::nullopt;
        }
      }
      all = std::move(both);
    }
    Drafts kept;
    for (Draft& draft : all) {
      draft.accepting = accepting_sets(draft.transition);
      if (!keep(kept, std::move(draft))) return std::nullopt;
    }
    return kept;
  }

  // The acceptance set of a state, if it is an until.
  AcceptanceSet set_of(FormulaId state) const {
    const auto& untils = alternating_.untils();
    const auto found = std::ranges::lower_bound(untils, state);
    if (found == untils.end() || *found != state) return 0;
    return AcceptanceSet{1} << (found - untils.begin());
  }

  // False when there are too many to compare with.
  bool keep(Drafts& kept, Draft&& draft) {
    comparisons_ += kept.size() + 1;
    keep_weakest(kept, std::move(draft), implies);
    return comparisons_ <= kMostComparisons;
  }

  static bool implies(const Draft& other, const Draft& added) {
    return (added.accepting & ~other.accepting) == 0 &&
           is_implied_by(added.transition, other.transition);
  }

  // One set for each until: the transitions that do not wait for it, or could
  // as well not.
  AcceptanceSet accepting_sets(const AlternatingTransition& transition) const {
    AcceptanceSet sets = 0;
    for (std::size_t i = 0; i < alternating_.untils().size(); ++i) {
      const FormulaId until = alternating_.untils()[i];
      const AlternatingTransitions& own = alternating_.transitions(until);
      const auto fulfils = [&](const AlternatingTransition& other) {
        return !contains(other.next, until) && is_implied_by(transition, other);
      };
      if (!contains(transition.next, until) ||
          std::any_of(own.begin(), own.end(), fulfils)) {
        sets |= AcceptanceSet{1} << i;
      }
    }
    return sets;
  }

  static bool contains(const Obligations& set, FormulaId state) {
    return std::binary_search(set.begin(), set.end(), state);
  }

  // With several ways to begin, adds a state that can do what each can.
  static void begin(BuchiAutomaton& automaton, std::size_t ways) {
    if (ways == 1) return;
    std::vector<BuchiTransition> all;
    for (std::size_t i = 0; i < ways; ++i) {
      const std::vector<BuchiTransition>& some = automaton.transitions[i];
      all.insert(all.end(), some.begin(), some.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    automaton.initial = static_cast<std::uint32_t>(automaton.state_count());
    automaton.transitions.push_back(std::move(all));
  }

  const AlternatingAutomaton& alternating_;
  const TranslationLimits limits_;
  std::map<Obligations, std::uint32_t> numbers_;
  std::vector<Obligations> sets_;  // by number
  std::vector<std::vector<BuchiTransition>> transitions_;
  std::size_t transition_count_ = 0;
  std::size_t comparisons_ = 0;
};

// Without looking whether the formula is an obligation.
std::optional<BuchiAutomaton> translate_any(FormulaPool& pool, FormulaId id,
                                            std::span<const int> proposition_of,
                                            TranslationLimits limits) {
  const FormulaId small = simplify(pool, id);
  const auto alternating =
      AlternatingAutomaton::of(pool, small, proposition_of);
  if (!alternating || alternating->untils().size() > 63) return std::nullopt;
  std::optional<BuchiAutomaton> automaton =
      Construction(*alternating, limits).run();
  if (automaton) reduce(*automaton);
  return automaton;
}

}  // namespace

std::optional<BuchiAutomaton> translate(FormulaPool& pool, FormulaId id,
                                        std::span<const int> proposition_of,
                                        TranslationLimits limits) {
  auto automaton = translate_any(pool, id, proposition_of, limits);
  if (!automaton || automaton->state_count() < 2) return automaton;
  const auto opposite = translate_any(pool, pool.unary(FormulaKind::Not, id),
                                      proposition_of, limits);
  if (!opposite) return automaton;
  auto weak = minimal_weak(*automaton, *opposite);
  if (!weak || weak->state_count() > automaton->state_count()) {
    return automaton;
  }
  return weak;
}

std::optional<BuchiAutomaton> translate(FormulaPool& pool, FormulaId id,
                                        TranslationLimits limits) {
  const std::vector<std::uint32_t> atoms = pool.atoms(id);
  assert(atoms.empty() || atoms.back() < kMaxPropositions);
  std::vector<int> same(atoms.empty() ? 0 : atoms.back() + 1);
  std::iota(same.begin(), same.end(), 0);
  return translate(pool, id, same, limits);
}

}  // namespace btcheck
