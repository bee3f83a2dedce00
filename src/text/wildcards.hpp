// SPDX-License-Identifier: MIT
//
// Patterns for the names of leaves and files.
#pragma once

#include <string_view>

namespace btcheck {

// Whether the whole text is what the pattern says: `*` is any text, "" and `/`
// included, `?` any one byte, all else itself. As in the filters of
// BehaviorTree.CPP's substitution rules (utils/wildcards.hpp of 4.10).
bool matches_wildcard(std::string_view pattern, std::string_view text);

// The same for a file, by its path in the folder of the pattern: one without a
// `/` is about the file's own name.
bool matches_path(std::string_view pattern, std::string_view path);

}  // namespace btcheck
