// SPDX-License-Identifier: MIT
//
// What a node does, in a sentence: for an editor that shows it beside the node.
#pragma once

#include <string>

#include "model/tree/tree.hpp"

namespace btcheck {

// By the type as it is registered, "SetBlackboard", else by what it is lowered
// as; of a leaf that somebody has programmed, what is known of its answers.
std::string type_text(const Node& node, Profile profile);

}  // namespace btcheck
