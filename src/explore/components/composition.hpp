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
  // `kept`: by automaton, what has to stand as it is; what lies above it stands
  // as well. The components must outlive this.
  Composition(Components& components, std::vector<bool> kept);

  const Network& network() const { return network_; }
  // How many automata the components stand for.
  std::size_t left_out() const { return left_out_; }
  const Components& components() const { return *components_; }
  // By VariableId of the whole: it stands in a component.
  const std::vector<bool>& hidden() const { return hidden_; }

  // Takes an edge of this network in values of the whole one: see
  // Components::take.
  bool take(Values& values, std::uint32_t edge,
            std::vector<std::uint32_t>& taken) const;
  // Of an edge of the whole network that stands here as well.
  std::optional<std::uint32_t> edge_here(std::uint32_t whole) const;

 private:
  bool place(AutomatonId root, const std::vector<bool>& kept);

  Components* components_;
  Network network_;
  std::vector<bool> is_component_;  // by AutomatonId
  std::vector<bool> is_inside_;     // by AutomatonId: in one, or one
  std::vector<bool> hidden_;
  std::size_t left_out_ = 0;
};

}  // namespace btcheck
