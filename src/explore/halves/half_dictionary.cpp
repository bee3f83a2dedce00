// SPDX-License-Identifier: MIT
//
// The vector is written before its number is told to anyone, and never moves.
#include "explore/halves/half_dictionary.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <utility>

namespace btcheck {
namespace {

constexpr std::uint32_t kFree = 0xffffffff;
constexpr std::size_t kFirstSlots = 16;
constexpr int kPartBits = 6;

std::uint64_t hash_of(const Word* vector, std::size_t words) {
  return XXH3_64bits(vector, words * sizeof(Word));
}

}  // namespace

HalfDictionary::HalfDictionary(std::size_t words)
    : words_(words), vectors_(words) {
  for (Part& part : parts_) part.slots.assign(kFirstSlots, kFree);
  slots_ = parts_.size() * kFirstSlots;
}

bool HalfDictionary::is_equal(std::uint32_t number, const Word* vector) const {
  return std::equal(vector, vector + words_, vectors_[number]);
}

std::uint32_t HalfDictionary::intern(const Word* vector) {
  const std::uint64_t hash = hash_of(vector, words_);
  Part& part = parts_[hash % parts_.size()];
  const std::lock_guard<std::mutex> lock(part.mutex);
  const std::size_t mask = part.slots.size() - 1;
  std::size_t slot = (hash >> kPartBits) & mask;
  for (; part.slots[slot] != kFree; slot = (slot + 1) & mask) {
    if (is_equal(part.slots[slot], vector)) return part.slots[slot];
  }
  const std::uint32_t number = size_.fetch_add(1, std::memory_order_relaxed);
  vectors_.reach(number);
  std::copy(vector, vector + words_, vectors_[number]);
  part.slots[slot] = number;
  if (++part.used * 4 > part.slots.size() * 3) grow(part);
  return number;
}

void HalfDictionary::grow(Part& part) {
  std::vector<std::uint32_t> old(part.slots.size() * 2, kFree);
  old.swap(part.slots);
  slots_ += old.size();
  const std::size_t mask = part.slots.size() - 1;
  for (const std::uint32_t number : old) {
    if (number == kFree) continue;
    std::size_t slot = (hash_of(vectors_[number], words_) >> kPartBits) & mask;
    while (part.slots[slot] != kFree) slot = (slot + 1) & mask;
    part.slots[slot] = number;
  }
}

std::size_t HalfDictionary::bytes() const {
  return vectors_.bytes(size()) +
         slots_.load(std::memory_order_relaxed) * sizeof(std::uint32_t);
}

Word PairDictionary::intern(StateView state, Word near) {
  const Word* high_words = state.data() + halves_[0].words();
  const std::uint32_t low = halves_[0].is_equal(low_of(near), state.data())
                                ? low_of(near)
                                : halves_[0].intern(state.data());
  const std::uint32_t high = halves_[1].is_equal(high_of(near), high_words)
                                 ? high_of(near)
                                 : halves_[1].intern(high_words);
  return pair_of(low, high);
}

void PairDictionary::load(Word pair, Word* out) const {
  const Word* low = halves_[0][low_of(pair)];
  const Word* high = halves_[1][high_of(pair)];
  std::copy(high, high + halves_[1].words(),
            std::copy(low, low + halves_[0].words(), out));
}

}  // namespace btcheck
