// SPDX-License-Identifier: MIT
//
// What formatting has kept of a tree: the network that is checked.
#pragma once

#include <string>

#include "check/check.hpp"

namespace btcheck {

// What is otherwise in the second network than in the first, "" for nothing.
// Places count as little as names that are made of a type and a line, and the
// order of what is declared.
std::string difference(const LoweredInput& before, const LoweredInput& after);

}  // namespace btcheck
