// SPDX-License-Identifier: MIT
//
// Rules may name a node by its line, `land@23` or `ReactiveSequence17`: these
// have to follow where formatting moves lines.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "text/diagnostic.hpp"
#include "text/input_file.hpp"

namespace btcheck {

// The lines of a tree where nodes stood, and where they stand now, as far as
// that is another one. The text is what `styled` makes of the file.
std::map<int, int> moved_lines(const InputFile& tree, const std::string& text);

// BT0014 for each name in rules that is made with such a line.
std::vector<Diagnostic> stale_names(const InputFile& rules,
                                    const std::string& tree,
                                    const std::map<int, int>& moved);

}  // namespace btcheck
