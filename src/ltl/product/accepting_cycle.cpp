// SPDX-License-Identifier: MIT
//
// The way back from a run of the product to one of the system.
#include "ltl/product/accepting_cycle.hpp"

namespace btcheck {

void drop_last_word(Lasso& lasso) {
  for (RunState& moment : lasso.prefix) moment.state.pop_back();
  for (RunState& moment : lasso.cycle) moment.state.pop_back();
}

}  // namespace btcheck
