// SPDX-License-Identifier: MIT
#include "model/tree/granted.hpp"

#include <fmt/format.h>

#include "text/findings.hpp"

namespace btcheck {
namespace {

// "the program sets `a`, `b`, `c` and 2 more"
void say(std::string_view does, std::vector<std::string> names,
         std::vector<std::string>& all) {
  constexpr std::size_t kMostNamed = 3;
  if (names.empty()) return;
  if (names.size() <= kMostNamed + 1) {
    all.push_back(fmt::format("the program {} {}", does, listed(names)));
    return;
  }
  const std::size_t more = names.size() - kMostNamed;
  names.resize(kMostNamed);
  all.push_back(fmt::format("the program {} `{}` and {} more", does,
                            fmt::join(names, "`, `"), more));
}

}  // namespace

std::vector<std::string> granted(const BehaviorTree& tree) {
  std::vector<std::string> set;
  std::vector<std::string> registered;
  for (const OpenEntry& entry : tree.open_entries) {
    if (entry.reason == kMayBeEnumerator) {
      registered.push_back(entry.name);
    } else if (entry.reason == kNothingWrites ||
               entry.reason == kNothingCreates) {
      set.push_back(entry.name);
    }
  }
  std::vector<std::string> all;
  say("sets", std::move(set), all);
  say("registers", std::move(registered), all);
  return all;
}

}  // namespace btcheck
