// SPDX-License-Identifier: MIT
//
// What the written-out space of a network says of a property.
//
// State properties by looking at every state; timed responses and formulas as
// toy systems are checked, by late_response.hpp and tableau.hpp. The toy
// system has the states in reverse order, so that most steps lead to a smaller
// number: the fixpoints of fair_graph.hpp then need few rounds.
#include "reference/naive_verdict.hpp"

#include <algorithm>

#include "reference/late_response.hpp"
#include "reference/tableau.hpp"

namespace btcheck::reference {
namespace {

bool is_true(const FormulaPool& pool, FormulaId id, PropositionSet atoms) {
  const FormulaNode& node = pool[id];
  switch (node.kind) {
    case FormulaKind::True:
      return true;
    case FormulaKind::Atom:
      return (atoms >> node.atom & 1) != 0;
    case FormulaKind::Not:
      return !is_true(pool, node.left, atoms);
    case FormulaKind::And:
      return is_true(pool, node.left, atoms) &&
             is_true(pool, node.right, atoms);
    case FormulaKind::Or:
      return is_true(pool, node.left, atoms) ||
             is_true(pool, node.right, atoms);
    case FormulaKind::Implies:
      return !is_true(pool, node.left, atoms) ||
             is_true(pool, node.right, atoms);
    case FormulaKind::Equivalent:
      return is_true(pool, node.left, atoms) ==
             is_true(pool, node.right, atoms);
    default:
      return false;
  }
}

ToySystem toy_system(const Network& network, const NaiveSpace& space,
                     const std::vector<PropositionSet>& labels) {
  ToySystem toy;
  const std::size_t count = space.states.size();
  const bool has_time = network.ticks != TickSemantics::None;
  for (std::size_t i = count; i-- > 0;) {
    std::vector<ToySystem::ToyStep> steps;
    for (const NaiveSpace::Step& step : space.steps[i]) {
      const bool elapses = !step.edge && has_time;
      steps.push_back({static_cast<std::uint32_t>(count - 1 - step.target),
                       {step.edge.value_or(kTimeStep),
                        static_cast<std::uint8_t>(elapses), step.progress}});
    }
    toy.add(labels[i], std::move(steps));
  }
  toy.add_initial(static_cast<std::uint32_t>(count - 1));
  return toy;
}

bool is_answered(const Network& network, const NaiveSpace& space,
                 const RandomProperty& property,
                 const std::vector<PropositionSet>& labels) {
  std::vector<PropositionSet> ends;
  for (const PropositionSet label : labels) {
    ends.push_back(
        PropositionSet{is_true(property.pool, property.formula, label)} |
        PropositionSet{is_true(property.pool, property.answer, label)} << 1);
  }
  return !late_response(toy_system(network, space, ends),
                        {.from = property.from, .to = property.to})
              .exists;
}

bool all_runs_satisfy(const Network& network, const NaiveSpace& space,
                      const RandomProperty& property,
                      const std::vector<PropositionSet>& labels) {
  FormulaPool pool = property.pool;
  const FormulaId negated = pool.unary(FormulaKind::Not, property.formula);
  return !some_run_satisfies(toy_system(network, space, labels), pool, negated);
}

}  // namespace

std::optional<bool> naive_verdict(const BehaviorTree& tree,
                                  const Network& network,
                                  const NaiveSpace& space,
                                  const RandomProperty& property) {
  std::vector<PropositionSet> labels(space.states.size(), 0);
  for (std::size_t a = 0; a < property.atoms.size(); ++a) {
    const auto test = property.atoms[a].test(tree, network);
    if (!test) return std::nullopt;
    for (std::size_t s = 0; s < labels.size(); ++s) {
      labels[s] |= PropositionSet{(*test)(space, s)} << a;
    }
  }
  const auto some_state_is = [&](bool value) {
    return std::ranges::any_of(labels, [&](PropositionSet label) {
      return is_true(property.pool, property.formula, label) == value;
    });
  };
  switch (property.form) {
    case PropertyForm::Never:
      return !some_state_is(true);
    case PropertyForm::Invariant:
      return !some_state_is(false);
    case PropertyForm::Possible:
      return some_state_is(true);
    case PropertyForm::DeadlockFree:
      return std::ranges::count(space.dead, true) == 0;
    case PropertyForm::Timed:
      return is_answered(network, space, property, labels);
    default:
      return all_runs_satisfy(network, space, property, labels);
  }
}

// --- Without a property file ---------------------------------------------

namespace {

bool is_at(const Automaton& automaton, const NaiveState& state,
           std::string_view word) {
  const auto place = static_cast<std::size_t>(state.value(automaton.location));
  return automaton.locations.at(place) == word;
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
  return std::ranges::any_of(space.states, [&](const NaiveState& state) {
    return is_at(automaton, state, word);
  });
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
