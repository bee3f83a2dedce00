// SPDX-License-Identifier: MIT
//
// Partition refinement that processes the smaller half, after Jansen, Groote,
// Keiren and Wijs (TACAS 2020) and, with constellations of states rather than
// bunches of transitions, Groote and Jansen (CONCUR 2025). Without silent steps
// it is that of Paige and Tarjan (1987) with labels.
//
// Blocks lie in constellations. An inert step is a silent one within a block; a
// bottom state has none. What holds between two rounds: when a state of a block
// has an arc in a slice - a label and a constellation - that is not silent and
// in the block's own constellation, then all bottom states of the block have
// one, and so every state comes to one inertly. When each constellation is one
// block, the partition is a bisimulation. A round makes the smaller block of
// some constellation one of its own, and asks of each slice that is thereby
// divided who reaches the small part of it and who the rest.
//
// Where we differ: a block is split in two, by one question at a time, rather
// than in four at once. When a split makes bottom states, those that come to a
// step across the split are split off as well: all bottom states of theirs are
// new, and all slices are asked anew for them, which is paid by their arcs, as
// a state becomes one once. A block of one state is asked nothing any more and
// has no slices: most of a graph that can hardly be reduced.
#include "explore/minimise/refinement.hpp"

#include <cassert>
#include <utility>

#include "explore/minimise/slices.hpp"
#include "explore/minimise/two_sides.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

using Number = std::uint32_t;

// How many arcs of one state lead with one label to one constellation. With
// kNoneBeside, none leads to the rest of the constellation divided last.
constexpr Number kNoneBeside = 0x80000000;

struct Block {
  Number begin = 0;    // places
  Number bottoms = 0;  // behind its bottom states, which stand first
  Number end = 0;
  Number constellation = 0;

  Number size() const { return end - begin; }
  Number bottom_count() const { return bottoms - begin; }
};

struct Constellation {
  Number begin = 0;
  Number end = 0;
  bool waits = false;  // in the list of those that may have several blocks
};

std::vector<Number> inert_steps(const Arcs& arcs) {
  std::vector<Number> count(arcs.states, 0);
  for (Number arc = 0; arc < arcs.size(); ++arc) {
    count[arcs.source[arc]] += arcs.is_silent[arc];
  }
  return count;
}

class Refinement {
 public:
  explicit Refinement(Arcs arcs)
      : arcs_(std::move(arcs)),
        inert_(inert_steps(arcs_)),
        slices_(arcs_, inert_),
        block_of_(arcs_.states, 0),
        sides_(arcs_, slices_, block_of_, inert_) {
    count_arcs();
    arcs_.label = {};
    order_states();
  }

  std::vector<Number> run() {
    ask_anew(0);
    answer();
    while (!waiting_.empty()) {
      const Number which = waiting_.back();
      const Number first = block_of_[states_[constellations_[which].begin]];
      const Number last = block_of_[states_[constellations_[which].end - 1]];
      if (first == last) {
        constellations_[which].waits = false;
        waiting_.pop_back();
      } else {
        make_constellation(
            blocks_[first].size() <= blocks_[last].size() ? first : last);
        answer();
      }
    }
    return std::move(block_of_);
  }

 private:
  void count_arcs() {
    count_of_.resize(arcs_.size());
    arc_count_.assign(arcs_.size(), 0);
    std::vector<Number> seen(arcs_.labels, kNoNumber);  // count by label
    for (Number s = 0; s < arcs_.states; ++s) {
      ask_budget();
      const Number begin = arcs_.first_out[s];
      const Number end = arcs_.first_out[s + 1];
      for (Number arc = begin; arc < end; ++arc) {
        Number& count = seen[arcs_.label[arc]];
        if (count == kNoNumber) count = counts_++;
        count_of_[arc] = count;
        ++arc_count_[count];
      }
      for (Number arc = begin; arc < end; ++arc) {
        seen[arcs_.label[arc]] = kNoNumber;
      }
    }
  }

  void order_states() {
    states_.resize(arcs_.states);
    place_.resize(arcs_.states);
    Number next = 0;
    for (const bool is_bottom : {true, false}) {
      for (Number s = 0; s < arcs_.states; ++s) {
        if ((inert_[s] == 0) != is_bottom) continue;
        place_[s] = next;
        states_[next++] = s;
      }
      if (is_bottom) blocks_.push_back({0, next, arcs_.states, 0});
    }
    constellations_.push_back({0, arcs_.states, false});
  }

  void swap_places(Number one, Number other) {
    std::swap(states_[one], states_[other]);
    place_[states_[one]] = one;
    place_[states_[other]] = other;
  }

  bool is_bottom(Number state) const { return inert_[state] == 0; }

  // In its own constellation a silent slice says nothing.
  bool says_something(const Slice& slice) const {
    return !slice.is_silent ||
           slice.target != blocks_[slice.block].constellation;
  }

  void ask(Number slice, std::uint8_t questions) {
    if (slices_[slice].questions == 0) asked_.push_back(slice);
    slices_[slice].questions |= questions;
  }

  // All bottom states of the block are new: all slices are asked for them.
  void ask_anew(Number block) {
    for (Number slice = slices_.first_of(block); slice != kNoNumber;
         slice = slices_[slice].next) {
      ask_budget();
      if (slices_[slice].questions == 0) asked_.push_back(slice);
      slices_[slice].questions = kHasBottoms;
    }
  }

  void answer() {
    while (!asked_.empty()) {
      ask_budget();
      const Number slice = asked_.back();
      std::uint8_t& questions = slices_[slice].questions;
      if (questions == 0) {
        asked_.pop_back();
      } else if ((questions & kHasBottoms) != 0) {
        questions &= static_cast<std::uint8_t>(~kHasBottoms);
        answer_for_bottoms(slice);
      } else if ((questions & kHasLarge) != 0) {
        questions &= static_cast<std::uint8_t>(~kHasLarge);
        answer_for_large(slice);
      } else {
        questions = 0;
        answer_for_small(slice);
      }
    }
  }

  // Brings a bottom state among the first ones of its block, unless it is.
  void bring_to_front(Number state, Number& end_of_front) {
    if (place_[state] >= end_of_front) {
      swap_places(place_[state], end_of_front++);
    }
  }

  void answer_for_bottoms(Number slice) {
    if (!says_something(slices_[slice])) return;
    const Number block = slices_[slice].block;
    Number front = blocks_[block].begin;
    for (const Number arc : slices_.arcs_of_bottoms(slice)) {
      ask_budget();
      bring_to_front(arcs_.source[arc], front);
    }
    split(block, front, blocks_[block].bottoms, slice);
  }

  void answer_for_small(Number slice) {
    if (!says_something(slices_[slice])) return;
    const Number block = slices_[slice].block;
    Number front = blocks_[block].begin;
    for (const Number arc : slices_.arcs(slice)) {
      ask_budget();
      const Number state = arcs_.source[arc];
      if (is_bottom(state)) bring_to_front(state, front);
      sides_.can(state);
    }
    split(block, front, blocks_[block].bottoms, kNoNumber);
  }

  // `slice` is the small part, of which the arcs may be looked at.
  void answer_for_large(Number slice) {
    const Number large = slices_[slice].beside;
    if (large == kNoNumber || !says_something(slices_[large])) return;
    const Number block = slices_[slice].block;
    Number front = blocks_[block].begin;
    for (const Number arc : slices_.arcs_of_bottoms(slice)) {
      ask_budget();
      if ((arc_count_[count_of_[arc]] & kNoneBeside) == 0) continue;
      bring_to_front(arcs_.source[arc], front);
    }
    split(block, blocks_[block].begin, front, large);
  }

  // Splits a block into those that come to an arc of the slice, or to a marked
  // state, and those that do not: of its bottom states those at the places from
  // `begin` to `end`. Then also what new bottom states ask for.
  void split(Number block, Number begin, Number end, Number slice) {
    if (begin == end) {
      sides_.forget();
      return;
    }
    const Number able = divided(block, begin, end, slice);
    const Number old_bottoms = blocks_[able].bottoms;
    if (!mark_crossing(able)) {
      sides_.forget();
      return;
    }
    Number renewed = able;
    if (old_bottoms == blocks_[able].begin) {
      sides_.forget();
    } else {
      renewed = divided(able, blocks_[able].begin, old_bottoms, kNoNumber);
      mark_crossing(renewed);
      sides_.forget();
    }
    ask_anew(renewed);
  }

  // Returns the block of those who can; crossing_ are its arcs into the other.
  Number divided(Number block, Number begin, Number end, Number slice) {
    const TwoSides::Smaller smaller =
        sides_.search(block, blocks_[block].size(),
                      {states_.data() + begin, states_.data() + end}, slice);
    assert(!smaller.states.empty());
    const Number part = separate(block, smaller.states);
    find_crossing(smaller, block);
    for (const Number each : {block, part}) {
      if (blocks_[each].size() == 1) slices_.drop(each);
    }
    return smaller.can ? part : block;
  }

  // Makes some states of a block one of their own.
  Number separate(Number block, const std::vector<Number>& states) {
    const Number part = static_cast<Number>(blocks_.size());
    blocks_.push_back(blocks_[block]);
    Block& rest = blocks_[block];
    Number bottoms = rest.begin;
    Number others = rest.bottoms;
    for (const Number state : states) {
      ask_budget();
      swap_places(place_[state], is_bottom(state) ? bottoms++ : others++);
      block_of_[state] = part;
    }
    const Number left = rest.bottoms - bottoms;
    exchange(bottoms, rest.bottoms, others,
             [&](Number one, Number other) { swap_places(one, other); });
    blocks_[part].bottoms = bottoms;
    blocks_[part].end = rest.begin = others - left;
    rest.bottoms = rest.begin + left;
    divide_slices(part, states);
    Constellation& around = constellations_[rest.constellation];
    if (!std::exchange(around.waits, true)) {
      waiting_.push_back(rest.constellation);
    }
    return part;
  }

  void divide_slices(Number part, const std::vector<Number>& states) {
    for (const Number state : states) {
      for (Number arc = arcs_.first_out[state];
           arc < arcs_.first_out[state + 1]; ++arc) {
        ask_budget();
        slices_.take_out(arc, is_bottom(state));
      }
    }
    for (const Number slice : slices_.divide_for_block(part)) {
      if (slices_[slice].questions != 0) asked_.push_back(slice);
    }
  }

  // Silent arcs from those who can to those who cannot: inert until now. The
  // other way there are none.
  void find_crossing(const TwoSides::Smaller& smaller, Number block) {
    crossing_.clear();
    for (const Number state : smaller.states) {
      if (smaller.can) {
        for (Number arc = arcs_.first_out[state];
             arc < arcs_.first_out[state + 1]; ++arc) {
          ask_budget();
          if (arcs_.is_silent[arc] && block_of_[arcs_.target[arc]] == block) {
            crossing_.push_back(arc);
          }
        }
      } else {
        for (Number i = arcs_.first_in[state]; i < arcs_.first_in[state + 1];
             ++i) {
          ask_budget();
          const Number arc = arcs_.incoming[i];
          if (!arcs_.is_silent[arc]) break;  // silent ones come first
          if (block_of_[arcs_.source[arc]] == block) crossing_.push_back(arc);
        }
      }
    }
  }

  // Marks the states that have crossing arcs. Returns whether some of them are
  // bottom states now.
  bool mark_crossing(Number able) {
    for (const Number arc : crossing_) {
      --inert_[arcs_.source[arc]];
    }
    bool has_new = false;
    for (const Number arc : crossing_) {
      ask_budget();
      const Number state = arcs_.source[arc];
      if (sides_.is_marked(state)) continue;
      sides_.can(state);
      if (!is_bottom(state)) continue;
      has_new = true;
      swap_places(place_[state], blocks_[able].bottoms++);
      for (Number out = arcs_.first_out[state];
           out < arcs_.first_out[state + 1]; ++out) {
        slices_.source_becomes_bottom(out);
      }
    }
    return has_new;
  }

  // The block, at either end of a constellation, becomes one itself.
  void make_constellation(Number block) {
    const Number whole = blocks_[block].constellation;
    const Number made = static_cast<Number>(constellations_.size());
    constellations_.push_back(
        {blocks_[block].begin, blocks_[block].end, false});
    if (constellations_[whole].begin == blocks_[block].begin) {
      constellations_[whole].begin = blocks_[block].end;
    } else {
      constellations_[whole].end = blocks_[block].begin;
    }
    blocks_[block].constellation = made;
    take_out_arcs_to(block);
    const std::vector<Number>& parts = slices_.divide_for_target(made);
    for (const Number part : parts) count_again(part);
    for (const Number part : parts) {
      const Slice& slice = slices_[part];
      const bool was_within =
          slice.is_silent && blocks_[slice.block].constellation == whole;
      if (says_something(slice)) {
        ask(part, was_within ? kHasSmall : kHasSmall | kHasLarge);
      }
    }
    for (Number slice = slices_.first_of(block); slice != kNoNumber;
         slice = slices_[slice].next) {
      if (slices_[slice].is_silent && slices_[slice].target == whole) {
        ask(slice, kHasSmall);  // within the constellation until now
      }
    }
  }

  void take_out_arcs_to(Number block) {
    for (Number i = blocks_[block].begin; i < blocks_[block].end; ++i) {
      const Number state = states_[i];
      for (Number j = arcs_.first_in[state]; j < arcs_.first_in[state + 1];
           ++j) {
        ask_budget();
        const Number arc = arcs_.incoming[j];
        if (slices_.of(arc) == kNoNumber) continue;
        --arc_count_[count_of_[arc]];
        slices_.take_out(arc, is_bottom(arcs_.source[arc]));
      }
    }
  }

  // Counts the arcs of a slice that has been made. A count that has come down
  // to 0 is that of the new arcs, and there are none beside them.
  void count_again(Number slice) {
    for (const Number arc : slices_.arcs(slice)) {
      ask_budget();
      const Number state = arcs_.source[arc];
      Number& count = fresh_count(state);
      if (count == kNoNumber) {
        const Number old = count_of_[arc];
        if ((arc_count_[old] & ~kNoneBeside) == 0) {
          count = old;
          arc_count_[old] = kNoneBeside;
        } else {
          count = counts_++;
          arc_count_[count] = 0;
        }
      }
      count_of_[arc] = count;
      ++arc_count_[count];
    }
    for (const Number arc : slices_.arcs(slice)) {
      fresh_count(arcs_.source[arc]) = kNoNumber;
    }
  }

  Number& fresh_count(Number state) {
    if (fresh_.empty()) fresh_.assign(arcs_.states, kNoNumber);
    return fresh_[state];
  }

  Arcs arcs_;
  std::vector<Number> inert_;  // by state: how many inert steps it has
  Slices slices_;
  std::vector<Number> block_of_;  // by state
  TwoSides sides_;
  std::vector<Number> states_;  // by place
  std::vector<Number> place_;   // by state
  std::vector<Block> blocks_;
  std::vector<Constellation> constellations_;
  std::vector<Number> waiting_;    // constellations
  std::vector<Number> asked_;      // slices
  std::vector<Number> crossing_;   // arcs
  std::vector<Number> count_of_;   // by arc: a number of arc_count_
  std::vector<Number> arc_count_;  // by count
  std::vector<Number> fresh_;      // by state, while a slice is counted
  Number counts_ = 0;
};

}  // namespace

std::vector<std::uint32_t> refined(Arcs arcs) {
  if (arcs.states == 0) return {};
  return Refinement(std::move(arcs)).run();
}

}  // namespace btcheck
