// SPDX-License-Identifier: MIT
//
// What can be said for certain of one guard, assignment or edge.
#pragma once

#include <optional>

#include "model/automata/network.hpp"

namespace btcheck {

// The value that an assignment gives, if it is a constant.
std::optional<int> constant_value(const Assignment& assignment);

// The value that a guard demands of a variable, if it demands one.
std::optional<int> demanded_value(const Expression& guard, VariableId variable);

// Whether a guard rules this value of a variable out.
bool excludes(const Expression& guard, VariableId variable, int value);

// Whether time must pass between coming to the edge's source and taking it.
bool takes_time(const Network& network, const Edge& edge);

}  // namespace btcheck
