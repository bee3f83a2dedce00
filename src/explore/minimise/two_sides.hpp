// SPDX-License-Identifier: MIT
//
// Which states of a block come by inert steps to where something can be done,
// and which cannot: found by two searches that take turns.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "explore/minimise/arcs.hpp"
#include "explore/minimise/slices.hpp"

namespace btcheck {

// Both search backwards from what is known, and the first to be done with no
// more than half of the states ends the work of both, which is therefore
// proportional to the arcs of the smaller side, and of states that become
// bottom states.
class TwoSides {
 public:
  // `block_of` by state; `inert`: how many inert steps it has.
  TwoSides(const Arcs& arcs, const Slices& slices,
           const std::vector<std::uint32_t>& block_of,
           const std::vector<std::uint32_t>& inert);

  // A state that can do it itself, before the search.
  void can(std::uint32_t state) {
    if (side_[state] != kCan) find(state);
  }
  bool is_marked(std::uint32_t state) const { return side_[state] == kCan; }
  // Forgets them again.
  void forget();

  struct Smaller {
    std::vector<std::uint32_t> states;
    bool can = false;  // which side it is
  };
  // Of a block of `size` states. `cannot`: its bottom states that cannot; there
  // are some. With `slice`, those that have an arc in it can do it, and their
  // bottom states are in it; kNoNumber: those that were marked can, and no
  // others. Forgets all marks.
  Smaller search(std::uint32_t block, std::uint32_t size,
                 std::span<const std::uint32_t> cannot, std::uint32_t slice);

 private:
  // By state: untouched, or how many of its inert steps do not lead to where it
  // cannot be done, or one of these.
  static constexpr std::uint32_t kUntouched = 0;
  static constexpr std::uint32_t kCan = 0xffffffff;
  static constexpr std::uint32_t kAllCannot = 0xfffffffe;

  // Where a search is among the arcs of a state.
  struct Arrivals {
    std::uint32_t next = 0;
    std::uint32_t end = 0;
  };

  void find(std::uint32_t state) {
    side_[state] = kCan;
    able_.push_back(state);
  }
  // The next inert or other silent arc, or kNoNumber.
  std::uint32_t next_arc(Arrivals& at) const;
  Arrivals arrivals(std::uint32_t state) const {
    return {arcs_.first_in[state], arcs_.first_in[state + 1]};
  }
  // One turn of each search; true: it is done.
  bool search_able();
  bool search_unable();
  void look_at_own_arcs();

  const Arcs& arcs_;
  const Slices& slices_;
  const std::vector<std::uint32_t>& block_of_;
  const std::vector<std::uint32_t>& inert_;
  std::vector<std::uint32_t> side_;

  // Of one search.
  std::uint32_t block_ = 0;
  std::uint32_t slice_ = kNoNumber;
  std::span<const std::uint32_t> starts_;  // arcs of the slice
  std::span<const std::uint32_t> cannot_;  // bottom states
  std::vector<std::uint32_t> able_;        // states found
  std::vector<std::uint32_t> unable_;      // the same, without `cannot_`
  std::vector<std::uint32_t> touched_;
  std::size_t next_start_ = 0, next_able_ = 0, next_unable_ = 0;
  Arrivals at_able_, at_unable_;
  std::uint32_t asked_ = kNoNumber;  // a state whose own arcs are looked at
  std::uint32_t next_own_ = 0;
};

}  // namespace btcheck
