// SPDX-License-Identifier: MIT
//
// Smaller Büchi automata for the same words.
//
// What matters of an automaton is what its components can do for ever, so the
// clean-up looks at strongly connected components: states that reach none that
// accepts go, marks outside those that accept go, and within one a set is
// superfluous if every cycle meets it or another set is contained in it. The
// needed sets are numbered anew in each component, so that there are as many
// as the component with most needs, not as the formula has untils. Bisimilar
// states are merged by refining a partition. For merging by simulation see
// ltl/buchi/simulation.cpp.
#include "ltl/buchi/simplify.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>
#include <vector>

#include "ltl/buchi/components.hpp"

namespace btcheck {

namespace {

using Transitions = std::vector<BuchiTransition>;

void sort_and_unite(Transitions& transitions) {
  std::sort(transitions.begin(), transitions.end());
  transitions.erase(std::unique(transitions.begin(), transitions.end()),
                    transitions.end());
}

// Keeps the states marked in `kept` and the transitions between them.
void keep_states(BuchiAutomaton& automaton, const std::vector<bool>& kept) {
  std::vector<std::uint32_t> renumbered(automaton.state_count());
  std::vector<Transitions> transitions;
  for (std::size_t state = 0; state < kept.size(); ++state) {
    if (!kept[state]) continue;
    renumbered[state] = static_cast<std::uint32_t>(transitions.size());
    transitions.push_back(std::move(automaton.transitions[state]));
  }
  for (Transitions& some : transitions) {
    std::erase_if(some, [&](const BuchiTransition& transition) {
      return !kept[transition.target];
    });
    for (BuchiTransition& transition : some) {
      transition.target = renumbered[transition.target];
    }
  }
  automaton.initial = renumbered[automaton.initial];
  automaton.transitions = std::move(transitions);
}

// Keeps the reachable states from which a component is reached that accepts.
void keep_useful_states(BuchiAutomaton& automaton) {
  const Components components(automaton);
  std::vector<bool> useful(automaton.state_count());
  for (std::size_t i = 0; i < components.count(); ++i) {
    const auto leads_on = [&](std::uint32_t state) {
      const Transitions& some = automaton.transitions[state];
      return std::any_of(
          some.begin(), some.end(),
          [&](const BuchiTransition& t) { return bool{useful[t.target]}; });
    };
    const std::vector<std::uint32_t>& members = components.members(i);
    if (components.is_accepting(i) ||
        std::any_of(members.begin(), members.end(), leads_on)) {
      for (const std::uint32_t state : members) useful[state] = true;
    }
  }
  if (useful[automaton.initial]) {
    keep_states(automaton, useful);
  } else {
    automaton = BuchiAutomaton{};
  }
}

// True when each cycle of a component meets the set: without its transitions
// the states can be put in an order.
bool every_cycle_meets(const BuchiAutomaton& automaton,
                       const Components& components, std::size_t component,
                       AcceptanceSet set) {
  const auto visit_others = [&](std::uint32_t state, auto&& visit) {
    for (const BuchiTransition& transition : automaton.transitions[state]) {
      if (components.is_inside(state, transition) &&
          (transition.accepting & set) == 0) {
        visit(transition.target);
      }
    }
  };
  std::map<std::uint32_t, std::size_t> incoming;
  for (const std::uint32_t state : components.members(component)) {
    visit_others(state, [&](std::uint32_t target) { ++incoming[target]; });
  }
  std::vector<std::uint32_t> free;
  for (const std::uint32_t state : components.members(component)) {
    if (!incoming.contains(state)) free.push_back(state);
  }
  for (std::size_t i = 0; i < free.size(); ++i) {
    visit_others(free[i], [&](std::uint32_t target) {
      if (--incoming[target] == 0) free.push_back(target);
    });
  }
  return free.size() == components.members(component).size();
}

// True when each transition of the component that is in `inner` is in `outer`.
bool is_contained(const BuchiAutomaton& automaton, const Components& components,
                  std::size_t component, AcceptanceSet inner,
                  AcceptanceSet outer) {
  for (const std::uint32_t state : components.members(component)) {
    for (const BuchiTransition& transition : automaton.transitions[state]) {
      if (components.is_inside(state, transition) &&
          (transition.accepting & inner) != 0 &&
          (transition.accepting & outer) == 0) {
        return false;
      }
    }
  }
  return true;
}

// The sets, as one bit each, that decide whether a run in the component is
// accepted.
std::vector<AcceptanceSet> needed_sets(const BuchiAutomaton& automaton,
                                       const Components& components,
                                       std::size_t component) {
  std::vector<AcceptanceSet> needed;
  for (int i = 0; i < automaton.acceptance_sets; ++i) {
    const AcceptanceSet set = AcceptanceSet{1} << i;
    const auto within = [&](AcceptanceSet inner, AcceptanceSet outer) {
      return is_contained(automaton, components, component, inner, outer);
    };
    if (!every_cycle_meets(automaton, components, component, set)) {
      keep_weakest(needed, set, within);
    }
  }
  return needed;
}

// Numbers the needed sets from 0; the others up to all_sets always hold.
AcceptanceSet renumbered(AcceptanceSet sets,
                         const std::vector<AcceptanceSet>& needed,
                         AcceptanceSet all_sets) {
  AcceptanceSet result = all_sets;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if ((sets & needed[i]) == 0) result &= ~(AcceptanceSet{1} << i);
  }
  return result;
}

void keep_needed_marks(BuchiAutomaton& automaton, PassingMarks passing) {
  const Components components(automaton);
  std::vector<std::vector<AcceptanceSet>> needed(components.count());
  std::size_t most = 0;
  for (std::size_t i = 0; i < components.count(); ++i) {
    if (components.is_accepting(i)) {
      needed[i] = needed_sets(automaton, components, i);
      most = std::max(most, needed[i].size());
    } else if (components.has_cycle(i)) {
      most = std::max<std::size_t>(most, 1);
    }
  }
  automaton.acceptance_sets = static_cast<int>(most);
  const AcceptanceSet all = automaton.all_sets();
  for (std::uint32_t state = 0; state < automaton.state_count(); ++state) {
    const std::uint32_t component = components.of(state);
    for (BuchiTransition& transition : automaton.transitions[state]) {
      AcceptanceSet& sets = transition.accepting;
      if (!components.is_inside(state, transition)) {
        sets = passing == PassingMarks::All ? all : 0;
      } else if (components.is_accepting(component)) {
        sets = renumbered(sets, needed[component], all);
      } else {
        sets = 0;
      }
    }
    sort_and_unite(automaton.transitions[state]);
  }
}

// The partition of states by what their transitions are, up to the partition.
std::vector<std::uint32_t> bisimulation_classes(
    const BuchiAutomaton& automaton) {
  return refined(std::vector<std::uint32_t>(automaton.state_count()),
                 [&](std::size_t state, const auto& classes) {
                   Transitions signature = automaton.transitions[state];
                   for (BuchiTransition& t : signature) {
                     t.target = classes[t.target];
                   }
                   sort_and_unite(signature);
                   return signature;
                 });
}

constexpr int kMostRounds = 10;

struct Size {
  std::size_t states = 0;
  std::size_t transitions = 0;
  int sets = 0;

  friend bool operator==(const Size&, const Size&) = default;
};

Size size_of(const BuchiAutomaton& automaton) {
  Size size{automaton.state_count(), 0, automaton.acceptance_sets};
  for (const Transitions& some : automaton.transitions) {
    size.transitions += some.size();
  }
  return size;
}

}  // namespace

void clean_up(BuchiAutomaton& automaton, PassingMarks passing) {
  if (automaton.is_empty()) return;
  keep_useful_states(automaton);
  if (automaton.is_empty()) return;
  keep_needed_marks(automaton, passing);
}

void merge_bisimilar(BuchiAutomaton& automaton) {
  if (automaton.is_empty()) return;
  const std::vector<std::uint32_t> classes = bisimulation_classes(automaton);
  std::vector<bool> seen(classes.size());
  std::vector<std::uint32_t> first(classes.size());
  for (std::uint32_t state = 0; state < classes.size(); ++state) {
    if (!seen[classes[state]]) first[classes[state]] = state;
    seen[classes[state]] = true;
  }
  std::vector<bool> kept(classes.size());
  for (std::uint32_t state = 0; state < classes.size(); ++state) {
    kept[state] = first[classes[state]] == state;
    for (BuchiTransition& t : automaton.transitions[state]) {
      t.target = first[classes[t.target]];
    }
    sort_and_unite(automaton.transitions[state]);
  }
  automaton.initial = first[classes[automaton.initial]];
  keep_states(automaton, kept);
}

void reduce(BuchiAutomaton& automaton) {
  Size before;
  for (int round = 0; round < kMostRounds && size_of(automaton) != before;
       ++round) {
    before = size_of(automaton);
    for (const PassingMarks passing : {PassingMarks::None, PassingMarks::All}) {
      clean_up(automaton, passing);
      merge_bisimilar(automaton);
      merge_similar(automaton);
    }
  }
  clean_up(automaton);
  separate_labels(automaton);
  clean_up(automaton);
}

}  // namespace btcheck
