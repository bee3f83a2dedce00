// SPDX-License-Identifier: MIT
//
// Fuzzes read_leaf_files and what is made of its rules: any bytes beside an XML
// tree give a tree whose parts fit together, or an error.
#include <string>
#include <string_view>

#include "../model/leaf_files_consistency.hpp"
#include "fuzzed.hpp"

namespace btcheck {

void check_bytes(std::string_view text) { require_none(flaw_of_leaves(text)); }

}  // namespace btcheck
