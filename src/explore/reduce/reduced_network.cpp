// SPDX-License-Identifier: MIT
//
// Which ample set, where there are several: one of a single step if there is
// any, since chains cost nothing; else the first in node order.
#include "explore/reduce/reduced_network.hpp"

#include <cassert>
#include <iterator>

namespace btcheck {
namespace {

constexpr auto kNever = [](auto&&...) { return false; };

}  // namespace

// The automaton's open edges, if they are an ample set.
ReducedNetwork::Choice ReducedNetwork::choice_of(StateView state,
                                                 AutomatonId automaton) const {
  const AmpleSets::Rule& rule =
      ample_->rule(automaton, network_->location(state, automaton));
  Choice choice{automaton, 0, 0, false};
  if (!rule.may_be_ample ||
      (rule.due > 0 && network_->clock(state, automaton) != rule.due)) {
    return choice;
  }
  bool is_visible = false;
  network_->open_edges(state, automaton, [&](std::uint32_t place) {
    ++choice.edges;
    choice.place = place;
    is_visible |= ample_->is_visible(network_->edge_number(place));
  });
  const bool moves = choice.edges > 0;
  if (is_visible || (moves && is_contested(state, rule))) choice.edges = 0;
  choice.is_last = choice.edges == 1 || (moves && ample_->is_sequential());
  return choice;
}

ReducedNetwork::Choice ReducedNetwork::choose(
    StateView state, std::optional<AutomatonId> hint) const {
  Choice chosen;
  if (hint && network_->is_open(state, *hint)) {
    chosen = choice_of(state, *hint);
    if (chosen.is_last) return chosen;
    chosen = {};
  }
  network_->for_each_open(state, [&](AutomatonId automaton) {
    const Choice choice = choice_of(state, automaton);
    const bool is_better = choice.edges == 1 || chosen.edges == 0;
    if (choice.edges > 0 && is_better) chosen = choice;
    return choice.is_last ? GoOn::No : GoOn::Yes;
  });
  return chosen;
}

// Whether a rival may come to touch what the rule's edges touch.
bool ReducedNetwork::is_contested(StateView state,
                                  const AmpleSets::Rule& rule) const {
  return std::ranges::any_of(rule.rivals, [&](const AmpleSets::Rival& rival) {
    const AutomatonId who = rival.automaton;
    return network_->is_open(state, who) &&
           rival.dangerous[index(network_->location(state, who))] &&
           !network_->is_at_rest(state, who);
  });
}

template <class IsChain, class IsStep>
std::vector<RunState> ReducedNetwork::steps_until(StateView from,
                                                  IsChain is_chain,
                                                  IsStep is_step) const {
  std::vector<RunState> steps;
  bool is_found = false;
  successors(
      from,
      [&](StateView target, Step step) {
        is_found = is_found || is_chain(target, step);
        if (!is_found) steps.clear();
      },
      [&](StateView before, Step single, StateView after) {
        if (is_found) return;
        steps.push_back({StateVector(after.begin(), after.end()), single});
        is_found = is_step(before, single);
      });
  assert(is_found);
  return steps;
}

std::vector<RunState> ReducedNetwork::single_steps(StateView from, Step step,
                                                   StateView to) const {
  const auto is_it = [&](StateView target, Step taken) {
    return taken == step && std::ranges::equal(target, to);
  };
  return steps_until(from, is_it, kNever);
}

std::vector<RunState> ReducedNetwork::steps_up_to(StateView from,
                                                  std::uint32_t edge,
                                                  StateView in) const {
  const auto is_it = [&](StateView before, Step single) {
    return single.edge == edge &&
           (in.empty() || std::ranges::equal(before, in));
  };
  return steps_until(from, kNever, is_it);
}

// A chain into the cycle's first state is part of the prefix but for its last
// step, and so is one back to it part of the cycle.
Lasso in_single_steps(const ReducedNetwork& system, const Lasso& run) {
  if (!system.is_reduced()) return run;
  Lasso told;
  told.prefix.push_back(run.prefix.front());
  StateView from = run.prefix.front().state;
  const auto tell = [&](const StateVector& to, Step step,
                        std::vector<RunState>& onto) {
    std::vector<RunState> steps = system.single_steps(from, step, to);
    from = to;
    RunState last = std::move(steps.back());
    steps.pop_back();
    std::move(steps.begin(), steps.end(), std::back_inserter(onto));
    return last;
  };
  for (const RunState& to : std::span(run.prefix).subspan(1)) {
    told.prefix.push_back(tell(to.state, to.step, told.prefix));
  }
  if (run.cycle.empty()) return told;
  const RunState& first = run.cycle.front();
  told.cycle.push_back(tell(first.state, first.step, told.prefix));
  for (const RunState& to : std::span(run.cycle).subspan(1)) {
    told.cycle.push_back(tell(to.state, to.step, told.cycle));
  }
  told.closing = tell(first.state, run.closing, told.cycle).step;
  return told;
}

}  // namespace btcheck
