// SPDX-License-Identifier: MIT
//
// The tree as it stands above an exported model.
#pragma once

#include <string>
#include <string_view>

#include "model/tree/tree.hpp"

namespace btcheck {

// Within a comment of C, or one that ends with its line; on one line.
std::string comment_text(std::string_view text);

// One line for each node, indented by its depth: where it was written, its
// type and its unique name. Each begins with `margin`.
std::string tree_lines(const BehaviorTree& tree, std::string_view margin);

}  // namespace btcheck
