// SPDX-License-Identifier: MIT
//
// A run of the network in words: each step alone, and the whole as a run that
// stands for itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

struct TreeInput;

// What a step means to a reader of the tree.
struct Event {
  std::string text;        // "start_drone -> success"
  bool is_chosen = false;  // by the world outside, not by the tree
};

// The event of a step from `before` to step.after; nothing for a step that is
// the mapping's own business (calling a child, handing control back, …).
std::optional<Event> event_of(const BehaviorTree& tree, const Network& network,
                              const Valuation& before, const RunStep& step);

// The text of a step of time.
inline constexpr std::string_view kTimePasses = "time passes";

// Any step at all: "Sequence17_btn6: start_ -> tick_node", "time passes".
std::string step_text(const Network& network, const RunStep& step);

// The states of a run, one after another, as its steps are taken: what a node
// did last is remembered on the way.
class StateRecorder {
 public:
  // Both must outlive it.
  StateRecorder(const BehaviorTree& tree, const Network& network);

  // The state that a run begins in.
  RecordedState begin(const Valuation& state) const;
  // The next one: a step was taken in `before`, and led to step.after.
  RecordedState take(const Valuation& before, const RunStep& step);
  // The same without what its nodes are in.
  RecordedState take_step(const Valuation& before, const RunStep& step);

 private:
  std::string_view location(NodeId node, const Valuation& state) const;
  int status(NodeId node, const Valuation& state) const;
  void note(const RunStep& step, RecordedState& state);
  void show(const Valuation& state, RecordedState& shown) const;
  bool is_ticked(NodeId node, const Valuation& state) const;
  bool is_halting(NodeId node, const Valuation& state) const;
  Phase phase(NodeId node, const Valuation& state) const;

  const BehaviorTree& tree_;
  const Network& network_;
  std::vector<std::uint32_t> root_of_;  // by node
  int time_ = 0;
  std::vector<Phase> last_;     // by node
  std::vector<int> last_tick_;  // of its root, when that was
  std::vector<int> ticks_;      // by root
  int tick_ = 0;                // of them the greatest
};

// What is not read off the run. Its states are as in RecordedRun.
struct RunHeading : RunWords {
  std::vector<WatchedPart> watched = {};
  std::optional<std::size_t> trigger = {};
  std::optional<std::size_t> lost = {};
};

// The texts of the tree's file, and of the included ones that nodes stand in.
void add_sources(RunWords& words, const BehaviorTree& tree,
                 const TreeInput& input);

// The tree alone, without a state.
RecordedRun recorded_tree(const BehaviorTree& tree, const TreeInput& input);

// A run without its states.
RecordedRun recorded_heading(const BehaviorTree& tree, const Network& network,
                             const RunWords& words);

RecordedRun recorded(const BehaviorTree& tree, const Network& network,
                     const Run& run, const RunHeading& heading);
// Without a heading, and of no state but the last what its nodes are in: all
// that a text of its steps takes.
RecordedRun recorded_steps(const BehaviorTree& tree, const Network& network,
                           const Run& run);

// One of many runs, of which no property is checked; `how` it was made: "seed
// 7", "by hand".
RecordedRun recorded_simulation(const BehaviorTree& tree,
                                const Network& network, const TreeInput& input,
                                const Run& run, const std::string& how);

}  // namespace btcheck
