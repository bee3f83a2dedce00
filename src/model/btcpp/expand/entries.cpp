// SPDX-License-Identifier: MIT
#include "model/btcpp/expand/entries.hpp"

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

std::size_t ScriptDetail::most_values(const EntryName& entry) const {
  constexpr std::size_t kMostValues = 128;
  const auto found = levels.find(entry);
  return kMostValues << (found == levels.end() ? 0 : 3 * found->second);
}

double ScriptDetail::reach(const EntryName& entry) const {
  const auto found = levels.find(entry);
  const bool is_plain = found == levels.end() || found->second == 0;
  return is_plain ? 0 : static_cast<double>(most_values(entry)) / 4;
}

}  // namespace btcheck::btcpp
