// SPDX-License-Identifier: MIT
//
// The visited set: packed state vectors, each stored once and numbered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "explore/state/transition_system.hpp"
#include "explore/store/growing_array.hpp"
#include "explore/store/huge_pages.hpp"

namespace btcheck {

// A set of fixed-length word vectors with dense numbers in order of insertion.
// Exact: two vectors get one number only when all their words agree.
class VectorSet {
 public:
  explicit VectorSet(std::size_t words);

  struct Inserted {
    std::uint32_t id;
    bool is_new;
  };
  Inserted insert(StateView vector);

  std::optional<std::uint32_t> find(StateView vector) const;

  // Hints that `vector` will be looked up soon: first the slot is fetched, and
  // when that has arrived the vector that it names.
  void prefetch_slot(StateView vector) const;
  void prefetch_vector(StateView vector) const;

  // Valid until the next insert.
  StateView operator[](std::uint32_t id) const {
    return {vectors_.data() + std::size_t{id} * words_, words_};
  }
  std::size_t size() const { return size_; }
  // With the memory that it will take when its slots are doubled, the old ones
  // beside the new, if that comes before a search asks again.
  std::size_t bytes() const {
    const bool grows_soon = (size_ + kSoon) * 4 > slots_.size() * 3;
    return vectors_.bytes() +
           slots_.size() * sizeof(std::uint32_t) * (grows_soon ? 3 : 1);
  }

 private:
  // The slot that holds the vector, or the free one where it belongs, and the
  // tag that is put beside its number.
  struct Place {
    std::size_t slot;
    std::uint32_t tag;
  };
  Place place_of(StateView vector) const;
  // There are fewer numbers than slots, so that many bits are enough.
  std::uint32_t number_mask() const {
    return static_cast<std::uint32_t>(slots_.size() - 1);
  }
  std::uint32_t tag_of(std::uint64_t hash) const {
    return static_cast<std::uint32_t>(hash >> 32) & ~number_mask();
  }
  std::size_t number_in(std::size_t slot) const {
    return slots_[slot] & number_mask();
  }
  void grow();

  // More vectors than a search finds between two looks at its limits.
  static constexpr std::size_t kSoon = 1u << 14;

  std::size_t words_;
  std::size_t size_ = 0;
  GrowingArray<Word> vectors_;
  std::vector<std::uint32_t, HugePages<std::uint32_t>>
      slots_;  // open addressing; kFree, or a tag and a number
};

// The visited set of a search. A vector is cut into two halves, each kept in a
// dictionary of its own, and a state is the pair of their numbers: halves
// recur far more often than states (collapse compression with two components;
// Holzmann, "State compression in SPIN", 1997).
class StateStore {
 public:
  explicit StateStore(std::size_t words);

  struct Inserted {
    StateId id;
    bool is_new;
  };
  Inserted insert(StateView state) { return insert(key(state)); }

  // The same in two steps, so that the memory that the second needs can be
  // fetched in between, for many states at once. The key is the pair of the
  // numbers of the halves.
  using Key = Word;
  Key key(StateView state);
  // Faster where the state shares a half with the stored one `near`: a
  // successor and the state it comes from nearly always do.
  Key key(StateView state, StateId near);
  void prefetch_slot(Key key) const { pairs_.prefetch_slot({&key, 1}); }
  void prefetch_pair(Key key) const { pairs_.prefetch_vector({&key, 1}); }
  Inserted insert(Key key);

  std::optional<StateId> find(StateView state) const;

  // Copies the state's words to `out`, which has word_count() of them.
  void load(StateId id, std::span<Word> out) const;

  std::size_t size() const { return pairs_.size(); }
  std::size_t word_count() const { return words_; }
  std::size_t bytes() const {
    return low_.bytes() + high_.bytes() + pairs_.bytes();
  }

 private:
  std::size_t words_;
  std::size_t cut_;  // words in the low half
  VectorSet low_;
  VectorSet high_;
  VectorSet pairs_;
};

}  // namespace btcheck
