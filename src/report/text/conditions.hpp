// SPDX-License-Identifier: MIT
//
// What an answer depends on: what the rules assume, and what the program around
// the tree is taken to do.
#pragma once

#include <string>
#include <vector>

#include "check/check.hpp"

namespace btcheck {

// All that the answers of a file depend on, "calm", "the program sets `x`".
std::vector<std::string> conditions_of(const CheckResult& result,
                                       const CheckedFile& file);

// How a verdict came about, and where it holds what of the program it needs.
std::string note_with_conditions(const CheckResult& result,
                                 const CheckedFile& file,
                                 const PropertyVerdict& verdict);

}  // namespace btcheck
