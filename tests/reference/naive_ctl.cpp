// SPDX-License-Identifier: MIT
//
// Every set of states is asked whether a fair run may see just its members
// again and again; strong connection is a closure of Warshall's. A path
// formula with one operator is a watcher that says of each state whether the
// run is won, lost, or still open, so E and A need no dual operators: some fair
// run is won (or open for ever, where that wins), or none is lost (or open for
// ever, where that loses). Nothing here knows of components, refinement,
// backward search or plans.
#include "reference/naive_ctl.hpp"

#include <utility>

namespace btcheck::reference {

namespace {

constexpr StateMask bit(std::size_t state) { return StateMask{1} << state; }
constexpr bool has(StateMask states, std::size_t state) {
  return (states & bit(state)) != 0;
}

// What a watcher says of states, once for all.
struct Watcher {
  StateMask won = 0;
  StateMask lost = 0;
  bool open_for_ever_wins = false;
};

Watcher watcher_of(FormulaKind kind, StateMask left, StateMask right) {
  switch (kind) {
    case FormulaKind::Eventually:
      return {left, 0, false};
    case FormulaKind::Always:
      return {0, ~left, true};
    case FormulaKind::Until:
      return {right, ~left & ~right, false};
    case FormulaKind::WeakUntil:
      return {right, ~left & ~right, true};
    default:  // Release: the right one up to and with the left one
      return {left & right, ~right, true};
  }
}

}  // namespace

NaiveCtl::NaiveCtl(const ToySystem& system,
                   std::vector<NaiveFairness> conditions)
    : system_(system),
      conditions_(std::move(conditions)),
      all_(bit(system.size()) - 1) {
  for (StateMask states = 1; states <= all_; ++states) {
    if (can_recur(states)) recurring_.push_back(states);
  }
}

bool NaiveCtl::can_recur(StateMask states) const {
  const std::size_t n = system_.size();
  std::vector<StateMask> reaches(n, 0);  // by at least one step inside
  bool progress = false;
  for (std::size_t s = 0; s < n; ++s) {
    if (!has(states, s)) continue;
    for (const ToySystem::ToyStep& step : system_.steps(s)) {
      if (!has(states, step.target)) continue;
      reaches[s] |= bit(step.target);
      progress = progress || step.step.progress;
    }
  }
  for (std::size_t by = 0; by < n; ++by) {
    for (std::size_t s = 0; s < n; ++s) {
      if (has(reaches[s], by)) reaches[s] |= reaches[by];
    }
  }
  for (std::size_t s = 0; s < n; ++s) {
    if (has(states, s) && reaches[s] != states) return false;
  }
  for (const NaiveFairness& condition : conditions_) {
    const bool is_requested = (states & condition.requested) != 0;
    if (is_requested && (states & condition.granted) == 0) return false;
  }
  return progress;
}

StateMask NaiveCtl::one_step_into(StateMask target) const {
  StateMask found = 0;
  for (std::size_t s = 0; s < system_.size(); ++s) {
    for (const ToySystem::ToyStep& step : system_.steps(s)) {
      if (has(target, step.target)) found |= bit(s);
    }
  }
  return found;
}

StateMask NaiveCtl::leading_to(StateMask hold, StateMask target) const {
  StateMask found = target;
  for (StateMask before = 0; before != found;) {
    before = found;
    found |= hold & one_step_into(found);
  }
  return found;
}

StateMask NaiveCtl::fair_within(StateMask hold) const {
  StateMask found = 0;
  for (const StateMask states : recurring_) {
    if ((states & ~hold) == 0) found |= leading_to(hold, states);
  }
  return found;
}

StateMask NaiveCtl::quantified(const FormulaPool& pool, FormulaId id) const {
  const bool exists = pool[id].kind == FormulaKind::ExistsPath;
  const FormulaNode& path = pool[pool[id].left];
  const StateMask left = satisfying(pool, path.left);
  const StateMask fair = fair_within(all_);
  if (path.kind == FormulaKind::Next) {
    return exists ? one_step_into(left & fair)
                  : all_ & ~one_step_into(all_ & ~left & fair);
  }
  const StateMask right =
      is_unary(path.kind) ? 0 : satisfying(pool, path.right);
  const Watcher watcher = watcher_of(path.kind, left, right);
  const StateMask open = all_ & ~watcher.won & ~watcher.lost;
  const StateMask for_ever = fair_within(open);
  if (exists) {
    const StateMask won = leading_to(open, watcher.won & fair);
    return watcher.open_for_ever_wins ? won | for_ever : won;
  }
  const StateMask lost = leading_to(open, all_ & watcher.lost & fair);
  return all_ & ~(watcher.open_for_ever_wins ? lost : lost | for_ever);
}

StateMask NaiveCtl::satisfying(const FormulaPool& pool, FormulaId id) const {
  const FormulaNode& node = pool[id];
  if (is_path_quantifier(node.kind)) return quantified(pool, id);
  if (node.kind == FormulaKind::True) return all_;
  if (node.kind == FormulaKind::False) return 0;
  if (node.kind == FormulaKind::Atom) {
    StateMask found = 0;
    for (std::size_t s = 0; s < system_.size(); ++s) {
      if ((system_.label_of(s) >> node.atom & 1) != 0) found |= bit(s);
    }
    return found;
  }
  const StateMask left = satisfying(pool, node.left);
  if (node.kind == FormulaKind::Not) return all_ & ~left;
  const StateMask right = satisfying(pool, node.right);
  switch (node.kind) {
    case FormulaKind::And:
      return left & right;
    case FormulaKind::Or:
      return left | right;
    case FormulaKind::Implies:
      return all_ & (~left | right);
    default:  // Equivalent
      return all_ & ~(left ^ right);
  }
}

}  // namespace btcheck::reference
