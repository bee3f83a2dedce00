// SPDX-License-Identifier: MIT
//
// What the world answers in a simulated run, written down beforehand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

inline constexpr std::uint32_t kForEver =
    std::numeric_limits<std::uint32_t>::max();

// One result, so many times in a row.
struct ScriptedResult {
  int value = 0;  // a NodeStatus; of a SetSV or a variable: its value
  std::uint32_t times = 1;
  SourceSpan span;
};

// What stands after a name; never empty. The last result repeats.
struct ScriptedSequence {
  std::string name;  // as written
  std::vector<ScriptedResult> results;
};

struct SimulationScript {
  std::vector<ScriptedSequence> sequences;
  // By NodeId and by StateVariableId, which sequence it goes through, by
  // itself. Of nodes: an Action, a Condition or a SetSV.
  std::vector<std::optional<std::size_t>> of_node;
  std::vector<std::optional<std::size_t>> of_variable;
};

// Reads a script (docs/simulate.md):
//
//     # a comment
//     start_drone: running*2 success
//     measure_battery: Good Low         # a SetSV: the values it finds
//     weather: Calm Storm*              # a free variable: one for each tick
//
// Names are those of properties. One that several leaves share speaks for each
// of them, a closer one goes before it; a node goes before a variable, and
// `$weather` is a variable. Lines that begin with the same name are one. Every
// mistake is reported.
Result<SimulationScript> read_simulation_script(const BehaviorTree& tree,
                                                const Network& network,
                                                std::string_view file_name,
                                                std::string_view text);

// True where the world decides what a node answers, or finds.
bool is_scripted(NodeType type);

// "a, b or c", for messages; of more than eight words the first.
std::string alternatives(const std::vector<std::string>& words);

}  // namespace btcheck
