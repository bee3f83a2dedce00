// SPDX-License-Identifier: MIT
//
// When two names of entries are likely to be meant as one.
#pragma once

#include <string>
#include <string_view>

namespace btcheck::btcpp {

// A name without its capitals and underscores.
std::string folded_name(std::string_view name);

// Whether one letter too many, too few or other than in the other name, or two
// in the wrong order, is all that is between them. Digits and a plural tell
// names apart on purpose; of names below five letters nothing is said.
bool is_one_slip(std::string_view left, std::string_view right);

}  // namespace btcheck::btcpp
