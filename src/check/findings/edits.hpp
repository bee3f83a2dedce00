// SPDX-License-Identifier: MIT
//
// Edits that more than one kind of findings proposes.
#pragma once

#include <string>
#include <string_view>

#include "check/findings/facts.hpp"
#include "text/repair.hpp"

namespace btcheck {

// The script that is true where this one is not: `!x`, `!(x == 1)`, `x`.
std::string negated_script(std::string_view script);

// A Parallel that needs so many successes.
Repair asking_for(const TreeFacts& facts, NodeId parallel, int successes);

// Of a script of the node that asks for a text nothing writes, where one that
// is written is near: the one put for the other, where it is written first.
// `when` is nothing for the node's own script.
std::vector<Repair> spelt_alike(const TreeFacts& facts, NodeId node,
                                std::optional<ScriptTime> when);

}  // namespace btcheck
