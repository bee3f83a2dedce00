// SPDX-License-Identifier: MIT
//
// When the edges of a network may be taken, and when time may pass: the same
// conditions for every language, written in its signs.
//
// One clock for each automaton suffices. It starts when a location is entered,
// and stops where the intervals of the edges from there no longer tell times
// apart (explore/state/state_layout.cpp packs the same bounds).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/automata/network.hpp"
#include "model/export/language.hpp"

namespace btcheck {

// Whether a model has the variable `progress`, which tells the moves of free
// variables from all other steps.
enum class Progress : std::uint8_t { Untold, Told };

// The greatest time in any location at which some edge still behaves otherwise
// than later on; 0: the automaton needs no clock.
int clock_bound(const Automaton& automaton);
// Whether it is an edge of a timer whose clock can reach its upper bound: there
// it goes before every other step.
bool is_due_first(const Automaton& automaton, const Edge& edge);
// Whether no time may pass while the edge is enabled and at its upper bound; in
// a model without time, while it is enabled.
bool is_binding(TickSemantics ticks, const Automaton& automaton,
                const Edge& edge);

// Whether it is the automaton of a state variable: its moves are no progress.
bool moves_freely(const Automaton& automaton);
// Whether some variable moves by itself.
bool has_free_moves(const Network& network);

// The variables of an automaton, in the order in which a model declares them; a
// state variable stands elsewhere.
std::vector<VariableId> declared_variables(const Network& network,
                                           const Automaton& automaton);

// The value of an automaton's location variable.
int location_value(const Network& network, const Automaton& automaton,
                   LocationId location);

// Conditions in the signs of a language; "" where there is none.
class StepConditions {
 public:
  explicit StepConditions(const ExportLanguage& language)
      : language_(language), network_(language.network()) {}

  std::string is_at(const Automaton& automaton, LocationId location) const;
  // The edge's guard; an Or in the conjunction has parentheses.
  std::string guard(const Edge& edge) const;
  // That the edge is enabled and its lower bound reached.
  std::string is_ready(AutomatonId id, const Edge& edge) const;
  // The clock is at the upper bound; "" where no clock runs: there it is 0.
  std::string is_last_moment(AutomatonId id, const Edge& edge) const;
  // Some timer is at its last moment; `timer_is_due` stands for it.
  std::string timer_is_due() const;
  // No timer is due, or it is this one. For models with timers that go first.
  std::string turn(AutomatonId id, const Edge& edge) const;
  // The clock runs and has not reached its end.
  std::string clock_runs(AutomatonId id) const;

 private:
  void add_and(std::string& text, std::string_view more) const;
  int clock_bound_at(AutomatonId id, LocationId location) const;

  const ExportLanguage& language_;
  const Network& network_;
  mutable std::map<AutomatonId, std::vector<int>> bounds_;  // as asked for
};

}  // namespace btcheck
