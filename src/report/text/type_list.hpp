// SPDX-License-Identifier: MIT
//
// The node types of a profile, a line each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/known_types.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// Those whose names have `part` in them, whatever its case; "" for all. In the
// order of their names.
//
//     Inverter: Decorator. Swaps success and failure of its child.
//     Sleep: Action (msec: unsigned int). Runs for so long, then succeeds.
std::vector<std::string> type_lines(Profile profile, std::string_view part);

// What nodes of a type do, in a sentence.
std::string about_type(const btcpp::NodeTypeRow& row, Profile profile);

}  // namespace btcheck
