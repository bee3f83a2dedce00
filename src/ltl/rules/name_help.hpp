// SPDX-License-Identifier: MIT
//
// Help for rules from who knows the names of the tree.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "ltl/rules/property.hpp"

namespace btcheck {

// What can be said of a name, as help: "write `land.ticked`"; "" for nothing.
using NameHelp = std::function<std::string(std::string_view name)>;

// `read_properties`; of a name with nothing about it `help` is asked.
Result<PropertyFile> read_properties(std::string_view file_name,
                                     std::string_view text,
                                     const NameHelp& help);

}  // namespace btcheck
