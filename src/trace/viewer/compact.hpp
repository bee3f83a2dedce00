// SPDX-License-Identifier: MIT
//
// The viewer's sources are written for people, and its pages sent around.
#pragma once

#include <string>
#include <string_view>

namespace btcheck {

// The same script without comments and the space that it does not need. For
// the scripts of this folder: a regular expression is taken for one only where
// an operand can stand, after an operator or an opening bracket.
std::string compact_script(std::string_view script);

// The same style sheet without comments and the space that it does not need.
std::string compact_style(std::string_view style);

// The same page without its lines' indentation.
std::string compact_page(std::string_view page);

}  // namespace btcheck
