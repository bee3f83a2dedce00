// SPDX-License-Identifier: MIT
//
// The states and steps of a network, enumerated without any cleverness.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "model/automata/network.hpp"

namespace btcheck::reference {

// One value for each variable, and for each automaton the time since it
// entered its location; 0 where no edge that leads from there asks for it.
struct NaiveState {
  std::vector<int> values;  // by VariableId
  std::vector<int> clocks;  // by AutomatonId

  int value(VariableId id) const { return values[index(id)]; }
  friend auto operator<=>(const NaiveState&, const NaiveState&) = default;
};

// The value of an expression over the variables of a network.
std::int64_t naive_value(const Expression& expression, const NaiveState& state);

// What may happen next, one edge of one automaton at a time. The `gate` of an
// automaton is not looked at: its edges' guards must say the same.
class NaiveNetwork {
 public:
  // The network must outlive it.
  explicit NaiveNetwork(const Network& network) : network_(network) {}

  const Network& network() const { return network_; }
  NaiveState initial() const;
  bool is_faulty(const NaiveState& state) const;
  // Source active, guard true, clock within the interval, no fault; whatever
  // other edges there are.
  bool may_fire(const NaiveState& state, const Automaton& automaton,
                const Edge& edge) const;
  bool is_at_deadline(const NaiveState& state, const Automaton& automaton,
                      const Edge& edge) const;
  NaiveState after(const NaiveState& state, const Automaton& automaton,
                   const Edge& edge) const;

  // The numbers of the edges that may be fired now, timers' deadlines first.
  std::vector<std::uint32_t> enabled(const NaiveState& state) const;
  // Time may pass by one unit.
  bool may_wait(const NaiveState& state) const;
  NaiveState waited(const NaiveState& state) const;

 private:
  std::size_t location(const Automaton& automaton,
                       const NaiveState& state) const;
  int greatest_bound(const Automaton& automaton, std::size_t location) const;

  const Network& network_;
};

// All that can be reached, written out.
struct NaiveSpace {
  struct Step {
    std::size_t target = 0;
    std::optional<std::uint32_t> edge;  // none: time passes
    bool progress = true;               // not a move of a free variable
  };
  std::vector<NaiveState> states;  // 0 is the initial one
  std::vector<std::vector<Step>> steps;
  std::vector<bool> dead;         // no step but an idle one
  std::uint64_t transitions = 0;  // idle steps not counted
};

// Nothing when there are more than `most` states.
std::optional<NaiveSpace> naive_space(const Network& network, std::size_t most);

}  // namespace btcheck::reference
