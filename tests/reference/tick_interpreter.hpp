// SPDX-License-Identifier: MIT
//
// What one tick of a behavior tree does, told by recursion: a second opinion.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "model/tree/tree.hpp"

namespace btcheck::reference {

enum class EventKind : std::uint8_t {
  Ticked,   // the node entered tick_node
  Success,  // it answered
  Failure,
  Running,
  Halted  // it was running, was halted, and reports so
};
std::string_view event_name(EventKind kind);

struct TickEvent {
  NodeId node{};
  EventKind kind = EventKind::Ticked;

  friend bool operator==(const TickEvent&, const TickEvent&) = default;
};

// Everything the norm leaves open, decided by the caller. A callback that is
// absent takes the first of what is allowed (for `due`: as late as possible;
// for `free_moves`: nothing moves). An answer that is not allowed is a
// std::logic_error.
struct Script {
  // The answer of an Action or Condition, each time it is ticked.
  std::function<NodeStatus(NodeId leaf, std::span<const NodeStatus> allowed)>
      action;
  // The value a SetSV chooses; allowed[0] is the present one.
  std::function<int(NodeId set_sv, std::span<const int> allowed)> set_sv;
  // Whether the timer of an Action with :duration [min,max] is due, asked
  // before each tick with min <= elapsed < max; at max it is due unasked.
  std::function<bool(NodeId action, int elapsed)> due;
  // May change the variables that move freely, before each tick, along any
  // number of their transitions.
  std::function<void(std::span<int> values)> free_moves;
  // What a variable that moves in its own time becomes before a tick: what it
  // is stands first, unless its time is over.
  std::function<int(StateVariableId variable, std::span<const int> allowed)>
      timely_move;
  // Of a leaf that is at fault: asked before all else, what it answers instead.
  // `begins_anew`: nothing, but its timer is forgotten.
  struct Ill {
    std::optional<NodeStatus> answer = {};
    bool begins_anew = false;
  };
  std::function<Ill(NodeId leaf,
                    const std::function<std::vector<NodeStatus>()>& allowed)>
      ill = {};
  // What it writes instead of a value, where `present` stands; nothing: that.
  std::function<std::optional<int>(NodeId leaf, StateVariableId variable,
                                   int present, int value)>
      writes = {};
  // A leaf is halted.
  std::function<void(NodeId leaf)> halted = {};
};

// A local variable of a node's automaton, by the norm's name; the table
// stands at TickInterpreter::locals in the .cpp.
struct LocalValue {
  NodeId node{};
  std::string_view name;
  int value = 0;

  friend bool operator==(const LocalValue&, const LocalValue&) = default;
};

// The companion timer of a Wait, a RateController or an Action with
// :duration: idle -> counting -[n,n]-> due.
enum class TimerPhase : std::uint8_t { Idle, Counting, Due };
struct TimerValue {
  NodeId node{};
  TimerPhase phase = TimerPhase::Idle;
  int elapsed = 0;  // ticks since it began to count; 0 when idle or due

  friend bool operator==(const TimerValue&, const TimerValue&) = default;
};

// The state after a tick, and the way there.
struct TickResult {
  NodeStatus root = NodeStatus::NoRetStatus;
  std::vector<TickEvent> events;     // in order; the root's own included
  std::vector<int> variables;        // indexed by StateVariableId
  std::vector<NodeStatus> statuses;  // indexed by NodeId
  std::vector<LocalValue> locals;    // by node, then as the table has them
  std::vector<TimerValue> timers;    // by node
  bool fault = false;  // an assignment left its range, or a division by 0
};

// Ticks the first root of a tree, with tick semantics `root`. The tree must
// outlive the interpreter. Copies are snapshots.
class TickInterpreter {
 public:
  TickInterpreter(const BehaviorTree& tree, Script script);

  // Lets one unit of time pass, moves timers and free variables, then
  // activates the root's child, unless the root has ended or a fault has
  // ended the run.
  TickResult tick();

  // The state as it is, without events.
  TickResult state() const;

  NodeStatus status(NodeId node) const;
  std::vector<LocalValue> locals(NodeId node) const;
  // The node's local variable, which it must have.
  int local(NodeId node, std::string_view name) const;
  bool ended() const { return ended_; }  // root for ever in success or failure
  bool fault() const { return fault_; }

 private:
  struct Timer {
    TimerPhase phase = TimerPhase::Idle;
    int elapsed = 0;
  };
  // What a node remembers from one tick to the next; each type uses its own.
  struct Memory {
    NodeStatus status = NodeStatus::NoRetStatus;
    int next = 1;    // the child to tick, counted from 1; the furthest reached
    int count = 0;   // rounds, attempts or retries done
    int failed = 0;  // RoundRobin: failures before the present child
    std::optional<NodeStatus> decision;  // reactive, while it waits
    std::vector<bool> finished;          // Parallel, by child
    Timer timer;
  };
  struct ModelFault {};

  const Node& node(NodeId id) const { return tree_->node(id); }
  Memory& memory(NodeId id) { return memories_[index(id)]; }
  const Memory& memory(NodeId id) const { return memories_[index(id)]; }
  // Children are counted from 1, as next_seq counts them.
  NodeId child(NodeId id, int number) const;
  int child_count(NodeId id) const;

  void record(NodeId id, EventKind kind);
  NodeStatus tick_node(NodeId id);
  NodeStatus evaluate_node(NodeId id);
  bool any_child_runs(NodeId id) const;
  void halt_running_children(NodeId id);
  void halt_node(NodeId id);
  void forget(NodeId id);

  NodeStatus tick_sequence(NodeId id);
  NodeStatus tick_fallback(NodeId id);
  NodeStatus tick_reactive(NodeId id, NodeStatus deciding);
  NodeStatus tick_parallel(NodeId id);
  NodeStatus tick_inverter(NodeId id);
  NodeStatus tick_force(NodeId id, NodeStatus forced);
  NodeStatus tick_keep_running(NodeId id);
  NodeStatus tick_repeat(NodeId id);
  NodeStatus tick_retry(NodeId id);
  NodeStatus tick_rate_controller(NodeId id);
  NodeStatus tick_timeout(NodeId id);
  NodeStatus tick_recovery(NodeId id);
  NodeStatus tick_round_robin(NodeId id);
  NodeStatus tick_pipeline(NodeId id);
  NodeStatus tick_action(NodeId id);
  NodeStatus answered(NodeId id, NodeStatus answer);
  NodeStatus tick_set_sv(NodeId id);
  NodeStatus tick_eval(NodeId id);
  NodeStatus tick_wait(NodeId id);

  std::vector<NodeStatus> allowed_answers(NodeId id) const;
  std::vector<int> allowed_values(StateVariableId variable) const;
  std::int64_t evaluate(const Expression& expression) const;
  void assign(std::span<const StateAssignment> assignments);

  bool has_timer(NodeId id) const;
  Duration timer_window(NodeId id) const;
  void start_timer(NodeId id);
  void check_due(NodeId id);
  void advance_timers();
  std::vector<int> timely_values(StateVariableId variable) const;
  void move_in_time();
  void move_free_variables();

  const BehaviorTree* tree_;
  Script script_;
  NodeId root_;
  std::vector<Memory> memories_;  // indexed by NodeId
  std::vector<int> variables_;    // indexed by StateVariableId
  std::vector<int> lasted_;       // likewise: ticks in its present state
  std::vector<TickEvent> events_;
  bool ended_ = false;
  bool fault_ = false;
};

}  // namespace btcheck::reference
