// SPDX-License-Identifier: MIT
//
// Who reads a state variable.
#pragma once

#include <algorithm>
#include <cstdint>

#include "model/tree/expression.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

inline bool reads(const Expression& expression, StateVariableId variable) {
  return std::ranges::any_of(expression.terms(), [&](const Term& term) {
    return term.operation == Operation::Variable &&
           static_cast<std::uint32_t>(term.operand) == index(variable);
  });
}

}  // namespace btcheck
