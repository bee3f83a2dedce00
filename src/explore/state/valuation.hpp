// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace btcheck {

// One global state, unpacked.
struct Valuation {
  std::vector<int> variables;  // by VariableId
  std::vector<int> clocks;     // by AutomatonId; 0 where none runs

  friend bool operator==(const Valuation&, const Valuation&) = default;
};

}  // namespace btcheck
