// SPDX-License-Identifier: MIT
//
// Who reads a variable.
#pragma once

#include <algorithm>
#include <cstdint>

#include "model/tree/expression.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// A state variable of a tree, or a variable of its network: whichever the
// expression is about.
template <class Id>
bool reads(const Expression& expression, Id variable) {
  return std::ranges::any_of(expression.terms(), [&](const Term& term) {
    return term.operation == Operation::Variable &&
           static_cast<std::uint32_t>(term.operand) == index(variable);
  });
}

}  // namespace btcheck
