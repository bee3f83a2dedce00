// SPDX-License-Identifier: MIT
//
// The pages beside those of runs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace btcheck {

struct ListedRun {
  std::string name;
  bool is_there = false;
};

// A link to the page of each. It looks again by itself while one is missing.
std::string list_page(const std::vector<ListedRun>& runs,
                      std::string_view token);

// In the place of a run that is not there yet; it looks again by itself.
std::string waiting_page(std::string_view name);

}  // namespace btcheck
