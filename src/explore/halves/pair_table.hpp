// SPDX-License-Identifier: MIT
//
// A set of pairs that many threads insert into without locks: open addressing
// over cache lines, one compare-and-swap for each new pair (Laarman, van de
// Pol, Weber, "Boosting multi-core reachability performance with shared hash
// tables", 2010).
//
// A bucket is a cache line; its slots fill from left to right and are never
// emptied, so whoever reads an empty slot has seen all that came before it.
// The table grows by segments of different sizes: hardly ever more than one is
// due, so that growing never takes twice the memory, nor much at a time.
#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "explore/halves/pair_coding.hpp"
#include "explore/store/huge_pages.hpp"

namespace btcheck {

// Full: the table must grow before this pair can be inserted.
enum class Insertion : std::uint8_t { New, Known, Full };

// Which slots of a cache line equal `value`, one bit each, and which are
// empty. Others may write the line at the same time, so this is no more than
// a hint where to look. (Vector loads of what others write are no business of
// the thread sanitizer: each answer is checked by an atomic read.)
struct LineMatch {
  std::uint32_t equal = 0;
  std::uint32_t empty = 0;
};
#if defined(__SSE2__) && !defined(__SANITIZE_THREAD__)
// Which of four slots equal `value`.
inline std::uint32_t equal_slots(__m128i slots, std::uint32_t value) {
  const __m128i wanted = _mm_set1_epi32(static_cast<int>(value));
  return static_cast<std::uint32_t>(
      _mm_movemask_ps(_mm_castsi128_ps(_mm_cmpeq_epi32(slots, wanted))));
}
// Of two: where both halves do.
inline std::uint32_t equal_slots(__m128i slots, std::uint64_t value) {
  const __m128i wanted = _mm_set1_epi64x(static_cast<std::int64_t>(value));
  const __m128i halves = _mm_cmpeq_epi32(slots, wanted);
  const __m128i swapped = _mm_shuffle_epi32(halves, _MM_SHUFFLE(2, 3, 0, 1));
  return static_cast<std::uint32_t>(
      _mm_movemask_pd(_mm_castsi128_pd(_mm_and_si128(halves, swapped))));
}
template <class Slot>
inline LineMatch match_line(Slot* line, Slot value) {
  constexpr std::size_t kSlots = sizeof(__m128i) / sizeof(Slot);
  LineMatch match;
  for (std::size_t i = 0; i < 4; ++i) {
    // Volatile: read once. A slot that were first compared with `value`, then
    // written by another thread and then compared with 0 would be overlooked.
    const __m128i slots =
        *(reinterpret_cast<const volatile __m128i*>(line) + i);
    match.equal |= equal_slots(slots, value) << (kSlots * i);
    match.empty |= equal_slots(slots, Slot{0}) << (kSlots * i);
  }
  return match;
}
#else
template <class Slot>
inline LineMatch match_line(Slot* line, Slot value) {
  LineMatch match;
  for (std::uint32_t i = 0; i < 64 / sizeof(Slot); ++i) {
    const Slot found =
        std::atomic_ref<Slot>(line[i]).load(std::memory_order_relaxed);
    match.equal |= std::uint32_t{found == value} << i;
    match.empty |= std::uint32_t{found == 0} << i;
  }
  return match;
}
#endif

template <class Coding>
class PairTable {
 public:
  using Slot = typename Coding::Slot;
  static constexpr std::uint32_t kSegments = 1u << kSegmentBits;
  static constexpr std::uint32_t kSlotsPerBucket = 64 / sizeof(Slot);

  explicit PairTable(Coding coding) : coding_(coding) {
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      // From one doubling to the next the segments grow in turn.
      resize(segments_[i], std::max(kFirstBuckets + (enlarged(kFirstBuckets) -
                                                     kFirstBuckets) *
                                                        i / kSegments,
                                    coding_.fewest_buckets()));
    }
  }

  const Coding& coding() const { return coding_; }

  // Where a pair belongs. Valid until the table grows.
  struct Place {
    Word pair = 0;
    Word lower = 0;
    Slot* line = nullptr;
    std::uint32_t segment = 0;
  };
  // Also has the line fetched, so that many places can be on their way.
  Place place(Word pair) const {
    const Word scattered = coding_.scatter(pair);
    const auto number =
        static_cast<std::uint32_t>(scattered >> (64 - kSegmentBits));
    const Segment& segment = segments_[number];
    const WideProduct product =
        multiplied(scattered << kSegmentBits, segment.buckets);
    Slot* line = segment.slots + product.upper * kSlotsPerBucket;
    __builtin_prefetch(line, 1);
    return {pair, product.lower, line, number};
  }
  Insertion insert(const Place& place) {
    return probe(place, [](Slot* line, Slot value) {
      return insert_in_line(line, value);
    });
  }
  bool contains(Word pair) const {
    return probe(place(pair), [](Slot* line, Slot value) {
             const LineMatch match = match_line(line, value);
             return match.equal != 0   ? Insertion::Known
                    : match.empty != 0 ? Insertion::New
                                       : Insertion::Full;
           }) == Insertion::Known;
  }

  // How many pairs there may be before some segment is too full.
  std::uint64_t room() const {
    std::uint64_t least = UINT64_MAX;
    for (const Segment& segment : segments_) {
      least = std::min(least, capacity(segment));
    }
    return least;
  }

  // Bytes after the growth that `pairs` of them ask for, the copy that is made
  // on the way included.
  std::size_t bytes_for(std::uint64_t pairs) const {
    std::size_t bytes = 0;
    std::size_t largest = 0;
    for (const Segment& segment : segments_) {
      const std::size_t now = segment.memory.bytes();
      const bool grows = capacity(segment) < pairs;
      bytes += grows ? enlarged(segment.buckets) * 64 : now;
      if (grows) largest = std::max(largest, now);
    }
    return bytes + largest;
  }

  // Which segments have to grow when there shall be room for so many; `grow`
  // may be called for different ones at once, but not beside anything else.
  bool must_grow(std::uint32_t segment, std::uint64_t pairs) const {
    return capacity(segments_[segment]) < pairs;
  }

  void grow(std::uint32_t number) {
    Segment old = std::move(segments_[number]);
    std::uint64_t buckets = old.buckets;
    bool has_all = false;
    while (!has_all) {
      buckets = enlarged(buckets);
      resize(segments_[number], buckets);
      has_all = true;
      OpenLine open;
      for_each_slot(old, [&](Slot slot, Word scattered) {
        const Word pair = std::is_same_v<Coding, ExactCoding>
                              ? coding_.pair(slot, 0)
                              : Word{0};
        has_all = has_all && put(segments_[number], open, pair, scattered);
      });
    }
  }

  // Calls found(pair) for each pair of a segment.
  template <class Found>
  void for_each(std::uint32_t number, Found&& found) const {
    for_each_slot(segments_[number], [&](Slot slot, Word scattered) {
      found(coding_.pair(slot, Word{number} << (64 - kSegmentBits) |
                                   scattered >> kSegmentBits));
    });
  }

  // Gives a segment's memory back; the table cannot be used any more.
  void drop(std::uint32_t segment) { segments_[segment] = {}; }

  std::size_t bytes() const {
    std::size_t bytes = 0;
    for (const Segment& segment : segments_) bytes += segment.memory.bytes();
    return bytes;
  }

 private:
  static constexpr std::uint64_t kFirstBuckets = 64;

  struct Segment {
    Slot* slots = nullptr;
    Slot* end = nullptr;
    std::uint64_t buckets = 0;
    int shift = 0;
    ZeroedPages memory;
  };

  // What `look` says of the first line that it does not call full.
  template <class Look>
  Insertion probe(const Place& place, Look look) const {
    const Segment& segment = segments_[place.segment];
    Slot* line = place.line;
    for (std::uint32_t distance = 0; distance <= Coding::kMostDistance;
         ++distance) {
      const Insertion seen = look(
          line, Coding::slot(place.pair, place.lower, segment.shift, distance));
      if (seen != Insertion::Full) return seen;
      line += kSlotsPerBucket;
      if (line == segment.end) line = segment.slots;
      if (line == place.line) break;
    }
    return Insertion::Full;
  }

  static Insertion insert_in_line(Slot* line, Slot value) {
    LineMatch match = match_line(line, value);
    if (match.equal != 0) return Insertion::Known;
    for (; match.empty != 0; match.empty &= match.empty - 1) {
      std::atomic_ref<Slot> slot(line[std::countr_zero(match.empty)]);
      Slot found = 0;
      if (slot.compare_exchange_strong(found, value,
                                       std::memory_order_relaxed)) {
        return Insertion::New;
      }
      if (found == value) return Insertion::Known;
    }
    return Insertion::Full;
  }

  // With how many pairs in the whole table a segment is as full as it may be:
  // 7 of 8 slots.
  static std::uint64_t capacity(const Segment& segment) {
    return segment.buckets * kSlotsPerBucket * kSegments / 8 * 7;
  }
  static std::uint64_t enlarged(std::uint64_t buckets) {
    return buckets + buckets / 16 * 5;
  }
  void resize(Segment& segment, std::uint64_t buckets) const {
    segment.memory = ZeroedPages(buckets * 64);
    segment.slots = static_cast<Slot*>(segment.memory.data());
    segment.end = segment.slots + buckets * kSlotsPerBucket;
    segment.buckets = buckets;
    segment.shift = coding_.shift(buckets);
  }
  // Calls found(slot, scattered within the segment) for each slot in use.
  template <class Found>
  void for_each_slot(const Segment& segment, Found&& found) const {
    for (std::uint64_t bucket = 0; bucket < segment.buckets; ++bucket) {
      const Slot* line = segment.slots + bucket * kSlotsPerBucket;
      for (std::uint32_t i = 0; i < kSlotsPerBucket && line[i] != 0; ++i) {
        const std::uint64_t distance = Coding::distance(line[i]);
        const std::uint64_t home = bucket >= distance
                                       ? bucket - distance
                                       : bucket + segment.buckets - distance;
        found(line[i],
              coding_.scattered(line[i], home, segment.buckets, segment.shift));
      }
    }
  }

  // A line that pairs are being put in, and how many it has: they come in
  // nearly the order of their places, mostly several in a row for one line.
  struct OpenLine {
    std::uint64_t bucket = UINT64_MAX;
    std::uint32_t used = 0;
  };

  // Alone with the segment; false where there is no place.
  bool put(const Segment& segment, OpenLine& open, Word pair,
           Word scattered) const {
    const WideProduct product = multiplied(scattered, segment.buckets);
    Slot* line = segment.slots + product.upper * kSlotsPerBucket;
    if (product.upper != open.bucket) {
      const std::uint32_t empty = match_line(line, Slot{0}).empty;
      open.bucket = product.upper;
      open.used = empty == 0
                      ? kSlotsPerBucket
                      : static_cast<std::uint32_t>(std::countr_zero(empty));
    }
    if (open.used == kSlotsPerBucket) {
      return put_elsewhere(segment, product.upper, pair, product.lower);
    }
    line[open.used++] = Coding::slot(pair, product.lower, segment.shift, 0);
    return true;
  }

  // Where the pair's own bucket is full.
  bool put_elsewhere(const Segment& segment, std::uint64_t bucket, Word pair,
                     Word lower) const {
    for (std::uint32_t distance = 1; distance <= Coding::kMostDistance;
         ++distance) {
      if (++bucket == segment.buckets) bucket = 0;
      Slot* line = segment.slots + bucket * kSlotsPerBucket;
      const LineMatch match = match_line(line, Slot{0});
      if (match.empty == 0) continue;
      line[std::countr_zero(match.empty)] =
          Coding::slot(pair, lower, segment.shift, distance);
      return true;
    }
    return false;
  }

  Coding coding_;
  std::array<Segment, kSegments> segments_;
};

}  // namespace btcheck
