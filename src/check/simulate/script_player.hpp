// SPDX-License-Identifier: MIT
//
// A simulation, run as a script has it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "check/simulate/simulation.hpp"
#include "check/simulate/simulation_script.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

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
  // How far a sequence has been gone through.
  struct Cursor {
    std::size_t result = 0;
    std::uint32_t used = 0;      // of its repetitions
    std::uint64_t position = 0;  // results taken
  };

  const ScriptedSequence& sequence(std::size_t number) const {
    return script_.sequences[number];
  }
  const ScriptedResult& next(std::size_t number, const Cursor& cursor) const {
    return sequence(number).results[cursor.result];
  }
  void advance(std::size_t number, Cursor& cursor);

  ScriptedChoice answer(const Simulation& simulation, NodeId node);
  // Where the leaf may keep its answer or run again: that it runs again.
  std::optional<std::size_t> running_again(const Simulation& simulation) const;
  ScriptedChoice begin_tick(const Simulation& simulation);

  // What could not be done, and what could: "answer success", {"running"}.
  struct Conflict {
    int tick = 0;
    std::string who;
    std::string what;
    std::string instead;
  };
  Diagnostic refusal(std::size_t number, const Cursor& cursor,
                     const Conflict& conflict) const;

  const SimulationScript& script_;
  const SourceText& source_;
  std::vector<Cursor> of_node_;
  std::vector<Cursor> of_variable_;
  int moved_in_tick_ = 0;          // the tick for which variables have moved,
  std::size_t next_variable_ = 0;  // and the first that has not
};

}  // namespace btcheck
