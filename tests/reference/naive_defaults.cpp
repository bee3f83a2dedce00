// SPDX-License-Identifier: MIT
//
// What the written-out space of a network answers without a property file: by
// looking at every state and by plain reachability.
#include "reference/naive_defaults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace btcheck::reference {

namespace {

bool is_at(const Automaton& automaton, const NaiveState& state,
           std::string_view word) {
  const auto place = static_cast<std::size_t>(state.value(automaton.location));
  return automaton.locations.at(place).name == word;
}

struct Roots {
  int succeeded = 0;
  int failed = 0;
  bool ended = false;
};

Roots roots_in(const BehaviorTree& tree, const Network& network,
               const NaiveState& state) {
  Roots result;
  for (const NodeId root : tree.roots) {
    const Automaton& automaton =
        network.automaton(network.node_automaton[index(root)]);
    result.succeeded += is_at(automaton, state, "success") ? 1 : 0;
    result.failed += is_at(automaton, state, "failure") ? 1 : 0;
  }
  const int count = static_cast<int>(tree.roots.size());
  result.ended = result.succeeded + result.failed == count;
  return result;
}

using Steps = std::vector<NaiveSpace::Step>;

// By state, whether steps that `follow` admits lead to a state of the goal.
template <class Follow>
std::vector<bool> leads_to(const NaiveSpace& space, std::vector<bool> goal,
                           Follow follow) {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t s = goal.size(); s-- > 0;) {
      if (goal[s]) continue;
      goal[s] = std::ranges::any_of(space.steps[s],
                                    [&](const NaiveSpace::Step& step) {
                                      return follow(step) && goal[step.target];
                                    });
      changed = changed || goal[s];
    }
  }
  return goal;
}

// A tree edge from whose target steps that take no time lead back.
bool has_zero_time_loop(const NaiveSpace& space) {
  // Only states that never get out of steps without time can be on a loop.
  std::vector<bool> stays(space.states.size(), true);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t s = stays.size(); s-- > 0;) {
      const bool goes_on = std::ranges::any_of(
          space.steps[s], [&](const NaiveSpace::Step& step) {
            return step.edge && stays[step.target];
          });
      changed = changed || (stays[s] && !goes_on);
      stays[s] = stays[s] && goes_on;
    }
  }
  for (std::size_t s = 0; s < stays.size(); ++s) {
    for (const NaiveSpace::Step& step : space.steps[s]) {
      if (!step.edge || !step.progress || !stays[step.target]) continue;
      std::vector<bool> source(stays.size(), false);
      source[s] = true;
      const auto follow = [&](const NaiveSpace::Step& next) {
        return next.edge.has_value() && stays[next.target];
      };
      if (leads_to(space, source, follow)[step.target]) return true;
    }
  }
  return false;
}

}  // namespace

bool naive_answer(const Network& network, const NaiveSpace& space, NodeId node,
                  NodeQuestion question) {
  constexpr std::array<std::string_view, kNodeQuestionCount> kWords = {
      "tick_node", "success", "failure", "running", "halted"};
  const Automaton& automaton =
      network.automaton(network.node_automaton[index(node)]);
  const std::string_view word = kWords[static_cast<std::size_t>(question)];
  const auto found =
      std::ranges::find(automaton.locations, word, &Location::name);
  if (found == automaton.locations.end()) return false;
  const auto place = static_cast<int>(found - automaton.locations.begin());
  const auto is_there = [&](std::size_t state) {
    return space.states[state].value(automaton.location) == place;
  };
  for (std::size_t s = 0; s < space.states.size(); ++s) {
    for (const NaiveSpace::Step& step : space.steps[s]) {
      if (!is_there(s) && is_there(step.target)) return true;
    }
  }
  return false;
}

bool naive_answer(const BehaviorTree& tree, const Network& network,
                  const NaiveSpace& space, TreeQuestion question) {
  const NaiveNetwork naive(network);
  if (question == TreeQuestion::NoZeroTimeLoop) {
    return !has_zero_time_loop(space);
  }
  bool succeeds = false;
  bool fails = false;
  bool stuck = false;
  bool faulty = false;
  std::vector<bool> ended;
  std::vector<bool> succeeded;
  for (std::size_t s = 0; s < space.states.size(); ++s) {
    const Roots roots = roots_in(tree, network, space.states[s]);
    const bool has_fault = naive.is_faulty(space.states[s]);
    const int count = static_cast<int>(tree.roots.size());
    ended.push_back(roots.ended || has_fault);  // a fault is an end, too
    succeeded.push_back(roots.succeeded == count);
    succeeds = succeeds || succeeded.back();
    fails = fails || roots.failed > 0;
    faulty = faulty || has_fault;
    stuck = stuck || (space.dead[s] && !roots.ended && !has_fault);
  }
  if (question == TreeQuestion::CanSucceed) return succeeds;
  if (question == TreeQuestion::CanFail) return fails;
  if (question == TreeQuestion::NeverStuck) return !stuck;
  if (question == TreeQuestion::InRange) return !faulty;
  const auto any_step = [](const NaiveSpace::Step&) { return true; };
  const bool asks_of_end = question == TreeQuestion::CanAlwaysEnd;
  return std::ranges::count(
             leads_to(space, asks_of_end ? ended : succeeded, any_step),
             false) == 0;
}

std::string flaw_of(const DefaultReport& report, const BehaviorTree& tree,
                    const Network& network, const NaiveSpace& space) {
  if (!report.error.empty()) return report.error;
  const auto told = [](bool expected) {
    return expected ? "naively holds" : "naively violated";
  };
  for (const TreeReport& answer : report.tree) {
    const bool expected = naive_answer(tree, network, space, answer.question);
    if ((answer.verdict == Verdict::Holds) == expected) continue;
    return fmt::format("tree question {}: {}",
                       static_cast<int>(answer.question), told(expected));
  }
  for (const NodeReport& node : report.nodes) {
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      const bool expected =
          naive_answer(network, space, node.node, static_cast<NodeQuestion>(q));
      if ((node.answers[q].verdict == Verdict::Holds) == expected) continue;
      return fmt::format("{} {}: {}", unique_name(tree, node.node),
                         kNodeQuestionNames[q], told(expected));
    }
  }
  return {};
}

std::string broken_gate(const Network& network, const NaiveSpace& space) {
  for (const Automaton& automaton : network.automata) {
    if (!automaton.gate) continue;
    for (const NaiveState& state : space.states) {
      if (state.value(*automaton.gate) == 0 &&
          state.value(automaton.location) != 0) {
        return automaton.name;
      }
    }
  }
  return {};
}

}  // namespace btcheck::reference
