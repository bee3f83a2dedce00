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

#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/expand/writers.hpp"
#include "model/btcpp/script/value.hpp"
#include "model/tree/granted.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

// The values of an entry; value i is state i of its state variable.
struct ScriptDomain {
  std::vector<ScriptValue> values = {ScriptValue{}};  // the first is Unknown
  // Numbers beyond these are kept as `at least` and `at most` only.
  double lowest = 0;
  double highest = 0;
  // Before the tree writes it: its type, and whether the engine has made it.
  EntryType declared = EntryType::Free;
  bool exists = false;
  bool is_typed_by_leaves = false;  // as in ScriptWriters
  // Of what type the values are that leaves write; Free: of any.
  EntryType outside = EntryType::Free;
  // What it is declared to hold: an assignment of anything else ends the run.
  std::optional<DeclaredDomain> limits;
  // Those of its values that it may be measured, or move to.
  std::vector<ScriptValue> measured;

  // Keeps numbers apart at least as far as this one.
  void widen(double number);
  // What is kept of a value: as it is, as part of a range, or Any.
  ScriptValue kept(const ScriptValue& value) const;
  // The number of its state; 0, unknown, when the value is not in the domain.
  std::size_t index_of(const ScriptValue& value) const;
};

// A union-find structure over entries.
class EntryGroups {
 public:
  void join(const EntryName& one, const EntryName& other);
  EntryName first_of(EntryName entry);
  // The number of the group of each entry that has been asked for.
  std::map<EntryName, std::size_t> numbers();

 private:
  std::map<EntryName, EntryName> above_;
};

// What rules compare the entry with; nothing where no rule can mean it.
std::optional<std::set<double>> asked_of(const ScriptDetail& detail,
                                         const EntryName& entry);
// A name that a rule puts beside the entry, and that may be another one; or "".
std::string compared_with(const ScriptDetail& detail, const EntryName& entry);
// How many of its values are kept apart.
std::size_t most_values(const ScriptDetail& detail, const EntryName& entry);

// The names that properties have for entries, which are ordered by subtree, so
// that the root's come first; those of `known` keep theirs.
std::vector<std::string> names_of_entries(
    const BtcppExpansion& expansion, const std::vector<EntryName>& entries,
    const std::map<EntryName, std::string>& known = {});

// A state variable for each of the entries, under a name that properties can
// use. An entry with a literal begins with it, all others begin as unknown.
std::vector<StateVariable> entry_variables(
    const BtcppExpansion& expansion, const std::vector<EntryName>& entries,
    const std::vector<ScriptDomain>& domains,
    const std::map<EntryName, ScriptValue>& literals);

// What a declared number can have at most: each a state, and of one that moves
// by itself each a move to every other.
inline constexpr std::size_t kMostDeclared = 1024;
inline constexpr std::size_t kMostMoving = 256;

// State variables for the entries, of all blackboards, that nothing but
// scripts, contracts, SetBlackboard, literals of SubTrees and the ports of
// leaves writes; what only ports write, where a script mentions it. State 0 of
// each is `unknown`.
struct ScriptWorld {
  std::vector<StateVariable> variables;
  std::vector<ScriptDomain> domains;  // of each variable
  std::map<EntryName, StateVariableId> of;
  // Of those that scripts read, or contracts name: why they have no variable.
  std::map<EntryName, std::string> abstracted;
  // Entries that one script mentions have the same number, modelled or not.
  std::map<EntryName, std::size_t> groups;
  std::map<EntryName, std::uint32_t> first_node;  // that mentions it
  ScriptWriters writers;
  // Without a state variable, though scripts alone write them.
  std::set<EntryName> lost;
  // Of declared entries: why they have too many values.
  std::map<EntryName, std::string> too_large;

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
