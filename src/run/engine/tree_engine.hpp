// SPDX-License-Identifier: MIT
//
// A tree that runs: the network that is searched, stepped with the compiled
// steps of the search, and leaves that answer for the world outside.
//
// Every run of an engine is a run of the network. Where several steps could be
// taken, one order is kept (docs/run.md): a timer that has reached its
// deadline; else the node with the least process number; time passes when no
// node can go on; a free variable changes when the first tree begins a tick. It
// is the order of `simulate --script`. The paper's engine, Hippo, runs its
// models likewise (section 3.7): all but Action and Condition is the model's
// own.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "explore/state/step.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "run/engine/leaf_table.hpp"
#include "run/engine/leaves.hpp"

namespace btcheck {

// Sees every step, as it is taken: what records, shows and watches a run. The
// views die with the call.
class EngineObserver {
 public:
  virtual ~EngineObserver() = default;

  virtual void began(StateView) {}
  // The step was taken, and led there.
  virtual void stepped(StateView /*after*/, const Step&) {}
  virtual void breached(const Breach&) {}
  // A leaf is told to stop outside of the model: the run is over.
  virtual void stopped(NodeId) {}
};

enum class EngineState : std::uint8_t {
  Ready,    // for the next tick
  Ended,    // every root has succeeded or failed for ever
  Fault,    // an assignment out of range, or a division by zero
  Stuck,    // no node can go on
  Breached  // by a leaf, with OnBreach::Stop or where nothing else was left
};

// `system` is of a tree in .btf, whose ticks take time (TickSemantics::Root).
// All must outlive it. Nothing is allocated by a step that breaches nothing.
class TreeEngine {
 public:
  TreeEngine(const BehaviorTree& tree, const CompiledNetwork& system,
             Leaves& leaves, OnBreach policy);

  // Before `begin`.
  void add(EngineObserver& observer) { observers_.push_back(&observer); }

  // Everything up to the first tick.
  void begin();
  // A unit of time passes, then each tree has its tick. Only when Ready.
  EngineState tick();
  // Tells all actions that run to stop, left to right, and waits for those that
  // are to: the run is over.
  void stop();

  const BehaviorTree& tree() const { return tree_; }
  const CompiledNetwork& system() const { return system_; }
  EngineState state() const { return end_; }
  StateView now() const { return view_of(state_); }
  // How many ticks the first tree has begun, or the one that has begun most.
  int ticks() const { return ticks_; }
  // What a node has returned last.
  NodeStatus status(NodeId node) const {
    return static_cast<NodeStatus>(
        system_.value(now(), system_.network().node_status[index(node)]));
  }
  std::uint64_t breaches() const { return breaches_; }
  // Why a breach ended the run though the policy is another; "" where it is
  // not.
  const std::string& reason() const { return reason_; }

 private:
  // What is known of a leaf that has been asked.
  struct Flight {
    bool runs = false;  // an action was started, and has not ended
    // What it has answered, or has to, before the model allows it.
    std::optional<int> answered;
  };

  void settle();
  bool step();
  std::optional<AutomatonId> first_mover();
  void collect(AutomatonId automaton, std::vector<std::uint32_t>& places) const;
  std::optional<std::uint32_t> due_timer();
  std::optional<std::uint32_t> timer_of(NodeId leaf);
  void begin_tick(std::uint32_t place);
  void move_variables();
  bool move(const VariableMove& wanted);
  void fire(std::uint32_t place);
  bool is_started(const EdgeFacts& edge, NodeId node) const;
  void note(const EdgeFacts& edge);
  void move_overdue();
  void let_time_pass();
  bool is_over() const;
  void hear_complaints();

  void decide(NodeId leaf);
  void put_unchanged_first(NodeId leaf);
  Reply reply_of(NodeId leaf);
  void take(NodeId leaf, const PossibleAnswer& answer);
  const PossibleAnswer* possible(int result) const;
  bool may_answer(NodeId leaf, int answer) const;
  void settle_answer(NodeId leaf, int answer);
  BreachKind kind_of_refusal(NodeId leaf, int answer) const;
  // `early`: the answer, where it will be allowed later.
  void settle_breach(NodeId leaf, BreachKind kind, std::string text,
                     std::optional<int> early = std::nullopt);
  void fail(NodeId leaf);
  void go_on(NodeId leaf, std::optional<int> early);
  void give_up(NodeId leaf, std::string_view wanted);
  void report(Breach breach);

  std::string refusal(NodeId leaf, int answer) const;
  std::string result_name(const Node& leaf, int result) const;

  const BehaviorTree& tree_;
  const CompiledNetwork& system_;
  Leaves& leaves_;
  OnBreach policy_;
  LeafTable table_;
  std::vector<EngineObserver*> observers_;

  StateVector state_;
  EngineState end_ = EngineState::Ready;
  int ticks_ = 0;
  std::vector<int> ticks_of_;  // by node; of roots
  std::uint64_t breaches_ = 0;
  std::string reason_;
  std::vector<Flight> flights_;  // by node
  std::vector<NodeId> order_;    // all nodes, children first
  // Room for one step.
  std::vector<std::uint32_t> enabled_;
  std::vector<std::uint32_t> candidate_;
  StateVector candidate_words_;
  std::vector<PossibleAnswer> possible_;
};

}  // namespace btcheck
