// SPDX-License-Identifier: MIT
//
// A network in which subtrees are small automata.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "explore/components/component.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// The network with the largest subtrees that may be left out as components in
// their places. It has the variables of the whole, with the same numbers and
// behind them those of the components; those inside a component keep their
// first values. Automata keep their numbers, edges do not.
class Composition {
 public:
  // `kept`: by automaton, what has to stand as it is; what lies between stands
  // as well. With `keeps_root` all that lies above does, else it is a component
  // where it can be one. The components must outlive this.
  Composition(ComponentTable& components, std::vector<bool> kept,
              bool keeps_root);

  const Network& network() const { return network_; }
  // How many automata the components stand for.
  std::size_t left_out() const { return left_out_; }
  const ComponentTable& components() const { return *components_; }
  // By VariableId of the whole: it stands in a component.
  const std::vector<bool>& hidden() const { return hidden_; }
  // An automaton of the whole stands as it is.
  bool stands(AutomatonId automaton) const {
    return !stands_in_[index(automaton)];
  }

  // Takes an edge of this network in a state of the whole one; see
  // ComponentTable::take.
  bool take(const Valuation& state, std::uint32_t edge,
            const ComponentTable::Fire& fire, Standing& standing) const;
  // To be called before time passes: see ComponentTable::settle.
  bool settle(const Valuation& state, const ComponentTable::Fire& fire,
              Standing& standing) const;
  // Edges of timers of the whole network that stand in components: they are
  // taken as soon as they can be.
  const std::vector<std::uint32_t>& hidden_timers() const {
    return hidden_timers_;
  }
  // Of an edge of the whole network that stands here as well.
  std::optional<std::uint32_t> edge_here(std::uint32_t whole) const;

 private:
  std::optional<AutomatonId> lowest_above(const std::vector<bool>& kept) const;
  void leave_out(AutomatonId automaton, AutomatonId root);
  void hide();
  void place_below(AutomatonId root, const std::vector<bool>& kept);
  bool place_outside_of(AutomatonId root);
  void add_clock(AutomatonId root, PartSide side, VariableId location);

  ComponentTable* components_;
  Network network_;
  std::vector<bool> is_component_;  // by AutomatonId
  // By AutomatonId: the root of the component that it stands in, or is.
  std::vector<std::optional<AutomatonId>> stands_in_;
  std::optional<AutomatonId> inner_;  // all that is outside of it is left out
  std::uint32_t outside_ = 0;         // that is this automaton then
  std::vector<bool> hidden_;
  std::vector<std::uint32_t> hidden_timers_;
  std::size_t left_out_ = 0;
};

}  // namespace btcheck
