// SPDX-License-Identifier: MIT
//
// The stack of open components, and the way back from product to system.
#include "ltl/accepting_cycle.hpp"

namespace btcheck {

void OpenComponents::open(std::uint32_t number, AcceptanceSet incoming) {
  assert(stack_.empty() || stack_.back().root < number);
  stack_.push_back({number, numbers_.number(incoming), numbers_.number(0)});
}

AcceptanceSet OpenComponents::merge(std::uint32_t number,
                                    AcceptanceSet closing) {
  while (stack_.back().root > number) {
    closing |= numbers_[stack_.back().incoming];
    closing |= numbers_[stack_.back().inside];
    stack_.pop_back();
    assert(!stack_.empty());
  }
  closing |= numbers_[stack_.back().inside];
  stack_.back().inside = numbers_.number(closing);
  return closing;
}

void OpenComponents::close() { stack_.pop_back(); }

void drop_last_word(Lasso& lasso) {
  for (RunState& moment : lasso.prefix) moment.state.pop_back();
  for (RunState& moment : lasso.cycle) moment.state.pop_back();
}

}  // namespace btcheck
