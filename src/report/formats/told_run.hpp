// SPDX-License-Identifier: MIT
//
// A run as a list of places to step through: what leaves answered, what became
// of the variables, where each tick begins, and where the loop does.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "report/text/report.hpp"

namespace btcheck {

// A place in an input; line 0 is the file as a whole.
struct Place {
  std::string file;
  SourceSpan span;
};

struct ToldStep {
  enum class Kind : std::uint8_t {
    Time,   // "tick 2 begins", "time 2"
    Event,  // "start_drone -> success"
    Remark  // "the loop begins"
  };
  Kind kind = Kind::Event;
  std::string text;
  int time = 0;            // units of time since the beginning
  bool is_chosen = false;  // by the world outside, not by the tree
  Place place;
};

struct ToldRun {
  std::vector<ToldStep> steps;
  std::string unit;  // "tick", "time"
  int time = 0;      // units of time until the end, or until the loop closes
  // Of an infinite run: the number of the step with which the loop begins.
  std::optional<std::size_t> loop;
};

Place place_of(const BehaviorTree& tree, NodeId node);

// Times without an event are not told, nor what the mapping does by itself.
ToldRun told_run(const BehaviorTree& tree, const Network& network,
                 const Run& run, const RunRemarks& remarks);

// What moves in the step with which a run shows that a property is broken. Of
// a loop no step does so alone: there it is the last event of a node that the
// property speaks of, else the last event of all.
struct Culprit {
  std::optional<NodeId> node;
  std::optional<StateVariableId> variable;  // that moves by itself
};
Culprit culprit_of(const BehaviorTree& tree, const Network& network,
                   const Run& run, const std::vector<NodeId>& subjects);

}  // namespace btcheck
