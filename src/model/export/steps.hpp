// SPDX-License-Identifier: MIT
//
// When the edges of a network may be taken, and what they have to wait for: in
// every language the same conditions, in its signs.
//
// A clock for each automaton suffices: it starts when a location is entered,
// and counts only up to what the intervals of the edges from there tell apart
// (explore/state/state_layout.cpp packs the same bounds).
#pragma once

#include <string>
#include <vector>

#include "model/automata/network.hpp"
#include "model/export/language.hpp"

namespace btcheck {

// Whether a model has the variable `progress`, which tells the moves of free
// variables from all other steps.
enum class Progress : std::uint8_t { Untold, Told };

// The greatest time in this location that the edges from it tell from a longer
// one; 0: no clock runs here.
int clock_bound(const Automaton& automaton, LocationId location);
// The greatest of all its locations; 0: it needs no clock.
int greatest_clock_bound(const Automaton& automaton);
// Whether the clock can reach the edge's upper bound.
bool can_be_late(const Automaton& automaton, const Edge& edge);
// The same of a timer's edge, which then goes before every other step.
bool is_due_first(const Automaton& automaton, const Edge& edge);
// An enabled edge that has reached its upper bound and can be late, or without
// time any edge but that of a free variable, lets no time pass.
bool is_binding(TickSemantics ticks, const Automaton& automaton,
                const Edge& edge);

// The automaton of a state variable: its moves are no progress.
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
  // The parts of the edge's guard, joined, each Or in parentheses.
  std::string guard(const Edge& edge) const;
  // That the edge is enabled and its lower bound reached.
  std::string is_ready(AutomatonId id, const Edge& edge) const;
  // The clock is at the upper bound; "" where no clock runs: there it is 0.
  std::string is_last_moment(AutomatonId id, const Edge& edge) const;
  // Some timer is at its last moment; `timer_is_due` stands for it.
  std::string timer_is_due() const;
  // Where there are timers that go first: none is due, or it is this one.
  std::string turn(AutomatonId id, const Edge& edge) const;
  // The clock runs and has not reached its end.
  std::string clock_runs(AutomatonId id) const;

 private:
  void add_and(std::string& text, std::string_view more) const;

  const ExportLanguage& language_;
  const Network& network_;
};

}  // namespace btcheck
