// SPDX-License-Identifier: MIT
//
// What the default report has to notice during its search.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "check/questions/defaults.hpp"
#include "check/questions/watches.hpp"
#include "explore/reduce/observed.hpp"
#include "explore/search/reachability.hpp"
#include "explore/search/stored_graph.hpp"
#include "explore/state/step.hpp"

namespace btcheck {

// A question of the search that is answered by the first state found.
using FirstState = std::optional<StateId>;
// Or by the first edge taken.
using FirstStep = std::optional<FoundStep>;

// What these questions must find in the states that are stored: what they ask
// of states, and beyond that what they look at when certain edges are taken.
Observed seen_by_default(const BehaviorTree& tree, const Network& network);
Observed kept_for_default(const BehaviorTree& tree, const Network& network);

// Watches the edges that fire for the questions of single nodes, the states for
// those of the tree, and keeps every step for those that need steps twice.
class DefaultQuestions : public ReachabilityVisitor {
 public:
  DefaultQuestions(const BehaviorTree& tree, const CompiledNetwork& system);

  void passed(StateId from, StateView before, Step step, StateView after);
  void stepped(StateId from, Step step, StateId to) {
    graph_.add(from, step, to);
  }
  GoOn expanded(StateId id, StateView state, bool is_dead);

  std::size_t bytes() const {
    return graph_.bytes() + (ended_.size() + succeeded_.size()) / 8;
  }

  const FirstStep& node(std::size_t n, std::size_t question) const {
    return nodes_[n][question];
  }
  const FirstState& success() const { return success_; }
  const FirstState& failure() const { return failure_; }
  const FirstState& fault() const { return fault_; }
  const FirstState& stuck() const { return stuck_; }
  const std::vector<bool>& ended() const { return ended_; }
  const std::vector<bool>& succeeded() const { return succeeded_; }
  const SecondTickWatch& second_ticks() const { return second_ticks_; }
  const LeftRunningWatch& left_running() const { return left_running_; }
  StoredGraph& graph() { return graph_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  void watch_node(const Automaton& automaton, std::uint32_t node);
  LocationRole role_in(const Automaton& root, StateView state) const;
  bool some_root_failed(StateView state) const;

  const CompiledNetwork& system_;
  std::vector<std::array<FirstStep, kNodeQuestionCount>> nodes_;
  std::vector<std::uint32_t> question_of_edge_;
  std::vector<const Automaton*> roots_;
  std::vector<bool> ended_;      // by state
  std::vector<bool> succeeded_;  // by state: all roots have
  SecondTickWatch second_ticks_;
  LeftRunningWatch left_running_;
  FirstState success_;
  FirstState failure_;
  FirstState fault_;
  FirstState stuck_;
  StoredGraph graph_;
};

}  // namespace btcheck
