// SPDX-License-Identifier: MIT
//
// The nodes and variables that predicates read, found from what they read and
// not from how it was written.
#include <algorithm>

#include "check/bind/bind.hpp"

namespace btcheck {
namespace {

template <class Id>
void sort_out(std::vector<Id>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

// Who owns each variable of a network.
class Owners {
 public:
  explicit Owners(const Network& network) : network_(network) {}

  void note(const StatePredicate& predicate, std::vector<NodeId>& nodes,
            std::vector<StateVariableId>& variables) const {
    for (const Term& term : predicate.expression.terms()) {
      if (term.operation != Operation::Variable) continue;
      note(VariableId{static_cast<std::uint32_t>(term.operand)}, nodes,
           variables);
    }
  }

 private:
  void note(VariableId variable, std::vector<NodeId>& nodes,
            std::vector<StateVariableId>& variables) const {
    for (std::uint32_t v = 0; v < network_.state_variable.size(); ++v) {
      if (network_.state_variable[v] == variable) {
        variables.push_back(StateVariableId{v});
      }
    }
    for (std::uint32_t n = 0; n < network_.node_automaton.size(); ++n) {
      const Automaton& automaton =
          network_.automaton(network_.node_automaton[n]);
      const bool is_local =
          std::find(automaton.locals.begin(), automaton.locals.end(),
                    variable) != automaton.locals.end();
      if (is_local || automaton.location == variable ||
          network_.node_status[n] == variable ||
          network_.node_caller[n] == variable) {
        nodes.push_back(NodeId{n});
      }
    }
  }

  const Network& network_;
};

}  // namespace

Subjects subjects(const Network& network,
                  const std::vector<StatePredicate>& predicates,
                  const std::vector<StatePredicate>& awaited) {
  const Owners owners(network);
  Subjects found;
  for (const StatePredicate& predicate : predicates) {
    owners.note(predicate, found.nodes, found.variables);
  }
  std::vector<StateVariableId> ignored;
  for (const StatePredicate& predicate : awaited) {
    owners.note(predicate, found.awaited, ignored);
  }
  sort_out(found.nodes);
  sort_out(found.awaited);
  sort_out(found.variables);
  return found;
}

}  // namespace btcheck
