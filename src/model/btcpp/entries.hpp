// SPDX-License-Identifier: MIT
//
// Names inside subtrees, followed to the entries they mean.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/btcpp/expansion.hpp"

namespace btcheck::btcpp {

// An entry: a name on the blackboard of one subtree.
struct EntryName {
  std::uint32_t subtree = 0;
  std::string name;

  auto operator<=>(const EntryName&) const = default;
};

// The entry that a name means inside a subtree: `@name` is the root's, a
// remapped name is the parent's, and with `_autoremap` any that does not begin
// with `_` (Blackboard::createEntryImpl of BehaviorTree.CPP 4.10).
EntryName entry_of(const BtcppExpansion& expansion, std::uint32_t subtree,
                   std::string_view name);

}  // namespace btcheck::btcpp
