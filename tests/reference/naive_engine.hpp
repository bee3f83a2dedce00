// SPDX-License-Identifier: MIT
//
// BehaviorTree.CPP and Nav2 as plain recursive functions: one tick of a tree
// calls the nodes one after another, as the engines' own code does. Written
// from that code and from nothing in src/model/mapping.
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/tree/tree.hpp"

namespace btcheck::reference {

// The engine throws, and the run ends.
struct EngineThrows : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class EngineStatus : std::uint8_t {
  Idle,
  Running,
  Success,
  Failure,
  Skipped  // an answer only, never a status
};
// "idle", "running", …
std::string status_word(EngineStatus status);

class NaiveEngine {
 public:
  // What the world says when a node asks it: "success", "true", "it is due".
  using Ask = std::function<std::string(NodeId)>;
  // A node answers, or has been halted.
  using Tell = std::function<void(NodeId, const std::string&)>;

  NaiveEngine(const BehaviorTree& tree, Ask ask, Tell tell);

  // One tickExactlyOnce, `tick` units of time after the start.
  EngineStatus tick_root(int tick);
  EngineStatus status(NodeId node) const { return status_[index(node)]; }

  // What the world is asked now is whether a script is true.
  bool asks_script() const { return asks_script_; }
  // Called with each node that is about to be executed, before all else.
  std::function<void(NodeId)> called = [](NodeId) {};
  // haltNode from outside: nobody tells its parent.
  void halt_from_outside(NodeId node) { reset(node); }
  // All that the next ticks depend on, as they begin.
  std::vector<int> words() const;

 private:
  // What a node remembers beside its status; which of it, its type says.
  struct Memory {
    std::size_t child = 0;
    int count = 0;
    int failures = 0;
    int skipped = 0;
    int running_child = -1;
    bool flag = false;
    bool other_flag = false;
    int since = -1;  // the tick in which a timer was started
  };

  const Node& node(NodeId id) const { return tree_.node(id); }
  Memory& memory(NodeId id) { return memory_[index(id)]; }
  bool asks_true(NodeId id) {
    asks_script_ = true;
    const bool is_true = ask_(id) == "true";
    asks_script_ = false;
    return is_true;
  }
  bool has(NodeId id, ScriptTime time) const {
    return node(id).script(time) != nullptr;
  }
  bool is_3() const { return is_release_3(tree_.profile); }
  bool is_due(NodeId id) const;

  EngineStatus execute(NodeId id);
  EngineStatus run(NodeId id);
  void halt(NodeId id);
  void reset(NodeId id);
  void reset_children(NodeId id);
  EngineStatus after_reset(NodeId id, EngineStatus answer);

  EngineStatus leaf(NodeId id);
  EngineStatus sequence(NodeId id);
  EngineStatus reactive(NodeId id);
  EngineStatus parallel(NodeId id);
  EngineStatus parallel_3(NodeId id);
  EngineStatus parallel_all(NodeId id);
  EngineStatus if_then_else(NodeId id);
  EngineStatus while_do_else(NodeId id);
  EngineStatus switch_node(NodeId id);
  EngineStatus try_catch(NodeId id);
  EngineStatus repeat(NodeId id);
  EngineStatus decorator(NodeId id);
  EngineStatus precondition(NodeId id);
  EngineStatus run_once(NodeId id);
  EngineStatus loop(NodeId id);
  EngineStatus when_updated(NodeId id);
  EngineStatus timeout(NodeId id);
  EngineStatus delay(NodeId id);
  EngineStatus sleep(NodeId id);
  EngineStatus rate_controller(NodeId id);
  EngineStatus when_due(NodeId id);
  EngineStatus path_longer(NodeId id);
  EngineStatus single_trigger(NodeId id);
  EngineStatus recovery(NodeId id);
  EngineStatus round_robin(NodeId id);
  EngineStatus pipeline(NodeId id);
  EngineStatus nonblocking(NodeId id);

  const BehaviorTree& tree_;
  Ask ask_;
  Tell tell_;
  std::vector<EngineStatus> status_;
  std::vector<Memory> memory_;
  int now_ = 0;
  bool asks_script_ = false;
};

}  // namespace btcheck::reference
