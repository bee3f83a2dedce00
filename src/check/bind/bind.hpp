// SPDX-License-Identifier: MIT
//
// Atoms of properties → predicates on the states of a network.
#pragma once

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
#include "model/tree/value_range.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// Nodes that must have been given their arguments, and where they have.
struct GivenArguments {
  Expression where;
  std::vector<NodeId> nodes;
};

// Looks names up in one tree and its network. What is wrong with an atom, or
// worth a warning, is added to `findings`; after an error nothing is returned.
// All arguments must outlive it.
class Binder {
 public:
  Binder(const BehaviorTree& tree, const Network& network,
         const SourceText& properties, std::vector<Diagnostic>& findings)
      : tree_(tree),
        network_(network),
        source_(properties),
        findings_(findings),
        names_(tree) {}

  // What an atom of the file stands for, where those before it stand for
  // `known`. After an error, and where it is not known, that is false.
  Proposition proposition(const PropertyFile& file, std::uint32_t number,
                          const std::vector<Proposition>& known);
  // The predicate of an atom about states that are not remembered.
  std::optional<StatePredicate> bind(const Atom& atom);
  // Where the atoms bound since the last call are not known.
  std::vector<OpenComparison> take_open() { return std::exchange(open_, {}); }

  // What the atoms bound since the last call need to be true or false.
  GivenArguments take_given() { return std::exchange(given_, {}); }

  // The automata of the node or state variable of `x.moves`.
  std::vector<AutomatonId> movers(const Atom& atom);

 private:
  using Bound = std::optional<Expression>;

  std::optional<StatePredicate> remembered(
      const PropertyFile& file, std::uint32_t number,
      const std::vector<Proposition>& known);

  // A side of a comparison: a constant, or a variable of the network.
  struct Side {
    std::optional<VariableId> variable;
    std::optional<Decimal> constant;
    std::string symbol;  // a name that is no variable
  };
  // A blackboard entry and the variable of the network that holds its state.
  struct Entry {
    StateVariableId number{};
    VariableId variable{};
    const StateVariable* of = nullptr;

    bool has_numbers() const;  // in some state
  };

  std::optional<NodeId> find_node(std::string_view reference, SourceSpan span);
  std::optional<std::uint32_t> process(const Atom& atom);
  Bound expression_of(const Atom& atom);
  Bound node_event(const Atom& atom);
  Bound root_event(const Atom& atom);
  Bound tick_ends(const Atom& atom);
  bool has_one_root(SourceSpan span);  // or refuses what is said of ticks
  Bound process_state(const Atom& atom);
  Bound comparison(const Atom& atom);
  Bound range(const Atom& atom);

  // A number that is calculated, counted in its last decimal, and what it can
  // be.
  struct Calculated {
    Expression value;
    ValueRange range;
    int decimals = 0;
  };
  static Calculated calculated(Decimal number);
  std::optional<Calculated> calculated(const Atom& atom,
                                       const Operand& operand);
  std::optional<Calculated> with_decimals(Calculated number, int decimals,
                                          SourceSpan span);
  // Both with as many decimals.
  bool equalize(Calculated& left, Calculated& right, SourceSpan span);
  Bound calculated_comparison(const Atom& atom);
  std::optional<Side> side(const Atom& atom, const Operand& operand);
  std::optional<Side> side_of_node(const Operand& operand);
  std::optional<Side> side_of_argument(NodeId node, const Operand& operand);
  std::vector<std::string> argument_names(NodeId node) const;
  std::optional<VariableId> state_variable_called(const Operand& operand);
  std::optional<Expression> value_of(const Side& of, const Side& other,
                                     const Operand& operand);
  std::optional<Expression> value_of_symbol(VariableId variable,
                                            const Operand& operand);
  void warn_of_range(const Atom& atom, const Variable& of, Relation relation,
                     Decimal number);
  Bound beside_number(const Atom& atom, VariableId variable, Relation relation,
                      Decimal number, SourceSpan span);

  std::optional<Entry> entry_of(std::optional<VariableId> variable) const;
  Expression known(const Atom& atom, const Entry& entry,
                   const std::vector<int>& holds, const std::vector<int>& open);
  Bound compared_entry(const Atom& atom, const Entry& entry, Relation relation,
                       const Side& other, const Operand& operand);
  Expression compared_number(const Atom& atom, const Entry& entry,
                             Relation relation, double constant);
  Bound compared_entries(const Atom& atom, const Entry& left,
                         const Entry& right);
  void leave_open(const Atom& atom, Expression where,
                  std::vector<StateVariableId> entries, std::string message,
                  std::string_view what);

  std::nullopt_t refuse_unknown(const Operand& unknown);
  // So that a function without a result can end with it.
  std::nullopt_t refuse(std::string_view code, SourceSpan span,
                        std::string message, std::string label = {},
                        std::string help = {});
  void warn(std::string_view code, SourceSpan span, std::string message,
            std::string label);
  void warn_never(const Atom& atom, std::string label);
  void warn_of_case(SourceSpan span, std::string_view written,
                    std::string_view declared, std::string_view name);

  const BehaviorTree& tree_;
  const Network& network_;
  const SourceText& source_;
  std::vector<Diagnostic>& findings_;
  NodeNames names_;
  std::vector<OpenComparison> open_;
  GivenArguments given_;
};

// The key of the bit that stands for an atom of the past.
std::string past_key(const PropertyFile& file, std::uint32_t number);

// Where a node's automaton is in the location; false when it has none of this
// name.
Expression node_in_location(const Network& network, NodeId node,
                            LocationRole role);

// True when an atom that is an event of steps occurs in the formula.
bool speaks_of_steps(const FormulaPool& formulas, FormulaId formula,
                     const std::vector<Proposition>& atoms);

// The predicate of a formula without temporal operators and events of steps.
// Nothing when its text written out would exceed kMostTerms terms.
inline constexpr std::size_t kMostTerms = 20'000;
std::optional<StatePredicate> predicate_of(
    const FormulaPool& formulas, FormulaId formula,
    const std::vector<Proposition>& atoms);

// Three-valued (Kleene): `given` says of each atom where it has a truth value.
// What certainly holds, and what certainly does not fail.
struct DefinitePredicates {
  StatePredicate holds;
  StatePredicate may_hold;
};
std::optional<DefinitePredicates> definite_predicates(
    const FormulaPool& formulas, FormulaId formula,
    const std::vector<Proposition>& atoms,
    const std::vector<GivenArguments>& given);

// A part `[] P` of a formula with a P that is false, or `<> P` with one that is
// true, while no node has been given arguments.
std::optional<FormulaId> false_without_arguments(
    const FormulaPool& formulas, FormulaId formula,
    const std::vector<Atom>& atoms, const std::vector<GivenArguments>& given,
    const NodeNames& names);

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
