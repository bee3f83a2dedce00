// SPDX-License-Identifier: MIT
//
// Profiles: which engine's nodes a tree is made of.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace btcheck {

// A named set of automata (section 8 of docs/semantics.md). Those of XML trees
// are named after the engine's release: BehaviorTree.CPP 3.8.8 and 4.10.0, and
// the branches of Nav2, of which humble stands on 3.8 and the others on 4.10.
enum class Profile : std::uint8_t {
  Paper,
  Btcpp38,
  Btcpp4,
  Nav2Humble,
  Nav2Jazzy,
  Nav2Main
};
// "paper", "btcpp-3.8", "btcpp-4", "nav2-humble", "nav2-jazzy", "nav2-main".
std::string_view profile_name(Profile profile);
std::optional<Profile> profile_named(std::string_view name);

// Trees in the XML of BehaviorTree.CPP: one thread ticks the nodes, one after
// another, and a node that is reset is idle.
constexpr bool is_engine(Profile profile) { return profile != Profile::Paper; }
// Release 3 of the engine: nothing is skipped, and no node answers running
// only to let others be heard.
constexpr bool is_release_3(Profile profile) {
  return profile == Profile::Btcpp38 || profile == Profile::Nav2Humble;
}
constexpr bool has_nav2(Profile profile) {
  return profile == Profile::Nav2Humble || profile == Profile::Nav2Jazzy ||
         profile == Profile::Nav2Main;
}

}  // namespace btcheck
