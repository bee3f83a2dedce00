// SPDX-License-Identifier: MIT
//
// A network of which only the steps are explored that a question needs.
//
// Where some automaton has an ample set (ample_sets.hpp) its steps alone are
// explored. Where that set is a single step, only the state it leads to is
// handed out, and so on: a chain of such steps becomes one, and what lies
// between is never stored (after Kurshan, Levin, Minea, Peled and Yenigun,
// "Static partial order reduction", TACAS 1998, and Laarman, "Stubborn
// transaction reduction", NFM 2018). Each of the two alone saves little;
// together they leave about the states in which a tree chooses.
#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <optional>
#include <vector>

#include "explore/reduce/ample_sets.hpp"
#include "explore/state/step.hpp"

namespace btcheck {

// A network, or with ample sets its reduction, as a TransitionSystem. A step of
// a reduction stands for a single one and the chain that follows it, which
// takes no time; `single_steps` tells them one by one. A view: what it is made
// of must outlive it.
class ReducedNetwork {
 public:
  // Every step of the network.
  ReducedNetwork(const CompiledNetwork& network)  // NOLINT: a network is one
      : network_(&network) {}
  ReducedNetwork(const CompiledNetwork& network, const AmpleSets& ample)
      : network_(&network), ample_(ample.empty() ? nullptr : &ample) {}

  const CompiledNetwork& network() const { return *network_; }
  bool is_reduced() const { return ample_ != nullptr; }
  std::size_t word_count() const { return network_->word_count(); }
  PropositionSet label(StateView) const { return 0; }

  template <class Found>
  void initial_states(Found&& found) const {
    network_->initial_states(found);
  }

  template <class Stepped>
  void successors(StateView state, Stepped&& stepped) const {
    successors(state, stepped, [](StateView, Step, StateView) {});
  }

  // The same; before each stepped(…), passed(before, step, after) is called for
  // the single steps that it stands for.
  template <class Stepped, class Passed>
  void successors(StateView state, Stepped&& stepped, Passed&& passed) const {
    Choice choice;
    if (ample_ != nullptr && !network_->is_preempted(state)) {
      choice = choose(state);
    }
    if (choice.edges == 0) {
      network_->successors(state, [&](StateView target, Step step) {
        follow(state, target, step, stepped, passed);
      });
      return;
    }
    Buffer next(state.size());
    network_->open_edges(state, choice.automaton, [&](std::uint32_t place) {
      std::ranges::copy(state, next.begin());
      network_->fire(place, {next.data(), next.size()});
      follow(state, view_of(next), {network_->edge_number(place), 0, true},
             stepped, passed);
    });
  }

  // The single steps behind one of a reduction, each with the state it leads
  // to; the last of them is `to`.
  std::vector<RunState> single_steps(StateView from, Step step,
                                     StateView to) const;
  // The single steps from a state up to the first that takes the edge, which
  // one of its steps must stand for: in that state, where one is given.
  std::vector<RunState> steps_up_to(StateView from, std::uint32_t edge,
                                    StateView in = {}) const;

 private:
  using Buffer = boost::container::small_vector<Word, 16>;

  // The ample set chosen in a state: the open edges of one automaton.
  struct Choice {
    AutomatonId automaton{};
    std::uint32_t edges = 0;  // how many; 0: everything has to be explored
    std::uint32_t place = 0;  // of one of them
    bool is_last = false;     // no other automaton has an ample set
  };
  // In a state that is not preempted. `hint` is looked at first: in a chain it
  // is nearly always the one.
  Choice choose(StateView state, std::optional<AutomatonId> hint = {}) const;
  Choice choice_of(StateView state, AutomatonId automaton) const;
  bool is_contested(StateView state, const AmpleSets::Rule& rule) const;

  // The single steps of the first chain for which is_chain(target, step) holds,
  // or up to the first single step for which is_step(single) does.
  template <class IsChain, class IsStep>
  std::vector<RunState> steps_until(StateView from, IsChain is_chain,
                                    IsStep is_step) const;

  // Hands out the end of the chain that `target`, reached from `from` by
  // `step`, begins.
  template <class Stepped, class Passed>
  void follow(StateView from, StateView target, Step step, Stepped& stepped,
              Passed& passed) const {
    passed(from, step, target);
    if (ample_ == nullptr || network_->is_preempted(target)) {
      return stepped(target, step);
    }
    Buffer here(target.begin(), target.end());
    Buffer before;
    std::optional<AutomatonId> hint;
    if (step.edge != kTimeStep) hint = ample_->next_mover(step.edge);
    for (;;) {
      const Choice choice = choose(view_of(here), hint);
      if (choice.edges != 1) break;
      before = here;
      network_->fire(choice.place, {here.data(), here.size()});
      // Back at the start after a round that took time: not an idle step.
      if (step.edge == kTimeStep && std::ranges::equal(here, from)) {
        here.swap(before);
        break;
      }
      const Step single{network_->edge_number(choice.place), 0, true};
      passed(view_of(before), single, view_of(here));
      step.progress = true;
      if (network_->may_preempt(choice.place) &&
          network_->is_preempted(view_of(here))) {
        break;
      }
      hint = ample_->next_mover(single.edge);
    }
    stepped(view_of(here), step);
  }

  const CompiledNetwork* network_;
  const AmpleSets* ample_ = nullptr;
};

// The same run with every single step told.
Lasso in_single_steps(const ReducedNetwork& system, const Lasso& run);

}  // namespace btcheck
