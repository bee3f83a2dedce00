// SPDX-License-Identifier: MIT
//
// The steps of a run as events of the tree.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "btcheck/run.hpp"
#include "explore/state/step.hpp"
#include "model/tree/tree.hpp"
#include "run/engine/leaf_table.hpp"
#include "run/engine/tree_engine.hpp"

namespace btcheck {

// Allocates nothing while it tells.
class EventTeller : public EngineObserver {
 public:
  using Told = std::function<void(const run::Event&)>;
  // Tree and system must outlive it.
  EventTeller(const BehaviorTree& tree, const CompiledNetwork& system,
              Told told);

  void began(StateView state) override;
  void stepped(StateView after, const Step& step) override;

 private:
  // What an edge means, by its number in the whole network.
  struct Meaning {
    bool is_told = false;
    NodeId node{};
    run::Event::Kind kind = run::Event::Kind::Ticked;
    run::Status status = run::Status::Running;
  };

  Meaning meaning_of(const Automaton& owner, const Edge& edge) const;
  void tell_changes(StateView after);

  const BehaviorTree& tree_;
  const CompiledNetwork& system_;
  Told told_;
  std::vector<Meaning> meanings_;
  std::vector<std::string> names_;               // by node
  std::vector<int> ticks_;                       // by node, of its root
  std::vector<NodeId> root_of_;                  // by node
  std::vector<int> values_;                      // of the state variables
  std::vector<std::vector<std::string>> words_;  // by variable, of its values
};

}  // namespace btcheck
