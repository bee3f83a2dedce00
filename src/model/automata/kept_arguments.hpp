// SPDX-License-Identifier: MIT
//
// Arguments of nodes as variables of a network, where a rule asks for them.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// The location of a node whose arguments divide by zero.
inline constexpr std::string_view kNoArguments = "no_arguments";

// By node the numbers of arguments, all of them known.
using AskedArguments = std::map<NodeId, std::set<std::size_t>>;

// Adds a variable for each: its node evaluates the argument when it is ticked
// and does not run, and keeps the value until it is done. Networks of .btf
// trees only, once.
void keep_arguments(const BehaviorTree& tree, const AskedArguments& asked,
                    Network& network);

std::optional<VariableId> kept_argument(const Network& network, NodeId node,
                                        std::size_t number);

// The node has been given its arguments: it has been ticked and not answered
// yet, or it runs.
Expression has_arguments(const Network& network, NodeId node);

}  // namespace btcheck
