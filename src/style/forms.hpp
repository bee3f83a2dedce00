// SPDX-License-Identifier: MIT
//
// The style of .btf files and of leaf contracts, which are nested lists.
#pragma once

#include <string>
#include <vector>

#include "model/btf/forms.hpp"
#include "style/lines.hpp"

namespace btcheck::style {

// Of forms without an error.
std::string styled_forms(const btf::ParsedForms& parsed);

// What the words mean: their texts, and those of the comments, in their order.
std::vector<std::string> words_and_comments(const btf::ParsedForms& parsed);

}  // namespace btcheck::style
