// SPDX-License-Identifier: MIT
//
// Opening, merging and closing of components.
#include "ltl/product/open_components.hpp"

#include <cassert>

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

}  // namespace btcheck
