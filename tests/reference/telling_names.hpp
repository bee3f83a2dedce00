// SPDX-License-Identifier: MIT
//
// Names for the leaves of random trees from which findings take hints.
#pragma once

#include <cstdint>
#include <string>

namespace btcheck::reference {

// The text with "OpenGripper" or the like for each a1, a2, … and "IsStuck" for
// each c1, c2, …, wherever they stand as words of their own; as many as there
// are names. Equal seeds give equal names.
std::string with_telling_names(const std::string& text, std::uint64_t seed);

}  // namespace btcheck::reference
