// SPDX-License-Identifier: MIT
//
// Random questions about single states of a network, and what they see.
#pragma once

#include <cstdint>
#include <vector>

#include "explore/reduce/observed.hpp"
#include "explore/state/proposition.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference {

struct Questions {
  std::vector<StatePredicate> predicates;
  std::vector<VariableId> whole;  // every value of these is asked for

  bool see_death() const;
  // What a reduction is told of them.
  Observed observed(const Network& network) const;
};

// One to three predicates, or variables as a whole, over variables of every
// role; some predicates depend on being dead.
Questions random_questions(const Network& network, SplitMix64& random);

// The answers in a state, one number each: first of the predicates, then of
// the variables.
using Answers = std::vector<std::int64_t>;
Answers answers(const Questions& questions, const NaiveState& state,
                bool is_dead);

}  // namespace btcheck::reference
