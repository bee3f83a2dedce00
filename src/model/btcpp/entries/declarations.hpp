// SPDX-License-Identifier: MIT
//
// Entries that a file beside the tree declares: which values they have, which
// of them are states, and how they move.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/btcpp/entries/told_apart.hpp"
#include "model/btcpp/entries/world.hpp"
#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/expand/writers.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

class Declarations {
 public:
  explicit Declarations(std::map<EntryName, EntryDeclaration> all)
      : all_(std::move(all)) {}

  const std::map<EntryName, EntryDeclaration>& all() const { return all_; }

  // Decides of each its type, with what it begins, and whether it moves by
  // itself: `written` are the entries that the tree writes. First values of
  // those that move are added to the writers' literals.
  void settle(const BtcppExpansion& expansion,
              const std::set<EntryName>& written, const ScriptDetail& detail,
              ScriptWriters& writers);

  // Of a declared entry: its values, one for each region. True where it has one
  // from the beginning. Does nothing to another.
  bool limit(const EntryName& entry, const ScriptWriters& writers,
             ScriptDomain& domain);

  // Likewise how its state variable moves, or is measured.
  void set_moves(const EntryName& entry, const ScriptDomain& domain,
                 StateVariable& variable) const;

  // Why they have too many values.
  const std::map<EntryName, std::string>& too_large() const {
    return too_large_;
  }

 private:
  std::vector<ScriptValue> values_of(const EntryName& entry,
                                     const EntryDeclaration& declared);

  std::map<EntryName, EntryDeclaration> all_;
  std::map<EntryName, ToldApart> told_apart_;
  std::map<EntryName, std::string> too_large_;
};

}  // namespace btcheck::btcpp
