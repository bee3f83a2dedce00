// SPDX-License-Identifier: MIT
//
// The automaton of an enumerated state variable (paper, section 3.8.3 and the
// Mars rover of appendix F): its locations are the values. One that the tree
// writes stays where the tree puts it; the others move along :transitions at
// any instant.
#include "model/mapping/paper/drawings.hpp"

namespace btcheck::mapping {

void draw_state_variable(Context& context, StateVariableId variable) {
  const StateVariable& written = context.tree.variable(variable);
  Automaton automaton;
  automaton.kind = AutomatonKind::StateVariable;
  automaton.name = written.name;
  automaton.state_variable = variable;
  automaton.location = context.network.state_variable[index(variable)];
  for (const std::string& state : written.states) {
    automaton.locations.push_back({state});
  }
  if (moves_freely(context.tree, variable)) {
    for (auto [from, to] : written.transitions) {
      if (from == to) continue;
      automaton.edges.push_back(
          {LocationId{static_cast<std::uint32_t>(from)},
           LocationId{static_cast<std::uint32_t>(to)},
           {},
           {},
           kAnyTime,
           written.name + " := " + written.value_name(to)});
    }
  }
  context.network.state_automaton[index(variable)] =
      AutomatonId{static_cast<std::uint32_t>(context.network.automata.size())};
  context.network.automata.push_back(std::move(automaton));
}

}  // namespace btcheck::mapping
