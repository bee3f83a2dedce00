// SPDX-License-Identifier: MIT
//
// Properties and assumptions with every atom bound to one network.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "check/bind/bind.hpp"
#include "check/bind/verdict.hpp"
#include "ltl/rules/property.hpp"
#include "ltl/timed/timed_pattern.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// A real-time pattern over predicates: bit i of the pattern's propositions is
// predicates[i].
struct BoundPattern {
  std::vector<StatePredicate> predicates;
  TimedPattern pattern;
  std::string trigger;  // texts, "" for none
  std::string opening;
  std::string closing;
  std::string answer = {};
};

// The condition whose occurrences a property is about.
struct BoundTrigger {
  StatePredicate predicate;
  std::string text;
};

// What a property becomes under the assumptions of its file.
struct UnderAssumptions {
  // Violated by the runs that satisfy the assumptions and violate (for
  // `possible`: show) the property. Of a timed pattern: satisfied by those
  // runs, where `due` stands for the observer's verdict.
  BoundFormula formula;
  std::size_t due = 0;  // Timed: its number among the propositions
  // Timed: violated by the assumed runs with an occurrence.
  std::optional<BoundFormula> without;
};

// Where a proposition stands in its file.
struct PropositionOrigin {
  std::string text;  // "" where it belongs to an assumption
  bool is_scope = false;
};

struct BoundProperty {
  const Property* property = nullptr;
  // How it is checked: `[] P` of a P without temporal operators is checked as
  // `always P`, `EF P` as `possible P`, which is the same and gives a shortest
  // run.
  PropertyForm form = PropertyForm::Ltl;
  StatePredicate predicate;    // P of never, always, possible
  std::string predicate_text;  // as written
  BoundFormula formula;        // Ltl, Branching
  BoundPattern timed;          // Timed
  std::optional<BoundTrigger> trigger;
  // Ltl, Branching: of the propositions of the formula that is searched.
  std::vector<PropositionOrigin> origins;
  Subjects subjects;
  std::optional<UnderAssumptions> assumed;  // set when there are assumptions
  std::vector<OpenComparison> comparisons;  // of it and of the assumptions
};

// Answered by a search for a single state.
inline bool asks_of_states(PropertyForm form) {
  return form == PropertyForm::Never || form == PropertyForm::Invariant ||
         form == PropertyForm::Possible || form == PropertyForm::DeadlockFree;
}

// Infinitely often requested implies infinitely often granted.
struct FairnessPair {
  StatePredicate requested;
  StatePredicate granted;
};

// What is requested and granted, pair by pair.
std::vector<StatePredicate> predicates_of(
    const std::vector<FairnessPair>& conditions);

struct BoundAssumptions {
  std::vector<std::string> names;    // as verdicts tell them
  std::vector<FairnessPair> strong;  // checked by components, not by formula
  BoundFormula formula;              // all others; true when there are none
  bool has_formula = false;

  bool empty() const { return names.empty(); }
};

struct BoundFile {
  std::vector<BoundProperty> properties;
  BoundAssumptions assumptions;
};

// Which assumptions are in force besides those of the file.
enum class ExtraAssumption : std::uint8_t { None, ActionsEnd };

// Binds every property and assumption of a file; every error is reported. The
// tree, the network and the file must outlive the result.
Result<BoundFile> bind_properties(const BehaviorTree& tree,
                                  const Network& network,
                                  const PropertyFile& properties,
                                  const SourceText& source,
                                  ExtraAssumption extra);

// Text of a formula in the words of its file.
std::string formula_text(const PropertyFile& file, FormulaId formula);

}  // namespace btcheck
