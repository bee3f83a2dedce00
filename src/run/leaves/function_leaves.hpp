// SPDX-License-Identifier: MIT
//
// Leaves that are functions of the program around the tree (btcheck/run.hpp).
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "btcheck/run.hpp"
#include "model/tree/tree.hpp"
#include "run/engine/leaves.hpp"
#include "run/leaves/task.hpp"

namespace btcheck {

// A value as a robot says it, as that of a state variable; nothing where it has
// no such value.
std::optional<int> value_of(const StateVariable& variable,
                            const run::Value& value);

// What a value of a number stands for.
double number_of(const StateVariable& variable, int value);

// The function of a leaf.
struct LeafFunction {
  std::variant<run::ActionFunction, run::PolledFunction, run::ConditionFunction,
               run::MeasureFunction>
      function;
  run::Runs where = run::Runs::InTask;

  bool is_polled() const {
    return std::holds_alternative<run::PolledFunction>(function);
  }
};

// Tree must outlive it.
class FunctionLeaves : public Leaves {
 public:
  FunctionLeaves(const BehaviorTree& tree, std::chrono::milliseconds within);

  // Replaces the function that the node has. Before `begin`.
  void give(NodeId node, LeafFunction function);
  bool has(NodeId node) const { return leaves_[index(node)] != nullptr; }
  // Makes the threads. std::system_error where there are none.
  void begin();
  // Stops all and waits for them. False where one does not return: its function
  // still uses this and the tree.
  bool end();

  // From any thread.
  void set(const VariableMove& move);

  Reply ask(const LeafQuestion& question) override;
  void halt(NodeId node) override;
  void await_halted() override;
  std::optional<VariableMove> next_move(int tick, StateView now) override;
  std::optional<Complaint> complaint() override;

 private:
  using Clock = std::chrono::steady_clock;

  struct Leaf {
    LeafFunction function;
    std::string name;                      // unique
    std::vector<run::Argument> arguments;  // of the call under way
    std::unique_ptr<Task> task;
    bool may_run = false;
    std::optional<Clock::time_point> halted_by;  // when it has to have returned
  };

  int call(NodeId node, Leaf& leaf, const TaskCall& with,
           const std::stop_token& stop) const;
  Reply ask_in_tick(NodeId node, Leaf& leaf, const LeafQuestion& question);
  Reply ask_task(NodeId node, Leaf& leaf, const LeafQuestion& question);
  Reply reply_to(const Leaf& leaf, const TaskResult& result) const;
  int poll(const Leaf& leaf, const run::Call& with, run::Turn turn) const;

  const BehaviorTree& tree_;
  std::chrono::milliseconds within_;
  std::vector<std::unique_ptr<Leaf>> leaves_;  // by NodeId

  std::mutex moves_mutex_;
  std::vector<VariableMove> moves_;  // since the last tick
  std::vector<VariableMove> taken_;  // that the engine goes through
  std::size_t next_move_ = 0;
  int moved_in_tick_ = 0;
};

}  // namespace btcheck
