// SPDX-License-Identifier: MIT
//
// An automaton as an analysis of its variables goes along it: where it can be,
// and which of its edges have to do with a variable.
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "model/automata/network.hpp"

namespace btcheck {

// The contexts of an automaton, its locations together with the values of the
// two-valued locals, and where each edge leads from each.
class Contexts {
 public:
  struct Arc {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t edge = 0;  // by its place in the automaton
  };

  Contexts(const Network& network, const Automaton& automaton);

  std::size_t size() const {
    return automaton_.locations.size() << flags_.size();
  }
  std::uint32_t initial() const;
  LocationId location(std::uint32_t context) const {
    return LocationId{context >> flags_.size()};
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
    return std::ranges::find(flags_, variable) != flags_.end();
  }

 private:
  void add_arcs(std::uint32_t number);

  const Network& network_;
  const Automaton& automaton_;
  std::vector<VariableId> flags_;
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
