// SPDX-License-Identifier: MIT
//
// Names inside subtrees, followed to the entries they mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "model/btcpp/expand/expansion.hpp"

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

// How closely values are told apart: beyond it an entry is given up, or
// counted in ranges. Each level takes eight times as many.
struct ScriptDetail {
  static constexpr int kMostLevels = 2;
  std::map<EntryName, int> levels;  // 0 for those that are not named

  std::size_t most_values(const EntryName& entry) const;
  // How far ranges lie beyond the numbers in the scripts.
  double reach(const EntryName& entry) const;
};

}  // namespace btcheck::btcpp
