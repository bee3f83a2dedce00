// SPDX-License-Identifier: MIT
//
// Rules may name a node by its line, `land@23` or `ReactiveSequence17`: these
// have to follow where formatting moves lines.
#pragma once

#include <string>
#include <vector>

#include "text/diagnostic.hpp"
#include "text/input_file.hpp"

namespace btcheck {

struct MovedNode {
  std::string word;  // that it begins with: its type, as a rule
  int before = 0;    // its line
  int after = 0;
};

// All nodes of a tree, and what looks like one. The text is what `styled` makes
// of the file.
std::vector<MovedNode> moved_nodes(const InputFile& tree,
                                   const std::string& text);

// BT0014 for each name in rules that is made with a line that is another now.
std::vector<Diagnostic> stale_names(const InputFile& rules,
                                    const std::string& tree,
                                    const std::vector<MovedNode>& nodes);

}  // namespace btcheck
