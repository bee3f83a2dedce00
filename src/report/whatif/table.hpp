// SPDX-License-Identifier: MIT
//
// What breaks, as a table for people.
#pragma once

#include <cstddef>
#include <string>

#include "check/whatif/whatif.hpp"
#include "model/tree/tree.hpp"
#include "report/whatif/words.hpp"
#include "text/utf8.hpp"

namespace btcheck {

struct TableChoices {
  bool tells_all = false;  // else what is survived in a line for each leaf
  std::size_t width = kLineWidth;
};
std::string what_if_text(const BehaviorTree& tree, const WhatIf& result,
                         const TableChoices& choices);

}  // namespace btcheck
