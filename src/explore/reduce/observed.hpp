// SPDX-License-Identifier: MIT
//
// What a question can see of a network: all that a reduction must keep.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "explore/state/proposition.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// For each variable which of its values the questions tell apart. A question
// that only compares a variable with constants, as `land.ticked` compares a
// location, sees just those values; all others look the same to it.
class Observed {
 public:
  explicit Observed(const Network& network);

  void add(const Expression& expression);
  void add(const StatePredicate& predicate);
  void add(std::span<const Proposition> propositions);
  // Every value of a variable.
  void add(VariableId variable);
  // Every single step.
  void add_steps() { sees_steps_ = true; }

  // Whether some question can notice any change of the variable.
  bool sees(VariableId variable) const {
    return views_[index(variable)].kind != Sight::Nothing;
  }
  // Whether it can notice a change from one value to another.
  bool tells_apart(VariableId variable, int one, int other) const;

  // Whether it tells this value from some other.
  bool tells(VariableId variable, int value) const {
    const View& view = views_[index(variable)];
    return view.kind == Sight::EveryValue ||
           std::find(view.values.begin(), view.values.end(), value) !=
               view.values.end();
  }

  // Whether being dead makes a difference to some question.
  bool sees_death() const { return sees_death_; }
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
  bool sees_steps_ = false;
};

}  // namespace btcheck
