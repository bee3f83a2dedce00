// SPDX-License-Identifier: MIT
//
// Expressions of a network in Promela's syntax.
#pragma once

#include <string>

#include "model/automata/network.hpp"
#include "model/export/promela/names.hpp"

namespace btcheck {

struct PromelaExpression {
  std::string text;
  // The text has the value of the expression in every state. False when a part
  // may leave the 32 bits of an int, or the text becomes too long to be told.
  bool is_exact = true;
};
PromelaExpression promela_expression(const Network& network,
                                     const PromelaNames& names,
                                     const Expression& expression);

}  // namespace btcheck
