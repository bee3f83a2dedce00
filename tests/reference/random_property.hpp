// SPDX-License-Identifier: MIT
//
// Random properties of a tree: their text, and what it means.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ltl/formula.hpp"
#include "ltl/property.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference {

// Whether an atom is true in a state of a space.
using StateTest = std::function<bool(const NaiveSpace&, std::size_t)>;

// An atom as text; what it means is found by looking its names up anew, so
// that it can be asked of a smaller tree, too. Nothing: it makes no sense
// there.
struct NaiveAtom {
  std::string text;
  std::function<std::optional<StateTest>(const BehaviorTree&, const Network&)>
      test;
};

struct RandomProperty {
  PropertyForm form = PropertyForm::Never;
  std::string body;  // as in a property file
  FormulaPool pool;  // over `atoms`
  FormulaId formula{};
  FormulaId answer{};  // Timed only
  int from = 0;
  int to = 0;
  std::vector<NaiveAtom> atoms;
};

struct PropertyWeights {
  int most_temporal = 3;  // operators of an LTL formula; 0: no LTL
  bool response = true;   // leadsto within
};

RandomProperty random_property(const BehaviorTree& tree, const Network& network,
                               SplitMix64& random,
                               const PropertyWeights& weights);

}  // namespace btcheck::reference
