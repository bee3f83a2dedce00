// SPDX-License-Identifier: MIT
//
// Long conditions and lists, broken into lines.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

namespace btcheck {

// The text broken after any of these joints, each of which ends with a blank
// that is then left out, where a line of 78 characters is full. `line_end`
// stands at the end of each line but the last; each but the first begins with
// `indent` blanks.
std::string filled(std::string_view text, std::size_t indent,
                   std::string_view line_end,
                   std::initializer_list<std::string_view> joints);

// Puts `more` behind `text`, the joint between them if neither is empty.
void append(std::string& text, std::string_view joint, std::string_view more);

}  // namespace btcheck
