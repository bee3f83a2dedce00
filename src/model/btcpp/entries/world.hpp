// SPDX-License-Identifier: MIT
//
// Which blackboard entries become state variables, and what values they have.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/entries/domain.hpp"
#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/expand/writers.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

inline constexpr std::string_view kNothingWrites =
    "nothing in the tree writes it";

struct AbstractedEntry {
  EntryName entry;
  std::string reason;  // "nothing in the tree writes it"
};

// State variables for the entries, of all blackboards, that nothing but
// scripts, contracts, SetBlackboard and literals of SubTrees writes. State 0 of
// each is `unknown`.
struct ScriptWorld {
  std::vector<StateVariable> variables;
  std::vector<ScriptDomain> domains;  // of each variable
  std::map<EntryName, StateVariableId> of;
  // Of those that scripts read, or contracts name.
  std::vector<AbstractedEntry> abstracted;
  // Entries that one script mentions have the same number, modelled or not.
  std::map<EntryName, std::size_t> groups;
  std::map<EntryName, std::uint32_t> first_node;  // that mentions it
  ScriptWriters writers;
  // Without a state variable, though scripts alone write them.
  std::set<EntryName> lost;

  // Nothing where the entry has no state variable.
  std::optional<StateVariableId> variable_of(const EntryName& entry) const;
  const ScriptDomain& domain(StateVariableId variable) const {
    return domains[index(variable)];
  }
};

ScriptWorld script_world(const BtcppExpansion& expansion,
                         const ContractScripts& contracts = {},
                         const ScriptDetail& detail = {});

}  // namespace btcheck::btcpp
