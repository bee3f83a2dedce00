// SPDX-License-Identifier: MIT
//
// A tree gone through by hand: the program asks, a person answers.
#pragma once

#include <iosfwd>

#include "cli/simulate.hpp"

namespace btcheck {

// Whether what is read is written as well. A terminal shows what is typed; in
// a pipe nothing would.
enum class Echo : unsigned char { No, Yes };

// Reads a line for each question until `q` or the end of the input. `?` tells
// what may be typed. Files are written when somebody asks for it.
void step_through(const SimulatedTree& simulated, std::istream& in,
                  std::ostream& out, Echo echo);

}  // namespace btcheck
