// SPDX-License-Identifier: MIT
//
// Expressions of .btf files: prefix notation with types, to postfix terms.
#pragma once

#include <optional>

#include "model/btf/keywords.hpp"
#include "model/btf/operand.hpp"
#include "model/tree/expression.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf {

// True for a list that begins with `:=`.
bool is_assignment(const Reading& reading, FormId form);

// A truth-valued expression; nothing after an error.
std::optional<Expression> read_condition(const Scope& scope, FormId form);

// `(:= variable value)`; nothing after an error.
std::optional<StateAssignment> read_assignment(const Scope& scope, FormId form);

}  // namespace btcheck::btf
