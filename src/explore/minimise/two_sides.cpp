// SPDX-License-Identifier: MIT
//
// Those who can: whoever has an inert step to one of them is one. Those who
// cannot: whoever has inert steps to such states only, and no arc in the slice
// itself. That is looked up among all its arcs: when it has one, all its inert
// steps are none any more after the split, and it becomes a bottom state.
#include "explore/minimise/two_sides.hpp"

#include <utility>

#include "text/budget.hpp"

namespace btcheck {

TwoSides::TwoSides(const Arcs& arcs, const Slices& slices,
                   const std::vector<std::uint32_t>& block_of,
                   const std::vector<std::uint32_t>& inert)
    : arcs_(arcs),
      slices_(slices),
      block_of_(block_of),
      inert_(inert),
      side_(arcs.states, kUntouched) {}

void TwoSides::forget() {
  for (const std::uint32_t state : able_) side_[state] = kUntouched;
  for (const std::uint32_t state : touched_) side_[state] = kUntouched;
  able_.clear();
  unable_.clear();
  touched_.clear();
}

std::uint32_t TwoSides::next_arc(Arrivals& at) const {
  if (at.next == at.end) return kNoNumber;
  const std::uint32_t arc = arcs_.incoming[at.next++];
  if (arcs_.is_silent[arc]) return arc;
  at.next = at.end;  // silent ones come first
  return kNoNumber;
}

bool TwoSides::search_able() {
  if (const std::uint32_t arc = next_arc(at_able_); arc != kNoNumber) {
    const std::uint32_t state = arcs_.source[arc];
    if (block_of_[state] == block_ && side_[state] != kCan) find(state);
  } else if (next_able_ < able_.size()) {
    at_able_ = arrivals(able_[next_able_++]);
  } else if (next_start_ < starts_.size()) {
    can(arcs_.source[starts_[next_start_++]]);
  } else {
    return true;
  }
  return false;
}

// One of the arcs of the state that is asked.
void TwoSides::look_at_own_arcs() {
  if (slice_ == kNoNumber || next_own_ == arcs_.first_out[asked_ + 1]) {
    if (side_[asked_] != kCan) unable_.push_back(asked_);
    asked_ = kNoNumber;
  } else if (slices_.of(next_own_++) == slice_) {
    asked_ = kNoNumber;
  }
}

bool TwoSides::search_unable() {
  if (asked_ != kNoNumber) {
    look_at_own_arcs();
  } else if (const std::uint32_t arc = next_arc(at_unable_); arc != kNoNumber) {
    const std::uint32_t state = arcs_.source[arc];
    std::uint32_t& side = side_[state];
    if (block_of_[state] != block_ || side == kCan) return false;
    if (side == kUntouched) {
      side = inert_[state];
      touched_.push_back(state);
    }
    if (--side == 0) {
      side = kAllCannot;
      asked_ = state;
      next_own_ = arcs_.first_out[state];
    }
  } else if (next_unable_ < cannot_.size() + unable_.size()) {
    const std::size_t i = next_unable_++;
    at_unable_ =
        arrivals(i < cannot_.size() ? cannot_[i] : unable_[i - cannot_.size()]);
  } else {
    return true;
  }
  return false;
}

TwoSides::Smaller TwoSides::search(std::uint32_t block, std::uint32_t size,
                                   std::span<const std::uint32_t> cannot,
                                   std::uint32_t slice) {
  block_ = block;
  slice_ = slice;
  starts_ = {};
  if (slice != kNoNumber) starts_ = slices_.arcs(slice);
  cannot_ = cannot;
  next_start_ = next_able_ = next_unable_ = 0;
  at_able_ = at_unable_ = Arrivals();
  asked_ = kNoNumber;
  const std::size_t half = size / 2;
  Smaller found;
  for (;;) {
    ask_budget();
    if (able_.size() <= half && search_able()) {
      found.can = true;
      found.states = able_;
      break;
    }
    if (cannot_.size() + unable_.size() <= half && search_unable()) {
      found.states.assign(cannot_.begin(), cannot_.end());
      found.states.insert(found.states.end(), unable_.begin(), unable_.end());
      break;
    }
  }
  forget();
  return found;
}

}  // namespace btcheck
