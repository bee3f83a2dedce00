// SPDX-License-Identifier: MIT
//
// Properties and assumptions with every atom bound to one network.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "check/bind/bind.hpp"
#include "check/bind/verdict.hpp"
#include "ltl/rules/property.hpp"
#include "ltl/timed/timed_pattern.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// A real-time pattern over predicates: bit i of the pattern's propositions is
// predicates[i], written as texts[i].
struct BoundPattern {
  std::vector<StatePredicate> predicates;
  std::vector<std::string> texts;
  TimedPattern pattern;

  // Of one of the pattern's propositions; "" for none.
  std::string text(PropositionSet bit) const {
    return bit == 0 ? ""
                    : texts[static_cast<std::size_t>(std::countr_zero(bit))];
  }
};

// The condition whose occurrences a property is about.
struct BoundTrigger {
  StatePredicate predicate;
  std::string text;
};

// Where a proposition stands in its file.
struct PropositionOrigin {
  std::string text;  // "" where it belongs to an assumption
  bool is_scope = false;
};

// The smallest part of a property that is true or false of a state or step.
struct PropertyAtom {
  std::string text;  // as written
  Proposition is;
};

struct BoundProperty {
  const Property* property = nullptr;
  // How it is checked: `[] P` of a P without temporal operators is checked as
  // `always P`, `EF P` as `possible P`, which is the same and gives a shortest
  // run.
  PropertyForm form = PropertyForm::Ltl;
  StatePredicate predicate;    // P of never, always, possible
  std::string predicate_text;  // as written
  BoundPattern timed;          // Timed
  // The file has assumptions; those of branching time do not change.
  bool is_assumed = false;
  // Ltl, Branching. Of all that is assumed: violated by the runs that satisfy
  // the assumptions and violate (for `possible`: show) the property. Of a timed
  // pattern: satisfied by those runs, where `due` stands for the observer's
  // verdict.
  BoundFormula formula;
  std::size_t due = 0;  // its number among the propositions
  // Of an assumed pattern: violated by the assumed runs with an occurrence.
  std::optional<BoundFormula> without;
  std::optional<BoundTrigger> trigger;
  std::vector<PropositionOrigin> origins;  // Ltl, Branching: of `formula`
  std::vector<PropertyAtom> atoms;         // of all that it says
  Subjects subjects;
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
  std::vector<Expression> atoms;  // all that anything here asks of a state
};

// Which assumptions are in force besides those of the file.
enum class ExtraAssumption : std::uint8_t { None, ActionsEnd };

// Adds to the network of a tree what the files ask of its nodes' arguments;
// before they are bound, and once.
void keep_asked_arguments(const BehaviorTree& tree,
                          std::span<const PropertyFile* const> files,
                          Network& network);

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
