// SPDX-License-Identifier: MIT
//
// What the world answers in a simulated run, written down beforehand, and the
// player that makes a simulation go that way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "check/simulate/simulation.hpp"
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
  std::size_t begin = 0;  // of its bytes in the text
  std::size_t end = 0;
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

// "a, b or c", for messages; of more than eight words the first.
std::string alternatives(const std::vector<std::string>& words);

// How far a sequence has been gone through.
struct ScriptCursor {
  const ScriptedSequence* sequence = nullptr;  // none: nothing is said
  std::size_t result = 0;
  std::uint32_t used = 0;      // of its repetitions
  std::uint64_t position = 0;  // results taken

  const ScriptedResult& next() const { return sequence->results[result]; }
  void advance();
};

// The cursors of a script at its beginning, by NodeId and by StateVariableId.
struct ScriptCursors {
  explicit ScriptCursors(const SimulationScript& script);

  // That of a leaf: its own line, else, of a SetSV, that of the variable it
  // measures. One without a sequence where nothing is said.
  ScriptCursor& of_leaf(const BehaviorTree& tree, NodeId leaf);

  std::vector<ScriptCursor> of_node;
  std::vector<ScriptCursor> of_variable;
};

// The number of a choice, or what the tree cannot do though the script says so.
using ScriptedChoice = std::variant<std::size_t, Diagnostic>;

// Answers the choices of one simulation with Interleaving::InOrder from its
// beginning on, each once. What the script is silent about is the first choice.
// Script and source must outlive it.
class ScriptPlayer {
 public:
  ScriptPlayer(const SimulationScript& script, const SourceText& source);

  ScriptedChoice choose(const Simulation& simulation);

 private:
  ScriptedChoice answer(const Simulation& simulation, NodeId node);
  ScriptedChoice begin_tick(const Simulation& simulation);

  // "in tick 3 `land` cannot answer success"; `instead` says what it can.
  Diagnostic refusal(const ScriptCursor& cursor, int tick, std::string_view who,
                     std::string_view what, std::string instead) const;

  const SourceText& source_;
  ScriptCursors cursors_;
  int moved_in_tick_ = 0;          // the tick for which variables have moved,
  std::size_t next_variable_ = 0;  // and the first that has not
};

}  // namespace btcheck
