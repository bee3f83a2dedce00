// SPDX-License-Identifier: MIT
//
// What is said of a name in a rule that is not understood. Whatever is named is
// one that the tree has, written as a rule takes it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/bind/node_names.hpp"
#include "ltl/rules/property.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// The name as it stands in rules: `land@23`, `"Dock the robot"@23`.
std::string name_in_rules(const BehaviorTree& tree, NodeId node);
// The first few, "`land@23`, `land@31`, …".
std::string names_in_rules(const BehaviorTree& tree,
                           const std::vector<NodeId>& nodes);

// "did you mean `land`? there are 3: …", or "" when nothing is near. `name` is
// without a line.
std::string nearest_help_in(const BehaviorTree& tree, const NodeNames& names,
                            std::string_view name);
// The same where only a node is wanted, or only a variable; of a name of the
// other kind, what can be asked of that.
std::string node_help(const BehaviorTree& tree, const NodeNames& names,
                      std::string_view reference);
std::string variable_help(const BehaviorTree& tree, const NodeNames& names,
                          std::string_view name);
// What can be asked of the name: "write `land.ticked`, `land.success`",
// "compare it: `battery == Low`".
std::string condition_help(const BehaviorTree& tree, const NodeNames& names,
                           std::string_view name);

// `read_properties` for who has the tree.
Result<PropertyFile> read_rules(std::string_view file_name,
                                const FileText& text, const BehaviorTree& tree);

}  // namespace btcheck
