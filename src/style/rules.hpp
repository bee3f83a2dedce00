// SPDX-License-Identifier: MIT
//
// The style of files of rules.
#pragma once

#include <string>
#include <vector>

#include "style/lines.hpp"
#include "text/diagnostic.hpp"

namespace btcheck::style {

// Of rules that can be read.
std::string styled_rules(const SourceText& source);

// What the rules mean: words, whether each begins a line, titles and comments.
std::vector<std::string> words_of_rules(const SourceText& source);

}  // namespace btcheck::style
