// SPDX-License-Identifier: MIT
//
// Leaves without a robot: they answer what a script says, or what chance does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "check/simulate/script.hpp"
#include "explore/state/split_mix.hpp"
#include "explore/state/step.hpp"
#include "model/tree/tree.hpp"
#include "run/engine/leaves.hpp"

namespace btcheck {

// As ScriptPlayer has it: each answer of a leaf takes one result of its
// sequence; what the script is silent about is what the model takes first. Tree
// and script must outlive it.
class ScriptedLeaves : public Leaves {
 public:
  ScriptedLeaves(const BehaviorTree& tree, const SimulationScript& script)
      : tree_(tree), cursors_(script) {}

  Reply ask(const LeafQuestion& question) override;
  Reply refused(const LeafQuestion& question) override { return ask(question); }
  std::optional<VariableMove> next_move(int tick, StateView now) override;
  bool lets_variables_move() const override { return true; }

 private:
  const BehaviorTree& tree_;
  ScriptCursors cursors_;
  int moved_in_tick_ = 0;          // the tick for which variables have moved,
  std::size_t next_variable_ = 0;  // and the first that has not
};

// One of the answers that the model allows, each as likely as the others; free
// variables change now and then. The same run for the same seed.
class RandomLeaves : public Leaves {
 public:
  RandomLeaves(const BehaviorTree& tree, const CompiledNetwork& system,
               std::uint64_t seed)
      : tree_(tree), system_(system), random_(seed) {}

  Reply ask(const LeafQuestion& question) override;
  Reply refused(const LeafQuestion&) override { return {}; }
  std::optional<VariableMove> next_move(int tick, StateView now) override;
  bool lets_variables_move() const override { return true; }

 private:
  const BehaviorTree& tree_;
  const CompiledNetwork& system_;
  SplitMix64 random_;
  int moved_in_tick_ = 0;
};

}  // namespace btcheck
