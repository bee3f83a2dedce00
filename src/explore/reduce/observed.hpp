// SPDX-License-Identifier: MIT
//
// What a question can see of a network: all that a reduction must keep. And
// which reductions there are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "explore/state/proposition.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// Which interleavings and values a search may leave out. A reduced system is a
// TransitionSystem again, with fewer states, so searches and products need not
// know. live_variables.* and ample_sets.* say what each reduction preserves.
enum class Reduction : std::uint8_t {
  None,  // every interleaving and every value: the reference
  Live,  // values that nothing reads any more are fixed
  Full   // and independent steps are not interleaved
};

// For each variable which of its values the questions tell apart. A question
// that only compares a variable with constants, as `land.ticked` compares a
// location, sees just those values; all others look the same to it.
class Observed {
 public:
  explicit Observed(const Network& network)
      : views_(network.variables.size()) {}

  void add(const Expression& expression);
  void add(const StatePredicate& predicate);
  void add(std::span<const Proposition> propositions);
  // Every value of a variable.
  void add(VariableId variable) {
    views_[index(variable)] = {Sight::EveryValue, {}};
  }
  // Every single step.
  void add_steps() { sees_steps_ = true; }
  // Dead states, and nothing of others.
  void add_dead_states() { sees_dead_states_ = true; }

  // Whether some question can notice any change of the variable.
  bool sees(VariableId variable) const {
    return views_[index(variable)].kind != Sight::Nothing;
  }
  // Whether it can notice a change from one value to another.
  bool tells_apart(VariableId variable, int one, int other) const {
    return one != other && (tells(variable, one) || tells(variable, other));
  }
  // Whether it tells this value from some other.
  bool tells(VariableId variable, int value) const {
    const View& view = views_[index(variable)];
    return view.kind == Sight::EveryValue ||
           std::ranges::find(view.values, value) != view.values.end();
  }

  // The same of a network with more variables, of which nothing is seen.
  Observed widened(const Network& network) const {
    Observed wide = *this;
    wide.views_.resize(network.variables.size());
    return wide;
  }

  // Whether being dead makes a difference to some question.
  bool sees_death() const { return sees_death_; }
  // Or is all that one asks for.
  bool sees_dead_states() const { return sees_death_ || sees_dead_states_; }
  // Whether some question is about single steps.
  bool sees_steps() const { return sees_steps_; }

 private:
  enum class Sight : std::uint8_t { Nothing, SomeValues, EveryValue };
  struct View {
    Sight kind = Sight::Nothing;
    std::vector<int> values;  // SomeValues: those compared with
  };

  std::vector<View> views_;  // by VariableId
  bool sees_death_ = false;
  bool sees_dead_states_ = false;
  bool sees_steps_ = false;
};

}  // namespace btcheck
