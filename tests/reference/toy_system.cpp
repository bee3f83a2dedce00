// SPDX-License-Identifier: MIT
//
// Random toy systems, and whether a lasso is a run of one.
#include "reference/toy_system.hpp"

#include <algorithm>

namespace btcheck::reference {

ToySystem random_system(std::mt19937& random, std::uint32_t atoms,
                        Justice justice) {
  const auto below = [&](std::uint32_t bound) {
    return static_cast<std::uint32_t>(random() % bound);
  };
  ToySystem system;
  const std::uint32_t size = 3 + below(6);
  for (std::uint32_t i = 0; i < size; ++i) system.add(below(1u << atoms));
  std::uint32_t edge = 0;
  for (std::uint32_t i = 0; i < size; ++i) {
    for (std::uint32_t count = 1 + below(3); count > 0; --count) {
      const bool takes_time = below(3) == 0;
      const bool progress =
          justice == Justice::EveryStepIsProgress || below(5) != 0;
      system.add_step(i, below(size),
                      {takes_time ? kTimeStep : edge++,
                       static_cast<std::uint8_t>(takes_time), progress});
    }
  }
  system.add_initial(below(size));
  if (below(4) == 0) system.add_initial(below(size));
  return system;
}

bool has_step(const ToySystem& system, StateView from, StateView to,
              Step step) {
  const auto& steps = system.steps(from[0]);
  return std::any_of(
      steps.begin(), steps.end(), [&](const ToySystem::ToyStep& candidate) {
        return candidate.target == to[0] && candidate.step == step;
      });
}

bool is_run(const ToySystem& system, const Lasso& lasso) {
  if (lasso.prefix.empty()) return false;
  const auto& initial = system.initial();
  const Word first = lasso.prefix.front().state[0];
  if (std::find(initial.begin(), initial.end(), first) == initial.end()) {
    return false;
  }
  std::vector<RunState> run = lasso.prefix;
  run.insert(run.end(), lasso.cycle.begin(), lasso.cycle.end());
  for (std::size_t i = 1; i < run.size(); ++i) {
    if (!has_step(system, run[i - 1].state, run[i].state, run[i].step)) {
      return false;
    }
  }
  return lasso.cycle.empty() ||
         has_step(system, run.back().state, lasso.cycle.front().state,
                  lasso.closing);
}

bool is_fair(const Lasso& lasso) {
  if (lasso.closing.progress) return true;
  return std::any_of(lasso.cycle.begin() + 1, lasso.cycle.end(),
                     [](const RunState& next) { return next.step.progress; });
}

}  // namespace btcheck::reference
