// SPDX-License-Identifier: MIT
//
// The text of attributes as BehaviorTree.CPP reads it (src/basic_types.cpp):
// which names it allows, which values are numbers, Booleans or literals of a
// port's type, and which point at a blackboard entry.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "model/btcpp/document.hpp"
#include "model/btcpp/known_types.hpp"

namespace btcheck::btcpp {

// One of kBtcppConditionNames.
bool is_condition_name(std::string_view name);

// One of the attributes that are no port: ID, name, `_autoremap`, conditions.
bool is_reserved_attribute(std::string_view name);

// Whether an attribute of this name is a port; others are kept and mean
// nothing to the engine.
bool is_port_name(std::string_view name);

// "did you mean `_while`?" for an attribute that is none of the engine's and
// nearly one, else "".
std::string meant_condition(BtcppRelease release, std::string_view name);

// Why this cannot be the ID of a tree or node type, "it is empty", or nothing.
std::optional<std::string> flaw_of_type_name(std::string_view name);

// The same for a port, and for the name of an instance.
std::optional<std::string> flaw_of_port_name(std::string_view name);
std::optional<std::string> flaw_of_instance_name(std::string_view name);

// The key in "{key}", blanks around the braces allowed, and in the "${key}" of
// older releases; nothing for a literal.
std::optional<std::string_view> blackboard_key(int engine,
                                               std::string_view value);

// The key that a port's value points at; "{=}" and "=" stand for the port's
// own name, in older releases "=" alone.
std::optional<std::string_view> remapped_key(int engine, std::string_view port,
                                             std::string_view value);

// convertFromString of the engine: a number may be followed by anything.
std::optional<bool> parse_bool(std::string_view text);
std::optional<long long> parse_integer(std::string_view text);

// What stands behind the number that the engine reads at the beginning of such
// a literal, blanks left out.
std::string_view text_after_number(std::string_view text, PortType type);

// Whether the engine accepts this as a value of the type when it loads a file.
// Any text passes for a script: its syntax is checked elsewhere.
bool is_literal_of(PortType type, std::string_view text);

}  // namespace btcheck::btcpp
