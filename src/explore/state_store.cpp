// SPDX-License-Identifier: MIT
//
// Both levels are the same open-addressing table: the vectors lie one after
// another in order of insertion, a slot holds only a number, and a probe
// compares whole vectors, so that no answer ever rests on a hash. Slots are
// kept below three quarters full and doubled; the vectors grow by a quarter,
// because at the sizes that matter a doubled array is memory lost.
#include "explore/state_store.hpp"

#include <xxhash.h>

#include <algorithm>
#include <cassert>
#include <cstring>

namespace btcheck {
namespace {

constexpr std::uint32_t kFree = 0xffffffff;
constexpr std::size_t kFirstSlots = 1024;

// Strong enough for keys that are two dense numbers, and inlined.
std::uint64_t mix(std::uint64_t key) {
  key ^= key >> 32;
  key *= 0xd6e8feb86659fd93ull;
  key ^= key >> 32;
  key *= 0xd6e8feb86659fd93ull;
  return key ^ (key >> 32);
}

std::uint64_t hash_of(const Word* words, std::size_t count) {
  return count == 1 ? mix(words[0]) : XXH3_64bits(words, count * sizeof(Word));
}

bool equal_words(const Word* left, const Word* right, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (left[i] != right[i]) return false;
  }
  return true;
}

}  // namespace

VectorSet::VectorSet(std::size_t words)
    : words_(words), slots_(kFirstSlots, kFree) {}

VectorSet::Inserted VectorSet::insert(StateView vector) {
  assert(vector.size() == words_);
  if (words_ == 0) {
    const bool is_new = size_ == 0;
    size_ = 1;
    return {0, is_new};
  }
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(vector.data(), words_) & mask;
  while (slots_[slot] != kFree) {
    const Word* stored = vectors_.data() + std::size_t{slots_[slot]} * words_;
    if (equal_words(stored, vector.data(), words_)) {
      return {slots_[slot], false};
    }
    slot = (slot + 1) & mask;
  }
  const std::uint32_t id = static_cast<std::uint32_t>(size_++);
  if (vectors_.size() + words_ > vectors_.capacity()) {
    vectors_.reserve(std::max<std::size_t>(vectors_.capacity() / 4 * 5,
                                           kFirstSlots * words_));
  }
  vectors_.insert(vectors_.end(), vector.begin(), vector.end());
  slots_[slot] = id;
  if (size_ * 4 > slots_.size() * 3) grow();
  return {id, true};
}

void VectorSet::grow() {
  std::vector<std::uint32_t>(slots_.size() * 2, kFree).swap(slots_);
  const std::size_t mask = slots_.size() - 1;
  for (std::uint32_t id = 0; id < size_; ++id) {
    const Word* stored = vectors_.data() + std::size_t{id} * words_;
    std::size_t slot = hash_of(stored, words_) & mask;
    while (slots_[slot] != kFree) slot = (slot + 1) & mask;
    slots_[slot] = id;
  }
}

StateStore::StateStore(std::size_t words)
    : words_(words),
      cut_(words / 2),
      low_(cut_),
      high_(words - cut_),
      pairs_(1) {}

StateStore::Inserted StateStore::insert(StateView state) {
  const Word low = low_.insert(state.first(cut_)).id;
  const Word high = high_.insert(state.subspan(cut_)).id;
  const Word pair = low << 32 | high;
  const VectorSet::Inserted inserted = pairs_.insert({&pair, 1});
  return {StateId{inserted.id}, inserted.is_new};
}

void StateStore::load(StateId id, std::span<Word> out) const {
  const Word pair = pairs_[index(id)][0];
  StateView low = low_[static_cast<std::uint32_t>(pair >> 32)];
  StateView high = high_[static_cast<std::uint32_t>(pair)];
  std::copy(low.begin(), low.end(), out.begin());
  std::copy(high.begin(), high.end(),
            out.begin() + static_cast<std::ptrdiff_t>(cut_));
}

}  // namespace btcheck
