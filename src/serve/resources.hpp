// SPDX-License-Identifier: MIT
//
// Documents and examples that are part of the program.
#pragma once

#include <span>
#include <string_view>

namespace btcheck {

struct ResourceRow {
  std::string_view name;   // "docs/findings.md"
  std::string_view title;  // what it is about, in a few words
  std::string_view text;
};

std::span<const ResourceRow> resources();

}  // namespace btcheck
