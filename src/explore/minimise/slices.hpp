// SPDX-License-Identifier: MIT
//
// The arcs of all blocks, sorted: a slice has those that lead from one block
// with one label to one constellation. Within a slice the arcs of bottom states
// stand first, so that a state which becomes one is looked at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "explore/minimise/arcs.hpp"

namespace btcheck {

// What is still to be asked of a slice (refinement.cpp).
enum Question : std::uint8_t {
  kHasSmall = 1,    // who reaches it, its arcs being few
  kHasLarge = 2,    // who reaches the one beside it
  kHasBottoms = 4,  // whether all bottom states of its block, all new, have it
};

struct Slice {
  std::uint32_t begin = 0;    // places
  std::uint32_t bottoms = 0;  // behind the arcs of bottom states
  std::uint32_t end = 0;
  std::uint32_t block = kNoNumber;
  std::uint32_t target = kNoNumber;                      // constellation
  std::uint32_t previous = kNoNumber, next = kNoNumber;  // of its block
  // That with the same block and label and the rest of the constellation that
  // was divided last.
  std::uint32_t beside = kNoNumber;
  std::uint32_t part = kNoNumber;  // while arcs are taken out: where they go
  bool is_silent = false;
  std::uint8_t questions = 0;
};

class Slices {
 public:
  // One for each label, from block 0 to constellation 0.
  Slices(const Arcs& arcs, const std::vector<std::uint32_t>& inert);

  Slice& operator[](std::uint32_t slice) { return slices_[slice]; }
  // kNoNumber: nobody asks any more.
  std::uint32_t of(std::uint32_t arc) const { return slice_of_[arc]; }
  std::uint32_t first_of(std::uint32_t block) const {
    return block < first_.size() ? first_[block] : kNoNumber;
  }
  std::span<const std::uint32_t> arcs(std::uint32_t slice) const {
    const Slice& which = slices_[slice];
    return {order_.data() + which.begin, order_.data() + which.end};
  }
  std::span<const std::uint32_t> arcs_of_bottoms(std::uint32_t slice) const {
    const Slice& which = slices_[slice];
    return {order_.data() + which.begin, order_.data() + which.bottoms};
  }

  // Takes an arc out of its slice, for a part of its own.
  void take_out(std::uint32_t arc, bool is_of_bottom);
  // The parts as slices: of a block that is new, or to a constellation that is.
  // Those that have lost all arcs are gone. Returns the parts, until the next
  // call.
  const std::vector<std::uint32_t>& divide_for_block(std::uint32_t block);
  const std::vector<std::uint32_t>& divide_for_target(std::uint32_t target);

  void source_becomes_bottom(std::uint32_t arc);
  // Nobody asks for the slices of this block any more.
  void drop(std::uint32_t block);

 private:
  std::uint32_t made();
  void swap_places(std::uint32_t one, std::uint32_t other);
  void link(std::uint32_t slice, std::uint32_t block);
  void remove(std::uint32_t slice);
  void close(std::uint32_t whole);
  void remove_empty();

  std::vector<std::uint32_t> order_;     // by place: arc
  std::vector<std::uint32_t> place_;     // by arc
  std::vector<std::uint32_t> slice_of_;  // by arc
  std::vector<Slice> slices_;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> first_;    // by block
  std::vector<std::uint32_t> divided_;  // slices that have parts
  std::vector<std::uint32_t> parts_;
};

}  // namespace btcheck
