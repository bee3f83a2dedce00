// SPDX-License-Identifier: MIT
#include "model/btcpp/entries.hpp"

#include <algorithm>
#include <utility>

namespace btcheck::btcpp {

EntryName entry_of(const BtcppExpansion& expansion, std::uint32_t subtree,
                   std::string_view name) {
  if (name.starts_with('@')) return {0, std::string(name.substr(1))};
  EntryName entry{subtree, std::string(name)};
  while (entry.subtree != 0) {
    const BtcppSubtree& around = expansion.subtrees[entry.subtree];
    const auto remapping = std::find_if(
        around.remappings.begin(), around.remappings.end(),
        [&](const BtcppRemapping& r) { return r.inner == entry.name; });
    const bool is_remapped = remapping != around.remappings.end();
    if (around.is_shared) {
      entry.subtree = around.parent;
    } else if (is_remapped && !remapping->is_literal) {
      if (remapping->outer.starts_with('@')) {
        return {0, remapping->outer.substr(1)};
      }
      entry = {around.parent, remapping->outer};
    } else if (!is_remapped && around.is_autoremapped &&
               !entry.name.starts_with('_')) {
      entry.subtree = around.parent;
    } else {
      break;
    }
  }
  return entry;
}

}  // namespace btcheck::btcpp
