// SPDX-License-Identifier: MIT
//
// A run as it is kept and shown: what every format of a run is made from, and
// what an ITF file holds. It stands for itself, without tree or network.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace btcheck {

// What a node is doing, as a viewer colours it (the paper's eight colours, and
// one for XML trees). Files hold the names, pages the numbers: new ones go
// last.
enum class Phase : std::uint8_t {
  Unvisited,  // has not been ticked yet
  Here,       // ticked, and none of its children is
  Waiting,    // ticked, and so is one of its children
  Running,    // these three: what it returned when it was ticked last
  Success,
  Failure,
  Halted,
  Halting,  // being halted, or halting its children
  Skipped   // returned that when it was ticked last; XML trees only
};
inline constexpr std::array<std::string_view, 9> kPhaseNames = {
    "unvisited", "here",   "waiting", "running", "success",
    "failure",   "halted", "halting", "skipped"};

constexpr std::string_view phase_name(Phase phase) {
  return kPhaseNames[static_cast<std::size_t>(phase)];
}

// True while the tick, or the order to halt, is in the node or below it.
constexpr bool is_active(Phase phase) {
  return phase == Phase::Here || phase == Phase::Waiting ||
         phase == Phase::Halting;
}

// True when the last tick of the node ended in success or failure.
constexpr bool is_completed(Phase phase) {
  return phase == Phase::Success || phase == Phase::Failure;
}

struct RecordedNode {
  std::string key;   // unique in the tree: "goto_waypoint_btn16"
  std::string type;  // "Sequence", "Action", …
  std::string name;  // short, and unique as far as the tree's author made it so
  std::uint32_t line = 0;  // from 1
  std::uint32_t column = 0;
  std::optional<std::uint32_t> parent;  // its number; none: a root
  // That it stands in; empty for the tree's own.
  std::string file = {};

  friend bool operator==(const RecordedNode&, const RecordedNode&) = default;
};

struct RecordedStep {
  std::string step;   // any step: "Sequence17_btn6: start_ -> tick_node"
  std::string event;  // the same in words, "" for the mapping's own business
  bool is_chosen = false;  // by the world outside, not by the tree

  friend bool operator==(const RecordedStep&, const RecordedStep&) = default;
};

// A state and the step that led to it. Vectors go by the number of the node, of
// the variable, of the atom.
struct RecordedState : RecordedStep {
  int time = 0;                        // units of time since the beginning
  int tick = 0;                        // how many ticks have begun
  std::optional<std::uint32_t> mover;  // the node that took the step
  std::vector<Phase> phases;
  std::vector<bool> is_stale;  // its phase is of an earlier tick
  std::vector<std::string> statuses;
  std::vector<std::string> locations;
  std::vector<std::string> values;
  std::vector<bool> atoms;

  friend bool operator==(const RecordedState&, const RecordedState&) = default;
};

inline constexpr std::size_t kNoState = static_cast<std::size_t>(-1);

// A file that a tree includes, by the name that its nodes give.
struct IncludedText {
  std::string file;
  std::string text;

  friend bool operator==(const IncludedText&, const IncludedText&) = default;
};

// What is told of a run beside its states.
struct RunWords {
  std::string property;     // its name
  std::string formula;      // its text
  std::string verdict;      // HOLDS, VIOLATED
  std::string why = {};     // a sentence, or ""
  std::string source = {};  // the tree's text; "" where it is not known
  std::vector<IncludedText> included = {};  // with nodes of the tree in them
  std::string trigger_words = {};           // what is said of the trigger,
  std::string end_words = {};               // and of the last state

  friend bool operator==(const RunWords&, const RunWords&) = default;
};

struct RecordedRun : RunWords {
  std::string tree;                 // its file
  std::string ticks;                // root, leaves, nodes, none
  std::vector<RecordedNode> nodes;  // pre-order; a parent before its children
  std::vector<std::string> variables;  // names
  std::vector<bool> is_number;         // of the variables
  bool has_entries = false;        // the variables are entries of a blackboard
  std::vector<std::string> atoms;  // texts of the property's parts
  std::vector<RecordedState> states;
  // The state that the last one returns to; else kNoState.
  std::size_t loop = kNoState;
  RecordedStep back;     // to it,
  int back_elapsed = 0;  // and how long that takes
  // The state in which the property is lost, or a witness is complete.
  std::size_t lost = kNoState;
  // The state from which an answer is waited for, or that shows what is asked.
  std::size_t trigger = kNoState;

  friend bool operator==(const RecordedRun&, const RecordedRun&) = default;
};

// "running", "(success)" where that was in an earlier tick, "" for Unvisited.
std::string shown_phase(const RecordedState& state, std::size_t node);

// The children of each node, in order, by its number.
using Children = std::vector<std::vector<std::uint32_t>>;
Children children_of(const RecordedRun& run);

// A state as it passes by; those of the loop come again, in later ticks.
struct Passing {
  std::size_t state = 0;
  int tick = 0;
};

// The run with its loop gone through so many times, at least once.
std::vector<Passing> unrolled(const RecordedRun& run, int passes);

// For each tick that began, and for the time before the first one if nothing
// else is there, its last state. Ascending, never empty.
std::vector<std::size_t> tick_ends(const RecordedRun& run);

// The state a single picture shows: where the property is lost, else the last.
std::size_t shown_state(const RecordedRun& run);

}  // namespace btcheck
