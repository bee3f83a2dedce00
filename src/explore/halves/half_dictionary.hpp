// SPDX-License-Identifier: MIT
//
// The dictionary of half state vectors: each once, under a dense number.
//
// Collapse compression (Holzmann, "State compression in SPIN", 1997) with two
// components, shared by all threads of a search. Halves are few, a hundredth
// or less of the states, and known ones are nearly always reached by number
// (split_network.hpp), so a lock for each of 64 parts of the table is enough.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "explore/halves/pair_coding.hpp"
#include "explore/state/state_layout.hpp"
#include "explore/store/chunked_array.hpp"

namespace btcheck {

// A set of vectors of `words` words each, compared word by word: no answer
// rests on a hash. Which vector gets which number depends on who comes first.
// Every member may be called at any time by any thread. Throws std::bad_alloc.
class HalfDictionary {
 public:
  explicit HalfDictionary(std::size_t words);

  // The number of a vector, which is added where it is not known yet.
  std::uint32_t intern(const Word* vector);
  bool is_equal(std::uint32_t number, const Word* vector) const;

  // Valid for as long as the dictionary is.
  const Word* operator[](std::uint32_t number) const {
    return vectors_[number];
  }
  std::size_t words() const { return words_; }
  std::size_t size() const { return size_.load(std::memory_order_relaxed); }
  std::size_t bytes() const;

 private:
  // The vectors whose hash ends in the part's number, by open addressing.
  struct Part {
    std::mutex mutex;
    std::vector<std::uint32_t> slots;  // kFree or a number
    std::size_t used = 0;
  };

  void grow(Part& part);

  std::size_t words_;
  ChunkedArray<Word> vectors_;
  std::atomic<std::uint32_t> size_ = 0;
  std::atomic<std::size_t> slots_ = 0;
  std::array<Part, 64> parts_;
};

// Both dictionaries: whole states as pairs of numbers (pair_coding.hpp). The
// low half has half of the words, rounded down, as in StateLayout.
class PairDictionary {
 public:
  explicit PairDictionary(std::size_t words)
      : words_(words),
        halves_{HalfDictionary(words / 2), HalfDictionary(words - words / 2)} {}

  std::size_t word_count() const { return words_; }
  HalfDictionary& half(Half half) { return halves_[index(half)]; }
  const HalfDictionary& half(Half half) const { return halves_[index(half)]; }

  Word intern(StateView state) {
    return pair_of(halves_[0].intern(state.data()),
                   halves_[1].intern(state.data() + halves_[0].words()));
  }
  // Faster where the state has a half in common with a known one.
  Word intern(StateView state, Word near);
  // Copies a state to `out`, which has word_count() words.
  void load(Word pair, Word* out) const;

  HalfCounts counts() const { return {halves_[0].size(), halves_[1].size()}; }
  std::size_t bytes() const { return halves_[0].bytes() + halves_[1].bytes(); }

 private:
  std::size_t words_;
  HalfDictionary halves_[2];
};

}  // namespace btcheck
