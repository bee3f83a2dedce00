// SPDX-License-Identifier: MIT
//
// Who reads and who writes a variable, and what is certain of one guard,
// assignment or edge: read off the tables.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "model/automata/network.hpp"

namespace btcheck {

// The value that an assignment gives, if it is a constant.
std::optional<int> constant_value(const Assignment& assignment);

// What a guard demands of variables, each of them once: its conjuncts of the
// form variable = value.
std::vector<std::pair<VariableId, int>> demanded_values(
    const Expression& guard);
// The value that it demands of one, if it demands one.
std::optional<int> demanded_value(const Expression& guard, VariableId variable);

// Whether a guard rules this value of a variable out.
bool excludes(const Expression& guard, VariableId variable, int value);
// All that it rules out, as bits, the lowest value first; of a variable with no
// more than 64 values.
std::uint64_t excluded_values(const Network& network, const Expression& guard,
                              VariableId variable);

// Whether time must pass between coming to the edge's source and taking it.
bool takes_time(const Network& network, const Edge& edge);

// Calls read(variable, value) for each comparison of a variable with a
// constant, and read(variable, nothing) wherever else a variable is read.
template <class Read>
void for_each_read(const Expression& expression, Read&& read) {
  const std::span<const Term> terms = expression.terms();
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (terms[i].operation != Operation::Variable) continue;
    const VariableId variable{static_cast<std::uint32_t>(terms[i].operand)};
    const bool is_comparison = i + 2 < terms.size() &&
                               terms[i + 1].operation == Operation::Constant &&
                               (terms[i + 2].operation == Operation::Equal ||
                                terms[i + 2].operation == Operation::NotEqual);
    read(variable, is_comparison ? std::optional<int>(terms[i + 1].operand)
                                 : std::nullopt);
  }
}

// Calls writes(variable) and reads(variable) for what the edge does with
// variables. It does both with the automaton's location; that it reads the
// gate, as each edge of the automaton does, is not told.
template <class Reads, class Writes>
void for_each_access(const Automaton& automaton, const Edge& edge,
                     Reads&& reads, Writes&& writes) {
  const auto read = [&](VariableId variable, std::optional<int>) {
    reads(variable);
  };
  writes(automaton.location);
  reads(automaton.location);
  for_each_read(edge.guard, read);
  for (const Assignment& update : edge.updates) {
    for_each_read(update.value, read);
    writes(update.variable);
  }
}

// By VariableId, the automata that have an edge that reads or writes it, each
// once and in order. The edges of an automaton read its gate.
struct Accesses {
  explicit Accesses(const Network& network);

  // Whether it stands where its own edges have brought it, and nobody else's.
  // (Time moves what is outside of a part, as a component.)
  bool moves_alone(const Network& network, AutomatonId automaton) const;
  // Whether nobody else reads or writes the variable.
  bool are_only_by(std::span<const AutomatonId> automata,
                   VariableId variable) const;
  // Whether nobody else writes it.
  bool are_written_only_by(std::span<const AutomatonId> automata,
                           VariableId variable) const;

  std::vector<std::vector<AutomatonId>> readers;
  std::vector<std::vector<AutomatonId>> writers;
};

}  // namespace btcheck
