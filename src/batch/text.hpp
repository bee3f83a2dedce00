// SPDX-License-Identifier: MIT
//
// A batch as the text a person reads: a line for each entry, then what is not
// as expected.
#pragma once

#include <string>

#include "report/formats/reported.hpp"

namespace btcheck {

// The table in pieces, since it is printed as it grows: its heading, the line
// of an entry, and what comes after the last one.
std::string batch_heading();
std::string batch_line(const ReportedTree& tree);
std::string batch_ending(const Report& report);

// All of it.
std::string batch_text(const Report& report);

}  // namespace btcheck
