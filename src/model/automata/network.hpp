// SPDX-License-Identifier: MIT
//
// The lowered system: automata in parallel over shared variables and clocks.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/automata/automaton.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// Where time passes (paper, section 3.8.2). None: no clocks and no urgency.
enum class TickSemantics : std::uint8_t { Root, Leaves, Nodes, None };
std::string_view tick_name(TickSemantics ticks);
std::optional<TickSemantics> tick_semantics(std::string_view name);

enum class VariableRole : std::uint8_t {
  State,     // a state variable of the tree
  Location,  // the location of a node's or timer's automaton
  Caller,    // 0 None, 1 the parent
  Status,    // rstatus, a NodeStatus
  Local,     // next_seq, retry, failed, …
  Fault      // 1 once an assignment has left its variable's range
};

// An integer in [min, max].
struct Variable {
  VariableRole role = VariableRole::Local;
  std::string name;  // within its node: `next_seq`, `rstatus`, …
  int min = 0;
  int max = 0;
  int initial = 0;
  std::vector<std::string> value_names;  // of min, min + 1, …; may be empty

  std::int64_t domain_size() const {
    return std::int64_t{max} - std::int64_t{min} + 1;
  }
  std::string value_name(int value) const;
};

// Automata in the paper's order: enumerated state variables as declared, then
// the nodes of each tree in post-order; timers after all of them. Process
// number k (counted from 1) is automata[k - 1].
//
// Semantics (docs/semantics.md, sections 1 and 2): one edge of one automaton
// at a time, in any order; a timer's edge that has reached its deadline goes
// before every other edge; time advances by one when no enabled edge has
// reached its deadline; no edge is enabled once `fault` is 1.
struct Network {
  Profile profile = Profile::Paper;
  TickSemantics ticks = TickSemantics::Root;
  std::vector<Variable> variables;
  std::vector<Automaton> automata;
  std::optional<VariableId> fault;  // absent when no assignment can fail

  // Indexed by NodeId; `caller` of a root is absent.
  std::vector<AutomatonId> node_automaton;
  std::vector<VariableId> node_status;
  std::vector<std::optional<VariableId>> node_caller;
  // Indexed by StateVariableId.
  std::vector<VariableId> state_variable;
  // Indexed by StateVariableId; absent for a number.
  std::vector<std::optional<AutomatonId>> state_automaton;

  const Variable& variable(VariableId id) const { return variables[index(id)]; }
  const Automaton& automaton(AutomatonId id) const {
    return automata[index(id)];
  }
  std::uint32_t edge_count() const;
  // The automaton that owns the edge with this number.
  const Automaton& owner_of_edge(std::uint32_t edge) const;
  const Edge& edge(std::uint32_t number) const;
};

// The node that an edge brings into a location of this role, if it is a node's
// edge and leads there.
std::optional<NodeId> node_entering(const Network& network, std::uint32_t edge,
                                    LocationRole role);

// Text of an expression over network variables, `battery = Low and x < 3`.
std::string expression_text(const Network& network,
                            const Expression& expression);
// The name of a variable with its owner, `Sequence13_btn6.next_seq`.
std::string qualified_name(const Network& network, VariableId variable);

}  // namespace btcheck
