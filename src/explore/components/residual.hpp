// SPDX-License-Identifier: MIT
//
// What is left of an expression where some of its variables are known.
#pragma once

#include <functional>
#include <optional>

#include "model/automata/network.hpp"

namespace btcheck {

using KnownValue = std::function<std::optional<std::int64_t>(VariableId)>;

// The expression with the known values put in and everything computed that can
// be: with all known, a constant. It has the same value wherever the unknown
// ones are; as a guard, the same truth.
Expression residual(const Expression& expression, const KnownValue& known);

}  // namespace btcheck
