// SPDX-License-Identifier: MIT
//
// A run, told tick by tick, for a terminal.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// What of a run is told.
enum class Detail : unsigned char {
  Events,    // what leaves answer, variables that change, halts, the end
  EveryStep  // and every edge of every automaton
};

struct TextStyle {
  Detail detail = Detail::Events;
  std::string indent = "    ";
  // The state with the occurrence that a real-time pattern is violated by,
  // marked in the text with these words.
  std::optional<std::size_t> trigger_state;
  std::string trigger_words = "asked here, not answered";
};

// Lines ending in newlines:
//
//     tick 1  start_drone -> success                       chosen
//             measure_battery: battery := Low              chosen
//
// "chosen" stands where the world outside decided: the answer of an action or
// a condition, the value a SetSV finds, a variable that moves by itself.
std::string run_text(const RecordedRun& run, const TextStyle& style);
std::string run_text(const BehaviorTree& tree, const Network& network,
                     const Run& run, const TextStyle& style);

}  // namespace btcheck
