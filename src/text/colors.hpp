// SPDX-License-Identifier: MIT
//
// Colours for what people read on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace btcheck {

// The text with ANSI colours, and no character changed otherwise: verdicts and
// the headings of diagnostics, the frames of quoted lines, the lines of a
// repair, and what is said of a state of a run.
std::string colored(std::string_view text);

}  // namespace btcheck
