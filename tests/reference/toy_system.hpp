// SPDX-License-Identifier: MIT
//
// Transition systems written down state by state, and random ones.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "explore/state/transition_system.hpp"
#include "ltl/product/product.hpp"

namespace btcheck::reference {

// States are numbers; the packed state is the number.
class ToySystem {
 public:
  struct ToyStep {
    std::uint32_t target = 0;
    Step step;
  };

  // A state with its label and steps; returns its number.
  std::uint32_t add(PropositionSet label, std::vector<ToyStep> steps = {}) {
    labels_.push_back(label);
    steps_.push_back(std::move(steps));
    return static_cast<std::uint32_t>(labels_.size() - 1);
  }
  void add_step(std::uint32_t source, std::uint32_t target, Step step = {0}) {
    steps_[source].push_back({target, step});
  }
  void add_initial(std::uint32_t state) { initial_.push_back(state); }

  std::size_t size() const { return labels_.size(); }
  const std::vector<std::uint32_t>& initial() const { return initial_; }
  const std::vector<ToyStep>& steps(std::size_t state) const {
    return steps_[state];
  }
  PropositionSet label_of(std::size_t state) const { return labels_[state]; }

  // What TransitionSystem asks for.
  std::size_t word_count() const { return 1; }
  template <class Found>
  void initial_states(Found&& found) const {
    for (const Word state : initial_) found(StateView(&state, 1));
  }
  template <class Stepped>
  void successors(StateView state, Stepped&& stepped) const {
    for (const ToyStep& step : steps_[state[0]]) {
      const Word target = step.target;
      stepped(StateView(&target, 1), step.step);
    }
  }
  PropositionSet label(StateView state) const { return labels_[state[0]]; }

 private:
  std::vector<PropositionSet> labels_;
  std::vector<std::vector<ToyStep>> steps_;
  std::vector<std::uint32_t> initial_;
};

static_assert(TransitionSystem<ToySystem>);

// 3 to 8 states with up to three steps each; with SomeStepsAreNot, one step in
// five makes no progress. One step in three takes time. Edges are numbered.
ToySystem random_system(std::mt19937& random, std::uint32_t atoms,
                        Justice justice);

// True when the system has a step between the two states just so.
bool has_step(const ToySystem& system, StateView from, StateView to, Step step);

// True when the lasso is a run of the system: it begins in an initial state
// and each state follows from the one before by the step it names.
bool is_run(const ToySystem& system, const Lasso& lasso);

// True when some step of the cycle makes progress.
bool is_fair(const Lasso& lasso);

}  // namespace btcheck::reference
