// SPDX-License-Identifier: MIT
//
// A run of the network in words: each step alone, and the whole as a run that
// stands for itself.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

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

// What is told of the run beside its states.
struct RunHeading {
  std::string property;  // its name
  std::string formula;   // its text
  std::string verdict;   // HOLDS, VIOLATED
  std::string why = {};
  std::string source = {};  // the text of the tree's file
  std::vector<WatchedPart> watched = {};
  // The state that waits for an answer, or that shows what is asked.
  std::optional<std::size_t> trigger = {};
  std::string trigger_words = {};        // what is said of it
  std::string end_words = {};            // and of the last state
  std::optional<std::size_t> lost = {};  // the state that breaks the rule
};

RecordedRun recorded(const BehaviorTree& tree, const Network& network,
                     const Run& run, const RunHeading& heading);

}  // namespace btcheck
