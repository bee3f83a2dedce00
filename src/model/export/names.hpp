// SPDX-License-Identifier: MIT
//
// The names of a network's variables, their values and its clocks in Promela,
// SMV and Fiacre.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/automata/network.hpp"

namespace btcheck {

// The text with `_` for every character that is no letter of ASCII and no
// digit, and `n_` in front of a leading digit.
std::string as_identifier(std::string_view text);

// Identifiers that are unique and no words of Promela, C, SMV or Fiacre. The
// network must outlive it.
class ExportNames {
 public:
  struct Constant {
    std::string name;
    int value = 0;
  };

  explicit ExportNames(const Network& network);

  const std::string& variable(VariableId id) const {
    return variables_[index(id)];
  }
  const std::string& clock(AutomatonId id) const { return clocks_[index(id)]; }
  // Of a process for the automaton, where a language has one.
  const std::string& process(AutomatonId id) const {
    return processes_[index(id)];
  }
  // Of the macro that says that no time may pass.
  const std::string& urgency(AutomatonId id) const {
    return urgencies_[index(id)];
  }
  // Whether the values of a variable have names, each its own.
  bool has_named_values(VariableId id) const {
    return !values_[index(id)].empty();
  }
  // The name of a variable's value where it has one, else the number.
  std::string value(VariableId id, std::int64_t value) const;
  // The names of the values that a variable has to itself.
  std::vector<Constant> constants(VariableId id) const;
  // The names of the values of every rstatus.
  std::vector<Constant> statuses() const;

 private:
  std::string unique(std::string_view wanted);
  void name_automaton(const Automaton& automaton);
  void name_values(VariableId id, const std::string& stem);

  const Network& network_;
  std::set<std::string> used_;
  std::vector<std::string> clocks_;
  std::vector<std::string> urgencies_;
  std::vector<std::string> processes_;
  std::vector<std::string> variables_;
  std::vector<std::vector<std::string>> values_;  // by variable; may be empty
  std::vector<std::string> statuses_;
};

}  // namespace btcheck
