// SPDX-License-Identifier: MIT
//
// Values of ports, read as BehaviorTree.CPP reads them (convertFromString in
// src/basic_types.cpp): numbers may be followed by anything.
#pragma once

#include <optional>
#include <string_view>

#include "model/btcpp/node_types.hpp"

namespace btcheck::btcpp {

std::optional<bool> parse_bool(std::string_view text);
std::optional<long long> parse_integer(std::string_view text);
// This one followed by nothing.
std::optional<double> parse_number(std::string_view text);

// Whether the engine accepts this as a value of the type when it loads a file.
// Scripts are looked at elsewhere: any text is accepted.
bool is_literal_of(PortType type, std::string_view text);

}  // namespace btcheck::btcpp
