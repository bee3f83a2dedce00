// SPDX-License-Identifier: MIT
//
// Random properties of a tree: their text, and what it means.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ltl/formula/formula.hpp"
#include "ltl/rules/property.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_atom.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference {

enum class PropertyKind {
  State,
  Ltl,
  Response,
  Pattern,
  Timed,
  Branching,
  Event
};
inline constexpr std::size_t kPropertyKinds = 7;

// What a property's file assumes.
struct RandomAssumption {
  std::string text;  // of a property file; "" for nothing
  bool actions_end = false;
  bool by_option = false;  // actions_end is not in the text
  // Infinitely often the first implies infinitely often the second.
  std::vector<std::pair<FormulaId, FormulaId>> fairness;
  std::optional<FormulaId> formula;

  bool is_empty() const { return text.empty() && !by_option; }
};

struct RandomProperty {
  PropertyKind kind = PropertyKind::State;
  PropertyForm form = PropertyForm::Never;
  std::string body;  // as in a property file
  FormulaPool pool;  // over `atoms`
  FormulaId formula{};
  TimedClaim timed;  // Timed only; as the interval is, whole and closed
  RandomAssumption assumption;
  std::vector<NaiveAtom> atoms;
};

struct PropertyWeights {
  int most_temporal = 3;  // operators of an LTL formula; 0: no LTL
  bool response = true;   // leadsto within
  bool timed = true;      // every other pattern with a time
  bool branching = true;  // CTL
};

RandomProperty random_property(const BehaviorTree& tree, const Network& network,
                               SplitMix64& random,
                               const PropertyWeights& weights);

// Puts the property under an assumption: the same one for equal trees and
// streams, over three more atoms.
void assume_something(RandomProperty& property, const BehaviorTree& tree,
                      const Network& network, SplitMix64 stream);

}  // namespace btcheck::reference
