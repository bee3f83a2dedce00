// SPDX-License-Identifier: MIT
//
// Model checking of toy systems by tableau.
//
// The declarative tableau (Clarke, Grumberg and Hamaguchi, CAV 1994): a node
// is a state together with a guess, for each temporal subformula, of what it
// is at the next position; all guesses are tried. The truth of the formula at
// a node follows from label and guess by the expansion laws, a step is allowed
// if it keeps the guess, and one acceptance set for each operator excludes
// that its expansion is put off for ever. Exponential, and without any of the
// ideas of src/ltl/: no normal form, no rewriting, no alternating automaton.
#include "reference/tableau.hpp"

#include <algorithm>
#include <vector>

#include "reference/fair_graph.hpp"

namespace btcheck::reference {

namespace {

using Truth = std::vector<bool>;  // by formula

class Tableau {
 public:
  Tableau(const ToySystem& system, const FormulaPool& pool, FormulaId root)
      : system_(system), pool_(pool), root_(root), nodes_(pool.nodes(root)) {
    for (const FormulaId id : nodes_) {
      if (pool_[id].kind >= FormulaKind::Next) temporal_.push_back(id);
    }
    guesses_ = std::size_t{1} << temporal_.size();
  }

  // By state, whether a run from it satisfies the root and the conditions: each
  // of these is granted for ever, or at last requested no more. All choices are
  // tried; what is requested no more takes nodes out of the part of the graph
  // in which the run stays at last.
  std::vector<bool> states(const std::vector<Condition>& conditions) const {
    const FairGraph graph = build();
    std::vector<bool> result(system_.size());
    for (std::size_t avoided = 0; avoided < std::size_t{1} << conditions.size();
         ++avoided) {
      const std::vector<bool> fair = leading_to(
          graph, states_with_fair_run(part_of(graph, conditions, avoided)));
      for (std::size_t node = 0; node < fair.size(); ++node) {
        if (fair[node] &&
            truth(node / guesses_, node % guesses_)[index(root_)]) {
          result[node / guesses_] = true;
        }
      }
    }
    return result;
  }

 private:
  Truth truth(std::size_t state, std::size_t guess) const {
    Truth truth(index(root_) + 1);
    std::size_t next_temporal = 0;
    for (const FormulaId id : nodes_) {
      const FormulaNode& node = pool_[id];
      const bool left = truth[index(node.left)];
      const bool right = truth[index(node.right)];
      bool next = false;
      if (node.kind >= FormulaKind::Next) next = guess >> next_temporal++ & 1;
      truth[index(id)] = expanded(node, state, left, right, next);
    }
    return truth;
  }

  bool expanded(const FormulaNode& node, std::size_t state, bool left,
                bool right, bool next) const {
    switch (node.kind) {
      case FormulaKind::True:
        return true;
      case FormulaKind::False:
        return false;
      case FormulaKind::Atom:
        return system_.label_of(state) >> node.atom & 1;
      case FormulaKind::Not:
        return !left;
      case FormulaKind::And:
        return left && right;
      case FormulaKind::Or:
        return left || right;
      case FormulaKind::Implies:
        return !left || right;
      case FormulaKind::Equivalent:
        return left == right;
      case FormulaKind::Next:
        return next;
      case FormulaKind::Eventually:
        return left || next;
      case FormulaKind::Always:
        return left && next;
      case FormulaKind::Until:
      case FormulaKind::WeakUntil:
        return right || (left && next);
      case FormulaKind::Release:
        return right && (left || next);
      case FormulaKind::ExistsPath:
      case FormulaKind::ForAllPaths:
        break;  // not a question about one run
    }
    return false;
  }

  // True where the operator does not put off its expansion.
  bool is_settled(FormulaId id, const Truth& truth) const {
    const FormulaNode& node = pool_[id];
    const bool itself = truth[index(id)];
    const bool left = truth[index(node.left)];
    const bool right = truth[index(node.right)];
    switch (node.kind) {
      case FormulaKind::Eventually:
        return !itself || left;
      case FormulaKind::Always:
        return itself || !left;
      case FormulaKind::Until:
        return !itself || right;
      case FormulaKind::WeakUntil:
        return itself || (!left && !right);
      case FormulaKind::Release:
        return itself || !right;
      default:
        return true;
    }
  }

  // What was guessed of the next position is so there.
  bool keeps(std::size_t guess, const Truth& truth_there) const {
    for (std::size_t i = 0; i < temporal_.size(); ++i) {
      const FormulaNode& node = pool_[temporal_[i]];
      const FormulaId what =
          node.kind == FormulaKind::Next ? node.left : temporal_[i];
      if (truth_there[index(what)] != ((guess >> i & 1) != 0)) return false;
    }
    return true;
  }

  FairGraph build() const {
    FairGraph graph;
    graph.steps.resize(system_.size() * guesses_);
    graph.all_sets = (AcceptanceSet{2} << temporal_.size()) - 1;
    std::vector<Truth> truths;
    for (std::size_t node = 0; node < graph.steps.size(); ++node) {
      truths.push_back(truth(node / guesses_, node % guesses_));
    }
    for (std::size_t node = 0; node < graph.steps.size(); ++node) {
      AcceptanceSet settled = 0;
      for (std::size_t i = 0; i < temporal_.size(); ++i) {
        if (is_settled(temporal_[i], truths[node])) {
          settled |= AcceptanceSet{2} << i;
        }
      }
      for (const ToySystem::ToyStep& step : system_.steps(node / guesses_)) {
        const AcceptanceSet progress = step.step.progress ? 1 : 0;
        for (std::size_t guess = 0; guess < guesses_; ++guess) {
          const std::size_t target = step.target * guesses_ + guess;
          if (!keeps(node % guesses_, truths[target])) continue;
          graph.steps[node].push_back({target, settled | progress});
        }
      }
    }
    return graph;
  }

  // Just the conditions of `avoided`, a bit each, are requested no more.
  FairGraph part_of(FairGraph graph, const std::vector<Condition>& conditions,
                    std::size_t avoided) const {
    const AcceptanceSet first = graph.all_sets + 1;
    graph.all_sets |= ((AcceptanceSet{1} << conditions.size()) - 1) * first;
    for (std::size_t node = 0; node < graph.steps.size(); ++node) {
      const PropositionSet label = system_.label_of(node / guesses_);
      AcceptanceSet sets = 0;
      bool is_out = false;
      for (std::size_t i = 0; i < conditions.size(); ++i) {
        const bool is_avoided = (avoided >> i & 1) != 0;
        const bool requests = (label >> conditions[i].requested & 1) != 0;
        const bool grants = (label >> conditions[i].granted & 1) != 0;
        is_out |= is_avoided && requests;
        if (is_avoided || grants) sets |= first << i;
      }
      if (is_out) graph.steps[node].clear();
      for (FairGraph::Step& step : graph.steps[node]) step.sets |= sets;
    }
    return graph;
  }

  static std::vector<bool> leading_to(const FairGraph& graph,
                                      std::vector<bool> goal) {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t node = 0; node < goal.size(); ++node) {
        if (goal[node]) continue;
        goal[node] = std::any_of(
            graph.steps[node].begin(), graph.steps[node].end(),
            [&](const FairGraph::Step& step) { return goal[step.target]; });
        changed = changed || goal[node];
      }
    }
    return goal;
  }

  const ToySystem& system_;
  const FormulaPool& pool_;
  const FormulaId root_;
  const std::vector<FormulaId> nodes_;
  std::vector<FormulaId> temporal_;
  std::size_t guesses_ = 1;
};

}  // namespace

std::vector<bool> states_satisfying(const ToySystem& system,
                                    const FormulaPool& pool, FormulaId id,
                                    const std::vector<Condition>& conditions) {
  return Tableau(system, pool, id).states(conditions);
}

bool some_run_satisfies(const ToySystem& system, const FormulaPool& pool,
                        FormulaId id) {
  const std::vector<bool> found = states_satisfying(system, pool, id, {});
  return std::any_of(system.initial().begin(), system.initial().end(),
                     [&](std::uint32_t initial) { return found[initial]; });
}

}  // namespace btcheck::reference
