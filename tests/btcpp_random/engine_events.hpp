// SPDX-License-Identifier: MIT
//
// What a recorder has written down of a run of BehaviorTree.CPP, and the states
// that this makes: a second reading of what marked logs mean, which shares
// nothing with the one that is told to people.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace btcheck::reference {

// In pre-order; 0 is the tree itself.
struct EngineNode {
  std::string name;
  std::string type;
  std::size_t parent = 0;
  bool has_children = false;
};

struct KeptValue {
  enum class Kind { Unset, NoValue, Integer, Real, Text, Other };
  Kind kind = Kind::Unset;
  double number = 0;
  std::string text;

  bool is_number() const { return kind == Kind::Integer || kind == Kind::Real; }
  // "minus_0_5", "unset", as rules name it.
  std::string word() const;
};

// One line: `tick`, `wake`, `end STATUS`, `throw`, `begin NODE`, `answer NODE
// STATUS`, `change NODE BEFORE AFTER`, `entry NUMBER TYPE VALUE`.
struct EngineEvent {
  std::string what;
  std::size_t number = 0;  // of the node or entry
  std::string before;
  std::string after;  // also of `end` and `answer`
  KeptValue value;
};

struct EngineRun {
  std::vector<EngineNode> nodes;
  std::vector<std::string> entries;  // as rules name them
  std::vector<EngineEvent> events;
};

// Lines `node PARENT TYPE NAME`, `entry NAME`, an empty one, and the events.
// Throws where it is none.
EngineRun engine_run(const std::string& text);

// A state of the run, with all that rules ask of it.
struct EngineState {
  std::size_t events = 0;   // that have been read, this one included
  std::size_t records = 0;  // changes of status among them
  int tick = 0;
  int time = 0;
  std::vector<std::string> locations;
  std::vector<std::string> statuses;
  std::vector<bool> called;          // has been, and has not answered
  std::vector<std::string> answers;  // in this tick, "none"
  std::vector<KeptValue> entries;
};

// Calls show() for each state, the first one included.
void play(const EngineRun& run,
          const std::function<void(const EngineState&)>& show);

}  // namespace btcheck::reference
