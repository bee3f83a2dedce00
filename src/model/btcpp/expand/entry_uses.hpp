// SPDX-License-Identifier: MIT
//
// Who names each blackboard entry, and whether to read or to write it. A port
// whose direction nobody tells may do both.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "model/btcpp/expand/expansion.hpp"

namespace btcheck::btcpp {

struct EntryUse {
  BtcppPlace place;
  std::string written;     // the name as it stands there
  std::uint32_t node = 0;  // of the expansion
};

struct EntryUses {
  std::size_t mentions = 0;
  EntryUse first;  // in the order of the tree
  // The first of each kind.
  std::optional<EntryUse> needed;  // by a script that needs a value
  std::optional<EntryUse> read;    // by such, or an input port
  std::optional<EntryUse> write;   // by what may write
  bool may_be_read = false;
  // What may write it calls it as its blackboard does, not by a remapping.
  bool is_written_by_name = false;
  // Otherwise nothing but scripts and SetBlackboard writes it.
  bool has_other_writer = false;

  bool may_be_written() const { return write || has_other_writer; }
};

struct UsesOfEntries {
  std::map<EntryName, EntryUses> of;
  // A SetBlackboard reads from the blackboard which entry it writes.
  bool may_any_be_written = false;
};

UsesOfEntries uses_of_entries(const BtcppExpansion& expansion);

}  // namespace btcheck::btcpp
