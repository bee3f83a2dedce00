// SPDX-License-Identifier: MIT
//
// What an exporter asks of an automaton's clock.
#pragma once

#include "model/automata/network.hpp"

namespace btcheck {

// The greatest time in this location that the edges from it tell from a longer
// one; 0: no clock runs here.
int clock_bound(const Automaton& automaton, LocationId location);

// The greatest of all its locations; 0: it needs no clock.
int greatest_clock_bound(const Automaton& automaton);

// Whether the clock can reach the edge's upper bound.
bool can_be_late(const Automaton& automaton, const Edge& edge);

// An enabled edge that has reached its upper bound and can be late, or without
// time any edge but that of a free variable, lets no time pass.
bool is_binding(TickSemantics ticks, const Automaton& automaton,
                const Edge& edge);

// The automaton of a state variable: its moves are no progress.
bool moves_freely(const Automaton& automaton);
// Whether some variable moves by itself.
bool has_free_moves(const Network& network);

}  // namespace btcheck
