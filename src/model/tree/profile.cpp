// SPDX-License-Identifier: MIT
#include "model/tree/profile.hpp"

#include <algorithm>
#include <array>

namespace btcheck {
namespace {

constexpr std::array<std::string_view, 6> kNames = {
    "paper", "btcpp-3.8", "btcpp-4", "nav2-humble", "nav2-jazzy", "nav2-main"};

}  // namespace

std::string_view profile_name(Profile profile) {
  return kNames[static_cast<std::size_t>(profile)];
}

std::optional<Profile> profile_named(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Profile>(found - kNames.begin());
}

}  // namespace btcheck
