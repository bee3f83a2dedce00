// SPDX-License-Identifier: MIT
//
// Atoms of properties → predicates on the states of a network.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/bind/node_names.hpp"
#include "check/bind/verdict.hpp"
#include "explore/reduce/labels.hpp"
#include "ltl/rules/property.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// Looks names up in one tree and its network. All three must outlive it.
class Binder {
 public:
  Binder(const BehaviorTree& tree, const Network& network,
         const SourceText& properties)
      : tree_(tree), network_(network), source_(properties), names_(tree) {}

  // The predicate of an atom. What is wrong with it, or worth a warning, is
  // added to `findings`; nothing is returned when that is an error.
  // The atom is about states; where it is not known it is taken to be false.
  std::optional<StatePredicate> bind(const Atom& atom,
                                     std::vector<Diagnostic>& findings);
  // Where the atoms bound since the last call are not known.
  std::vector<OpenComparison> take_open() { return std::exchange(open_, {}); }

  // The automata of the node or state variable of `x.moves`; none after an
  // error.
  std::vector<AutomatonId> movers(const Atom& atom,
                                  std::vector<Diagnostic>& findings) const;

 private:
  using Findings = std::vector<Diagnostic>;

  // A side of a comparison: a constant, or a variable of the network.
  struct Side {
    std::optional<VariableId> variable;
    std::optional<std::int64_t> constant;
    std::string symbol;  // a name that is no variable
  };

  std::optional<NodeId> find_node(std::string_view reference, SourceSpan span,
                                  Findings& findings) const;
  std::optional<std::uint32_t> process(const Atom& atom,
                                       Findings& findings) const;
  std::optional<StatePredicate> node_event(const Atom& atom,
                                           Findings& findings) const;
  std::optional<StatePredicate> root_event(const Atom& atom,
                                           Findings& findings) const;
  std::optional<StatePredicate> process_state(const Atom& atom,
                                              Findings& findings) const;
  std::optional<StatePredicate> comparison(const Atom& atom,
                                           Findings& findings);
  std::optional<StatePredicate> range(const Atom& atom, Findings& findings);
  std::optional<StatePredicate> word(const Atom& atom,
                                     Findings& findings) const;
  std::optional<Side> side(const Atom& atom, const Operand& operand,
                           Findings& findings) const;
  std::optional<Side> side_of_node(const Operand& operand,
                                   Findings& findings) const;
  std::optional<VariableId> state_variable_called(const Operand& operand,
                                                  Findings& findings) const;
  std::optional<Expression> value_of(const Atom& atom, const Side& of,
                                     const Side& other, const Operand& operand,
                                     Findings& findings) const;
  std::optional<VariableId> variable_of_node(NodeId node,
                                             std::string_view name) const;
  std::optional<Expression> value_of_symbol(VariableId variable,
                                            const Operand& operand,
                                            Findings& findings) const;
  // A blackboard entry and the variable of the network that holds its state.
  struct Entry {
    StateVariableId number{};
    VariableId variable{};
    const StateVariable* of = nullptr;
  };
  // One state of an entry: it holds there, or that is not known.
  struct Truths {
    std::vector<int> holds;
    std::vector<int> open;

    auto operator<=>(const Truths&) const = default;
  };

  std::optional<Entry> entry_of(std::optional<VariableId> variable) const;
  static std::optional<bool> compared_with_state(const Entry& entry, int state,
                                                 Relation relation, int name);
  template <class Truth>
  static Truths truths(const Entry& entry, Truth truth);
  Expression known(const Atom& atom, const Entry& entry, const Truths& found);
  std::optional<StatePredicate> compared_entry(
      const Atom& atom, const Entry& entry, Relation relation,
      const Side& other, const Operand& operand, Findings& findings);
  Expression compared_number(const Atom& atom, const Entry& entry,
                             Relation relation, double constant,
                             Findings& findings);
  static std::map<Truths, std::vector<int>> alike_beside(const Atom& atom,
                                                         const Entry& left,
                                                         const Entry& right);
  std::optional<StatePredicate> compared_entries(const Atom& atom,
                                                 const Entry& left,
                                                 const Entry& right);
  void warn_of_range(const Atom& atom, VariableId variable,
                     std::int64_t constant, Findings& findings) const;

  Expression in_location(NodeId node, LocationRole role) const;
  Expression is_active(NodeId node) const;
  Expression roots_in(LocationRole role, Operation joined) const;
  Expression has_ended(NodeId root) const;
  Expression all_roots_ended() const;

  Diagnostic error(std::string_view code, SourceSpan span, std::string message,
                   std::string label = {}, std::string help = {}) const;

  const BehaviorTree& tree_;
  const Network& network_;
  const SourceText& source_;
  NodeNames names_;
  std::vector<OpenComparison> open_;
};

// Where a node's automaton is in the location; false when it has none of this
// name.
Expression node_in_location(const Network& network, NodeId node,
                            LocationRole role);

// Of a state that may be dead or not.
inline StatePredicate plain(Expression expression) {
  return {std::move(expression), std::nullopt};
}

// Whether a blackboard entry may hold a number.
bool has_numbers(const StateVariable& entry);

// What predicates speak of; `awaited` among them an answer is waited from.
Subjects subjects(const Network& network,
                  const std::vector<StatePredicate>& predicates,
                  const std::vector<StatePredicate>& awaited);

// True when an atom that is an event of steps occurs in the formula.
bool speaks_of_steps(const FormulaPool& formulas, FormulaId formula,
                     const std::vector<Proposition>& atoms);

// The predicate of a formula without temporal operators and events of steps.
// Nothing when its text written out would exceed kMostTerms terms.
inline constexpr std::size_t kMostTerms = 20'000;
std::optional<StatePredicate> predicate_of(
    const FormulaPool& formulas, FormulaId formula,
    const std::vector<Proposition>& atoms);

// A formula whose greatest parts without temporal operators have become
// propositions: atom i of `formula` is propositions[i], which stands for
// sources[i] of the pool it was made from.
struct BoundFormula {
  FormulaPool pool;
  FormulaId formula{};
  std::vector<Proposition> propositions;
  std::vector<FormulaId> sources;
};
// Nothing when there are more than kMaxPropositions of them, or one is too
// large.
std::optional<BoundFormula> bind_formula(const FormulaPool& formulas,
                                         FormulaId formula,
                                         const std::vector<Proposition>& atoms);

}  // namespace btcheck
