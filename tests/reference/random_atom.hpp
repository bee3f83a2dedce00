// SPDX-License-Identifier: MIT
//
// Random atoms and formulas over them: their text, and what they mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ltl/formula/formula.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference {

// Whether an atom is true in a state of a space, or of a step from a state.
using StateTest = std::function<bool(const NaiveSpace&, std::size_t)>;
using StepTest = std::function<bool(const NaiveSpace&, std::size_t,
                                    const NaiveSpace::Step&)>;

// An atom as text; what it means is found by looking its names up anew, so
// that it can be asked of a smaller tree, too. Nothing: it makes no sense
// there.
struct NaiveAtom {
  std::string text;
  // One of the two is there.
  std::function<std::optional<StateTest>(const BehaviorTree&, const Network&)>
      test;
  std::function<std::optional<StepTest>(const BehaviorTree&, const Network&)>
      step_test;
};

// An event of a node, by its name as messages spell it.
StateTest node_event(const Network& network, NodeId node,
                     std::string_view location);

class AtomMaker {
 public:
  // All must outlive it.
  AtomMaker(const BehaviorTree& tree, const Network& network,
            SplitMix64& random)
      : tree_(tree), network_(network), random_(random) {}

  // About single states.
  NaiveAtom atom();
  // About steps.
  NaiveAtom step_atom();
  // Without temporal operators, over the atoms from `first` on, three of them.
  FormulaId state_formula(FormulaPool& pool, int size, std::uint32_t first = 0);
  // With at least one and at most so many temporal operators; atoms 0 to 2.
  FormulaId temporal_formula(FormulaPool& pool, int most_temporal);
  FormulaId branching_formula(FormulaPool& pool);

  std::uint32_t number(int bound) {
    return static_cast<std::uint32_t>(random_.below(bound));
  }
  bool percent(int chance) { return random_.percent(chance); }

 private:
  template <class List>
  typename List::value_type one_of(const List& list) {
    return list[number(static_cast<int>(list.size()))];
  }

  std::string spelled(NodeId node);
  NodeId any_node();
  NaiveAtom node_atom();
  NaiveAtom local();
  NaiveAtom variable();
  NaiveAtom process();
  NaiveAtom moves();

  const BehaviorTree& tree_;
  const Network& network_;
  SplitMix64& random_;
};

// How many operators of a formula are temporal, each counted once.
int temporal_count(const FormulaPool& pool, FormulaId formula);

}  // namespace btcheck::reference
