// SPDX-License-Identifier: MIT
//
// An automaton as an analysis of its variables goes along it: where it can be,
// and which of its edges have to do with a variable.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "explore/reduce/called_with.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// The contexts of an automaton, and where each edge leads from each: its
// locations together with the values of locals that tell where it is. These are
// the two-valued ones, those that are only ever given constants, as the place
// of a Sequence is, and the node's own status. Only contexts that it can come
// to by its own edges, whatever the rest of the network does, are there.
class Contexts {
 public:
  struct Arc {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t edge = 0;  // by its place in the automaton
  };
  static constexpr std::uint32_t kInitial = 0;

  // Where so many arcs do not do, two-valued locals alone are looked at.
  Contexts(const Network& network, const Automaton& automaton,
           std::size_t most_arcs, const std::optional<CalledWith>& entry);

  std::size_t size() const { return locations_.size(); }
  LocationId location(std::uint32_t context) const {
    return locations_[context];
  }
  const std::vector<Arc>& arcs() const { return arcs_; }
  // Calls visit(arc) for those from a context, or into it.
  template <class Visit>
  void for_each_arc_from(std::uint32_t context, Visit visit) const {
    for (const std::uint32_t arc : arcs_from_[context]) visit(arcs_[arc]);
  }
  template <class Visit>
  void for_each_arc_into(std::uint32_t context, Visit visit) const {
    for (const std::uint32_t arc : arcs_into_[context]) visit(arcs_[arc]);
  }
  // Whether contexts differ in the variable's value.
  bool tell_apart(VariableId variable) const {
    return std::ranges::find(told_, variable) != told_.end();
  }

 private:
  std::vector<VariableId> told_;
  std::vector<LocationId> locations_;  // by context
  std::vector<Arc> arcs_;
  std::vector<std::vector<std::uint32_t>> arcs_from_, arcs_into_;
};

// Which edges of an automaton have to do with a variable, and what their guards
// say of it. Guards grow with the number of children, and so do edges: each
// guard is taken apart once, and not for each variable.
class Mentions {
 public:
  struct Mention {
    std::uint32_t edge = 0;  // by its place in the automaton
    Expression guard;        // its conjuncts that read the variable
  };

  explicit Mentions(const Automaton& automaton);

  // In the order of the edges.
  const std::vector<Mention>& of(VariableId variable) const;

 private:
  Mention& add(std::uint32_t edge, VariableId variable);

  std::unordered_map<std::uint32_t, std::vector<Mention>> mentions_;
};

}  // namespace btcheck
