// SPDX-License-Identifier: MIT
//
// Which blackboard entries become state variables, and their values.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/expand/writers.hpp"
#include "model/btcpp/script/value.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

// The values of an entry, by those of its state variable.
struct ScriptDomain {
  std::vector<ScriptValue> values = {ScriptValue{}};  // the first is Unknown
  // Numbers beyond these are kept as `at least` and `at most` only.
  double lowest = 0;
  double highest = 0;
  // Before the tree writes it: its type, and whether the engine has made it.
  EntryType declared = EntryType::Free;
  bool exists = false;

  // What is kept of a value: as it is, as part of a range, or Any.
  ScriptValue kept(const ScriptValue& value) const;
  // The value of the state variable; 0 when the entry's is not among them.
  std::size_t index_of(const ScriptValue& value) const;
};

inline constexpr std::string_view kNothingWrites =
    "nothing in the tree writes it";

struct AbstractedEntry {
  EntryName entry;
  std::string reason;  // "nothing in the tree writes it"
};

// The entries of all blackboards that scripts, contracts, SetBlackboard and the
// literals of SubTrees alone write, as state variables; in each, 0 is
// `unknown`.
struct ScriptWorld {
  std::vector<StateVariable> variables;
  std::vector<ScriptDomain> domains;  // of each variable
  std::map<EntryName, StateVariableId> of;
  // Of those that scripts read, or contracts name.
  std::vector<AbstractedEntry> abstracted;
  // By entry, modelled or not: what is mentioned together has one number.
  std::map<EntryName, std::size_t> groups;
  std::map<EntryName, std::uint32_t> first_node;  // that mentions it
  ScriptWriters writers;
  // Without a state variable, though scripts alone write them.
  std::set<EntryName> lost;
};

ScriptWorld script_world(const BtcppExpansion& expansion,
                         const ContractScripts& contracts = {},
                         const ScriptDetail& detail = {});

}  // namespace btcheck::btcpp
