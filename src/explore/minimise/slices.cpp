// SPDX-License-Identifier: MIT
//
// What is taken out of a slice goes to its front, twice: to the front of the
// arcs of bottom states, or of those of others. At the end the two fronts are
// brought together, which costs no more than there was taken.
#include "explore/minimise/slices.hpp"

#include <utility>

#include "text/budget.hpp"

namespace btcheck {

Slices::Slices(const Arcs& arcs, const std::vector<std::uint32_t>& inert)
    : order_(arcs.size()), place_(arcs.size()), slice_of_(arcs.size()) {
  std::vector<std::uint32_t> count(arcs.labels, 0);
  std::vector<std::uint32_t> of_bottoms(arcs.labels, 0);
  for (std::uint32_t arc = 0; arc < arcs.size(); ++arc) {
    ++count[arcs.label[arc]];
    of_bottoms[arcs.label[arc]] += inert[arcs.source[arc]] == 0;
  }
  first_.push_back(kNoNumber);
  std::vector<std::uint32_t> slice_of_label(arcs.labels, kNoNumber);
  std::uint32_t place = 0;
  for (std::uint32_t label = 0; label < arcs.labels; ++label) {
    ask_budget();
    if (count[label] == 0) continue;
    const std::uint32_t slice = slice_of_label[label] = made();
    slices_[slice].begin = place;
    slices_[slice].bottoms = place + of_bottoms[label];
    slices_[slice].end = place + count[label];
    slices_[slice].target = 0;
    link(slice, 0);
    place = slices_[slice].end;
    // From here on: the next places of either kind.
    count[label] = slices_[slice].bottoms;
    of_bottoms[label] = slices_[slice].begin;
  }
  for (std::uint32_t arc = 0; arc < arcs.size(); ++arc) {
    ask_budget();
    const std::uint32_t label = arcs.label[arc];
    const bool is_of_bottom = inert[arcs.source[arc]] == 0;
    place_[arc] = is_of_bottom ? of_bottoms[label]++ : count[label]++;
    order_[place_[arc]] = arc;
    slice_of_[arc] = slice_of_label[label];
    slices_[slice_of_[arc]].is_silent = arcs.is_silent[arc];
  }
}

std::uint32_t Slices::made() {
  if (!free_.empty()) {
    const std::uint32_t slice = free_.back();
    free_.pop_back();
    slices_[slice] = Slice();
    return slice;
  }
  slices_.emplace_back();
  return static_cast<std::uint32_t>(slices_.size() - 1);
}

void Slices::swap_places(std::uint32_t one, std::uint32_t other) {
  std::swap(order_[one], order_[other]);
  place_[order_[one]] = one;
  place_[order_[other]] = other;
}

void Slices::link(std::uint32_t slice, std::uint32_t block) {
  if (block >= first_.size()) first_.resize(block + 1, kNoNumber);
  Slice& linked = slices_[slice];
  linked.block = block;
  linked.previous = kNoNumber;
  linked.next = first_[block];
  if (linked.next != kNoNumber) slices_[linked.next].previous = slice;
  first_[block] = slice;
}

void Slices::remove(std::uint32_t slice) {
  Slice& gone = slices_[slice];
  if (gone.previous == kNoNumber) {
    first_[gone.block] = gone.next;
  } else {
    slices_[gone.previous].next = gone.next;
  }
  if (gone.next != kNoNumber) slices_[gone.next].previous = gone.previous;
  if (gone.beside != kNoNumber && slices_[gone.beside].beside == slice) {
    slices_[gone.beside].beside = kNoNumber;
  }
  gone = Slice();
  free_.push_back(slice);
}

void Slices::take_out(std::uint32_t arc, bool is_of_bottom) {
  const std::uint32_t whole = slice_of_[arc];
  if (slices_[whole].part == kNoNumber) {
    const std::uint32_t part = made();
    slices_[whole].part = part;
    // Until they are brought together: the ends of the two fronts.
    slices_[part].bottoms = slices_[whole].begin;
    slices_[part].end = slices_[whole].bottoms;
    divided_.push_back(whole);
  }
  Slice& part = slices_[slices_[whole].part];
  swap_places(place_[arc], is_of_bottom ? part.bottoms++ : part.end++);
  slice_of_[arc] = slices_[whole].part;
}

// Brings the two fronts together.
void Slices::close(std::uint32_t which) {
  Slice& whole = slices_[which];
  Slice& part = slices_[whole.part];
  const std::uint32_t left = whole.bottoms - part.bottoms;
  exchange(
      part.bottoms, whole.bottoms, part.end,
      [&](std::uint32_t one, std::uint32_t other) { swap_places(one, other); });
  part.begin = whole.begin;
  part.end -= left;
  part.is_silent = whole.is_silent;
  whole.begin = part.end;
  whole.bottoms = part.end + left;
}

void Slices::remove_empty() {
  parts_.clear();
  for (const std::uint32_t each : divided_) {
    parts_.push_back(std::exchange(slices_[each].part, kNoNumber));
    if (slices_[each].begin == slices_[each].end) remove(each);
  }
  divided_.clear();
}

const std::vector<std::uint32_t>& Slices::divide_for_block(
    std::uint32_t block) {
  for (const std::uint32_t each : divided_) {
    close(each);
    Slice& whole = slices_[each];
    Slice& part = slices_[whole.part];
    part.target = whole.target;
    part.questions = whole.questions;
    if (whole.beside != kNoNumber) part.beside = slices_[whole.beside].part;
    link(whole.part, block);
  }
  remove_empty();
  return parts_;
}

const std::vector<std::uint32_t>& Slices::divide_for_target(
    std::uint32_t target) {
  for (const std::uint32_t each : divided_) {
    close(each);
    Slice& whole = slices_[each];
    Slice& part = slices_[whole.part];
    part.target = target;
    part.beside = each;
    whole.beside = whole.part;
    link(whole.part, whole.block);
  }
  remove_empty();
  return parts_;
}

void Slices::source_becomes_bottom(std::uint32_t arc) {
  const std::uint32_t slice = slice_of_[arc];
  if (slice != kNoNumber) swap_places(place_[arc], slices_[slice].bottoms++);
}

void Slices::drop(std::uint32_t block) {
  if (block >= first_.size()) return;
  while (first_[block] != kNoNumber) {
    const std::uint32_t slice = first_[block];
    for (const std::uint32_t arc : arcs(slice)) slice_of_[arc] = kNoNumber;
    remove(slice);
  }
}

}  // namespace btcheck
