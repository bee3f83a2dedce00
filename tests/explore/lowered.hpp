// SPDX-License-Identifier: MIT
//
// Networks of small trees, and of a parent and its child made by hand.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <string_view>

#include "explore/toy.hpp"
#include "model/automata/network.hpp"
#include "model/lowering.hpp"

namespace btcheck {

inline Network lowered(const std::string& text,
                       TickSemantics ticks = TickSemantics::Root) {
  const auto tree = read_btf("toy.btf", text);
  REQUIRE(tree.value);
  return lower(*tree.value, ticks);
}

// The automaton of the node with this :name or :ID.
inline AutomatonId automaton_of(const Network& network, std::string_view node) {
  const std::string start = std::string(node) + "_";
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    if (network.automata[a].name.starts_with(start)) return AutomatonId{a};
  }
  FAIL("no node of this name");
  return {};
}

inline LocationId location_of(const Network& network, AutomatonId automaton,
                              std::string_view word) {
  const auto found = network.automaton(automaton).find_location(word);
  REQUIRE(found);
  return *found;
}

// A parent that calls its child once in each unit of time. Its edges are 0, to
// call, and 1, when the child is done; the child's are 2, to work, and 3, to
// give control back.
struct Family {
  toy::Draft draft;
  VariableId called = draft.variable("caller", 0, 1, 0, VariableRole::Caller);
  AutomatonId parent =
      draft.automaton(AutomatonKind::Node, "parent", {"start", "wait"});
  AutomatonId child =
      draft.automaton(AutomatonKind::Node, "child", {"start", "done"}, called);

  Family() {
    draft.edge(parent, 0, 1, {1, 1}, {}, {toy::assign(called, 1)});
    draft.edge(parent, 1, 0, kAtOnce, toy::is(called, 0));
    draft.edge(child, 0, 1, kAtOnce, toy::is(called, 1));
    draft.edge(child, 1, 0, kAtOnce, toy::is(called, 1),
               {toy::assign(called, 0)});
  }
};

}  // namespace btcheck
