// SPDX-License-Identifier: MIT
//
// The values of one blackboard entry: which of them are told apart, and the
// state variable that has them.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/script/value.hpp"
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

// A state variable for each of the entries, under a name that properties can
// use. An entry with a literal begins with it, all others begin as unknown.
std::vector<StateVariable> entry_variables(
    const BtcppExpansion& expansion, const std::vector<EntryName>& entries,
    const std::vector<ScriptDomain>& domains,
    const std::map<EntryName, ScriptValue>& literals);

}  // namespace btcheck::btcpp
