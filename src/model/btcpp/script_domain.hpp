// SPDX-License-Identifier: MIT
//
// Which blackboard entries become state variables, and their values.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "model/btcpp/entries.hpp"
#include "model/btcpp/expansion.hpp"
#include "model/btcpp/script_value.hpp"
#include "model/btcpp/script_writers.hpp"
#include "model/tree.hpp"

namespace btcheck::btcpp {

// The values of an entry, by those of its state variable.
struct ScriptDomain {
  std::vector<ScriptValue> values = {ScriptValue{}};  // the first is Unknown
  // Numbers beyond these are kept as `at least` and `at most` only.
  double lowest = 0;
  double highest = 0;
  // The tree gives it texts and nothing else, and no port a type: then what is
  // assigned is kept as it is. Elsewhere a text may be converted.
  bool is_text = true;
  bool takes_texts = false;  // also where they are not kept
  // SetBlackboard may leave the entry without a value instead of a text.
  bool may_be_empty = false;

  // What is kept of a value; Unknown when it is neither kept as it is nor as
  // part of a range.
  ScriptValue kept(const ScriptValue& value) const;
  // The value of the state variable; 0 when the entry's is not among them.
  std::size_t index_of(const ScriptValue& value) const;
};

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
};

// Of version 3, which has no scripts, nothing is modelled.
ScriptWorld script_world(const BtcppExpansion& expansion,
                         const ContractScripts& contracts = {});

}  // namespace btcheck::btcpp
