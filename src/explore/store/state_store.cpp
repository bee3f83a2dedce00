// SPDX-License-Identifier: MIT
//
// Both levels are the same open-addressing table: the vectors lie one after
// another in order of insertion, a slot holds only a number, and a probe
// compares whole vectors, so that no answer ever rests on a hash. The bits of a
// slot that its number leaves free hold bits of the hash: a vector that is
// another one is then hardly ever fetched. Slots are kept below three quarters
// full and doubled.
#include "explore/store/state_store.hpp"

#define XXH_INLINE_ALL
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

VectorSet::Place VectorSet::place_of(StateView vector) const {
  const std::uint64_t hash = hash_of(vector.data(), words_);
  const std::size_t mask = slots_.size() - 1;
  Place place{hash & mask, tag_of(hash)};
  while (slots_[place.slot] != kFree) {
    if ((slots_[place.slot] & ~number_mask()) == place.tag &&
        equal_words(vectors_.data() + number_in(place.slot) * words_,
                    vector.data(), words_)) {
      break;
    }
    place.slot = (place.slot + 1) & mask;
  }
  return place;
}

std::optional<std::uint32_t> VectorSet::find(StateView vector) const {
  if (words_ == 0) return size_ == 0 ? std::nullopt : std::optional(0u);
  const std::size_t slot = place_of(vector).slot;
  if (slots_[slot] == kFree) return std::nullopt;
  return static_cast<std::uint32_t>(number_in(slot));
}

void VectorSet::prefetch_slot(StateView vector) const {
  const std::size_t slot = hash_of(vector.data(), words_) & (slots_.size() - 1);
  __builtin_prefetch(&slots_[slot]);
}

void VectorSet::prefetch_vector(StateView vector) const {
  const std::size_t slot = hash_of(vector.data(), words_) & (slots_.size() - 1);
  if (slots_[slot] == kFree) return;
  __builtin_prefetch(vectors_.data() + number_in(slot) * words_);
}

VectorSet::Inserted VectorSet::insert(StateView vector) {
  assert(vector.size() == words_);
  if (words_ == 0) {
    const bool is_new = size_ == 0;
    size_ = 1;
    return {0, is_new};
  }
  const auto [slot, tag] = place_of(vector);
  if (slots_[slot] != kFree) {
    return {static_cast<std::uint32_t>(number_in(slot)), false};
  }
  const std::uint32_t id = static_cast<std::uint32_t>(size_++);
  vectors_.append(vector);
  slots_[slot] = tag | id;
  if (size_ * 4 > slots_.size() * 3) grow();
  return {id, true};
}

void VectorSet::grow() {
  const std::size_t slots = slots_.size() * 2;
  decltype(slots_)().swap(slots_);  // gone before the new ones are there
  slots_.assign(slots, kFree);
  const std::size_t mask = slots_.size() - 1;
  for (std::uint32_t id = 0; id < size_; ++id) {
    const Word* stored = vectors_.data() + std::size_t{id} * words_;
    const std::uint64_t hash = hash_of(stored, words_);
    std::size_t slot = hash & mask;
    while (slots_[slot] != kFree) slot = (slot + 1) & mask;
    slots_[slot] = tag_of(hash) | id;
  }
}

StateStore::StateStore(std::size_t words)
    : words_(words),
      cut_(words / 2),
      low_(cut_),
      high_(words - cut_),
      pairs_(1) {}

StateStore::Key StateStore::key(StateView state) {
  const Word low = low_.insert(state.first(cut_)).id;
  return low << 32 | high_.insert(state.subspan(cut_)).id;
}

StateStore::Key StateStore::key(StateView state, StateId near) {
  const Word pair = pairs_[index(near)][0];
  auto low = static_cast<std::uint32_t>(pair >> 32);
  auto high = static_cast<std::uint32_t>(pair);
  if (!equal_words(low_[low].data(), state.data(), cut_)) {
    low = low_.insert(state.first(cut_)).id;
  }
  if (!equal_words(high_[high].data(), state.data() + cut_, words_ - cut_)) {
    high = high_.insert(state.subspan(cut_)).id;
  }
  return Word{low} << 32 | high;
}

StateStore::Inserted StateStore::insert(Key key) {
  const VectorSet::Inserted inserted = pairs_.insert({&key, 1});
  return {StateId{inserted.id}, inserted.is_new};
}

std::optional<StateId> StateStore::find(StateView state) const {
  const auto low = low_.find(state.first(cut_));
  const auto high = high_.find(state.subspan(cut_));
  if (!low || !high) return std::nullopt;
  const Word pair = Word{*low} << 32 | *high;
  const auto found = pairs_.find({&pair, 1});
  return found ? std::optional(StateId{*found}) : std::nullopt;
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
