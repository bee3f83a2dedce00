// SPDX-License-Identifier: MIT
//
// What BehaviorTree.CPP allows as a name (src/basic_types.cpp).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "model/btcpp/document.hpp"

namespace btcheck::btcpp {

// One of the attributes that are no port: ID, name, `_autoremap`, conditions.
bool is_reserved_attribute(std::string_view name);

// Whether an attribute of this name is a port; others are kept and mean
// nothing to the engine.
bool is_port_name(std::string_view name);

// Why this cannot be the ID of a tree or node type, "a blank", or nothing.
std::optional<std::string> flaw_of_type_name(std::string_view name);

// The same for a port, and for the name of an instance.
std::optional<std::string> flaw_of_port_name(std::string_view name);
std::optional<std::string> flaw_of_instance_name(std::string_view name);

// The key in "{key}", blanks around the braces allowed, and in the "${key}" of
// version 3; nothing for a literal.
std::optional<std::string_view> blackboard_key(BtcppRelease release,
                                               std::string_view value);

// The key that a port's value points at, "{=}" and "=" being the port's name.
std::optional<std::string_view> remapped_key(BtcppRelease release,
                                             std::string_view port,
                                             std::string_view value);

}  // namespace btcheck::btcpp
