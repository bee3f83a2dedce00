// SPDX-License-Identifier: MIT
//
// Comments that allow findings: `<!-- btcheck: allow BT2208: the last recovery
// ends it -->`, in .btf files `; btcheck: allow BT2205`. They count in their
// own line, and in the one right below lines of comments.
#pragma once

#include <string_view>

namespace btcheck {

inline constexpr std::string_view kAllow = "btcheck: allow";

// What a comment in the line allows, from its first code on; "" for nothing.
constexpr std::string_view allowed_in(std::string_view line) {
  const auto at = line.find(kAllow);
  return at == line.npos ? std::string_view() : line.substr(at + kAllow.size());
}

// A line of comments alone, as far as one line tells.
constexpr bool is_comment_line(std::string_view line) {
  const auto first = line.find_first_not_of(" \t?");
  if (first == line.npos) return false;
  const std::string_view text = line.substr(first);
  return text.starts_with("<!--") || text.starts_with(';') ||
         text.ends_with("-->");
}

}  // namespace btcheck
