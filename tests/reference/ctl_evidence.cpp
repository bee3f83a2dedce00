// SPDX-License-Identifier: MIT
//
// A path as evidence. A claim is shown at a position when it is one of those
// left unshown there, or a matter of labels, or follows from claims about
// operands that are shown: for a quantifier, at this and later positions of
// the path, once round the cycle being enough. Recursive, straight from the
// definitions, and each operator told both ways.
#include "reference/ctl_evidence.hpp"

#include <algorithm>
#include <functional>
#include <vector>

namespace btcheck::reference {

namespace {

class Evidence {
 public:
  Evidence(const ToySystem& system, const FormulaPool& pool,
           const GraphPath& path)
      : system_(system), pool_(pool), path_(path) {}

  bool shows(FormulaId id, bool holds, std::size_t at) const {
    for (const Unshown& left : path_.unshown) {
      if (left.claim == Claim{id, holds} && left.first <= at &&
          at <= left.last) {
        return true;
      }
    }
    const FormulaNode& node = pool_[id];
    switch (node.kind) {
      case FormulaKind::True:
        return holds;
      case FormulaKind::False:
        return !holds;
      case FormulaKind::Atom: {
        const auto label = system_.label_of(index(path_.states[at]));
        return (label >> node.atom & 1) == (holds ? 1u : 0u);
      }
      case FormulaKind::ExistsPath:
      case FormulaKind::ForAllPaths:
        return holds == (node.kind == FormulaKind::ExistsPath) &&
               shows_run(pool_[node.left], holds, at);
      default:
        return shows_boolean(node, holds, at);
    }
  }

 private:
  bool shows_boolean(const FormulaNode& node, bool holds,
                     std::size_t at) const {
    const auto left = [&](bool value) { return shows(node.left, value, at); };
    const auto right = [&](bool value) { return shows(node.right, value, at); };
    switch (node.kind) {
      case FormulaKind::Not:
        return left(!holds);
      case FormulaKind::And:
        return holds ? left(true) && right(true) : left(false) || right(false);
      case FormulaKind::Or:
        return holds ? left(true) || right(true) : left(false) && right(false);
      case FormulaKind::Implies:
        return holds ? left(false) || right(true) : left(true) && right(false);
      default:  // Equivalent
        return (left(true) && right(holds)) || (left(false) && right(!holds));
    }
  }

  // The positions of the run from `at` on, each once.
  std::vector<std::size_t> from(std::size_t at) const {
    std::vector<std::size_t> positions;
    for (std::size_t i = at; i < path_.states.size(); ++i) {
      positions.push_back(i);
    }
    // A finite path has a loop greater than any position.
    for (std::size_t i = path_.loop; i < at; ++i) positions.push_back(i);
    return positions;
  }

  using At = std::function<bool(std::size_t)>;

  bool until(std::size_t at, const At& hold, const At& target) const {
    for (const std::size_t i : from(at)) {
      if (target(i)) return true;
      if (!hold(i)) return false;
    }
    return false;
  }
  bool always(std::size_t at, const At& hold) const {
    if (path_.loop == GraphPath::kFinite) return false;
    const std::vector<std::size_t> positions = from(at);
    return std::all_of(positions.begin(), positions.end(), hold);
  }
  bool next(std::size_t at, const At& target) const {
    const std::size_t after =
        at + 1 < path_.states.size() ? at + 1 : path_.loop;
    return after != GraphPath::kFinite && target(after);
  }

  bool shows_run(const FormulaNode& path, bool holds, std::size_t at) const {
    const At left = [&](std::size_t i) { return shows(path.left, holds, i); };
    const At right = [&](std::size_t i) { return shows(path.right, holds, i); };
    const At both = [&](std::size_t i) { return left(i) && right(i); };
    const At any = [](std::size_t) { return true; };
    switch (path.kind) {
      case FormulaKind::Next:
        return next(at, left);
      case FormulaKind::Eventually:
        return holds ? until(at, any, left) : always(at, left);
      case FormulaKind::Always:
        return holds ? always(at, left) : until(at, any, left);
      case FormulaKind::Until:
        return holds ? until(at, left, right)
                     : until(at, right, both) || always(at, right);
      case FormulaKind::WeakUntil:
        return holds ? until(at, left, right) || always(at, left)
                     : until(at, right, both);
      default:  // Release
        return holds ? until(at, right, both) || always(at, right)
                     : until(at, left, right);
    }
  }

  const ToySystem& system_;
  const FormulaPool& pool_;
  const GraphPath& path_;
};

bool has_step(const ToySystem& system, StateId from, StateId to) {
  const auto& steps = system.steps(index(from));
  return std::any_of(
      steps.begin(), steps.end(),
      [&](const ToySystem::ToyStep& step) { return step.target == index(to); });
}

bool is_path(const ToySystem& system, const GraphPath& path) {
  for (std::size_t i = 1; i < path.states.size(); ++i) {
    if (!has_step(system, path.states[i - 1], path.states[i])) return false;
  }
  if (path.loop == GraphPath::kFinite) return true;
  return path.loop < path.states.size() &&
         has_step(system, path.states.back(), path.states[path.loop]);
}

// The steps of the cycle that are meant make progress somewhere.
bool makes_progress(const ToySystem& system, const GraphPath& path) {
  for (std::size_t i = path.loop; i < path.states.size(); ++i) {
    const std::size_t after = i + 1 < path.states.size() ? i + 1 : path.loop;
    for (const ToySystem::ToyStep& step : system.steps(index(path.states[i]))) {
      if (step.step.progress && step.target == index(path.states[after])) {
        return true;
      }
    }
  }
  return false;
}

bool is_cycle_fair(const ToySystem& system, const GraphPath& path,
                   const std::vector<NaiveFairness>& conditions) {
  StateMask seen = 0;
  for (std::size_t i = path.loop; i < path.states.size(); ++i) {
    seen |= StateMask{1} << index(path.states[i]);
  }
  for (const NaiveFairness& condition : conditions) {
    if ((seen & condition.requested) != 0 && (seen & condition.granted) == 0) {
      return false;
    }
  }
  return makes_progress(system, path);
}

bool is_unshown_true(const NaiveCtl& naive, const FormulaPool& pool,
                     const GraphPath& path) {
  for (const Unshown& left : path.unshown) {
    const StateMask where = naive.satisfying(pool, left.claim.formula);
    if (left.first > left.last || left.last >= path.states.size()) return false;
    for (std::size_t i = left.first; i <= left.last; ++i) {
      const bool holds = (where >> index(path.states[i]) & 1) != 0;
      if (holds != left.claim.holds) return false;
    }
  }
  return true;
}

}  // namespace

const char* flaw(const ToySystem& system, const NaiveCtl& naive,
                 const std::vector<NaiveFairness>& conditions,
                 const FormulaPool& pool, const GraphPath& path, Claim claim,
                 std::uint32_t start) {
  if (path.states.empty()) return "it is empty";
  if (index(path.states.front()) != start) return "it begins elsewhere";
  if (!is_path(system, path)) return "it is no path";
  if (path.loop == GraphPath::kFinite) {
    const StateMask fair = naive.fair_within(~StateMask{0});
    const bool goes_on = (fair >> index(path.states.back()) & 1) != 0;
    if (path.states.size() > 1 && !goes_on) return "no fair run goes on";
  } else if (!is_cycle_fair(system, path, conditions)) {
    return "its cycle is not fair";
  }
  if (!is_unshown_true(naive, pool, path)) return "it leaves a lie unshown";
  const Evidence evidence(system, pool, path);
  if (!evidence.shows(claim.formula, claim.holds, 0)) return "it is no proof";
  return nullptr;
}

}  // namespace btcheck::reference
