// SPDX-License-Identifier: MIT
//
// Two ways to write a pair of half numbers into a slot of the visited set.
//
// Exact: the pair itself, 8 bytes. Quotient: Cleary's compact hashing ("Compact
// hash tables using bidirectional linear probing", 1984), 4 bytes. A pair has
// K significant bits, as many as its two numbers have, and a permutation of the
// numbers of K bits scatters them. Where a pair lies in the table then tells
// the upper bits of its permuted number, and the slot only holds the lower
// ones, and how far from its place the pair lies. Nothing is lost: place,
// distance and remainder give the pair back. A table that is no power of two
// in size is addressed by multiplying (Lemire 2019), which is order-preserving,
// and the remainder comes from the same product.
#pragma once

#include <bit>
#include <cassert>
#include <cstdint>

#include "explore/state/transition_system.hpp"

namespace btcheck {

// Pairs are words: the low half's number above the high half's, 32 bits each.
constexpr Word pair_of(std::uint32_t low, std::uint32_t high) {
  return Word{low} << 32 | high;
}
constexpr std::uint32_t low_of(Word pair) {
  return static_cast<std::uint32_t>(pair >> 32);
}
constexpr std::uint32_t high_of(Word pair) {
  return static_cast<std::uint32_t>(pair);
}

// How many halves there are: numbers below these occur in pairs.
struct HalfCounts {
  std::size_t low = 0;
  std::size_t high = 0;
};

// The full product of two words, by halves.
struct WideProduct {
  Word upper = 0;
  Word lower = 0;
};
inline WideProduct multiplied(Word left, Word right) {
  __extension__ using Wide = unsigned __int128;
  const Wide product = static_cast<Wide>(left) * right;
  return {static_cast<Word>(product >> 64), static_cast<Word>(product)};
}

// How many of the first bits of a scattered pair choose its segment.
inline constexpr int kSegmentBits = 5;

class ExactCoding {
 public:
  using Slot = std::uint64_t;
  static constexpr std::uint32_t kMostDistance = 1u << 20;

  // The scattered pair, its most significant bit first.
  Word scatter(Word pair) const {
    pair ^= pair >> 32;
    pair *= 0xd6e8feb86659fd93ull;
    pair ^= pair >> 32;
    return pair * 0xd6e8feb86659fd93ull;
  }
  int shift(std::uint64_t /*buckets*/) const { return 0; }
  std::uint64_t fewest_buckets() const { return 1; }
  // What a slot says of a pair, 0 for nothing; `lower` is the lower half of
  // the product that gave the bucket.
  static Slot slot(Word pair, Word /*lower*/, int /*shift*/,
                   std::uint32_t /*distance*/) {
    return pair + 1;
  }
  static std::uint32_t distance(Slot) { return 0; }
  // The scattered pair within its segment.
  Word scattered(Slot slot, std::uint64_t /*home*/, std::uint64_t /*buckets*/,
                 int /*shift*/) const {
    return scatter(slot - 1) << kSegmentBits;
  }
  static Word pair(Slot slot, Word /*scattered*/) { return slot - 1; }
};

// Of an odd number modulo 2^64, by Newton's iteration: each round doubles the
// bits that are right.
constexpr Word inverse(Word odd) {
  Word found = odd;
  for (int round = 0; round < 5; ++round) found *= 2 - odd * found;
  return found;
}

class QuotientCoding {
 public:
  using Slot = std::uint32_t;
  static constexpr int kRemainderBits = 27;
  static constexpr std::uint32_t kMostDistance = 30;
  // Of each number. With so few the remainder fits in any table.
  static constexpr int kFewestBits = 19;
  static constexpr int kMostBits = 46;  // of a pair

  QuotientCoding(int low_bits, int high_bits)
      : high_bits_(high_bits),
        bits_(low_bits + high_bits),
        first_(kFirst * static_cast<Word>(2 * bits_ + 1)),
        first_inverse_(inverse(first_)),
        second_(kSecond * static_cast<Word>(2 * bits_ + 1)),
        second_inverse_(inverse(second_)) {
    assert(low_bits >= kFewestBits && high_bits >= kFewestBits);
    assert(bits_ <= kMostBits);
  }

  int bits() const { return bits_; }
  bool fits(Word pair) const {
    return high_of(pair) >> high_bits_ == 0 &&
           low_of(pair) >> (bits_ - high_bits_) == 0;
  }

  Word scatter(Word pair) const {
    Word mixed = Word{low_of(pair)} << high_bits_ | high_of(pair);
    mixed = mixed * first_ & mask();
    mixed ^= mixed >> fold();
    return (mixed * second_) << (64 - bits_);
  }
  // How far the lower half of a product is shifted down to the remainder.
  // Neighbours in a bucket differ by `buckets` there, so as many low bits as
  // that has beyond the first tell nothing.
  int shift(std::uint64_t buckets) const {
    return 63 - (bits_ - kSegmentBits) +
           static_cast<int>(std::bit_width(buckets));
  }
  std::uint64_t fewest_buckets() const {
    const int excess = bits_ - kSegmentBits - kRemainderBits;
    return excess > 0 ? std::uint64_t{1} << excess : 1;
  }
  static Slot slot(Word /*pair*/, Word lower, int shift,
                   std::uint32_t distance) {
    return static_cast<Slot>(lower >> shift) + 1 + (distance << kRemainderBits);
  }
  static std::uint32_t distance(Slot slot) {
    return (slot - 1) >> kRemainderBits;
  }
  // The one multiple of `buckets` whose product begins like this, divided.
  Word scattered(Slot slot, std::uint64_t home, std::uint64_t buckets,
                 int shift) const {
    const int rest = bits_ - kSegmentBits;
    const Word remainder = (slot - 1) & ((1u << kRemainderBits) - 1);
    const Word least = home << rest | remainder << (shift - (64 - rest));
    return (least + buckets - 1) / buckets << (64 - rest);
  }
  // The pair of a scattered one, segment included.
  Word pair(Slot, Word scattered) const {
    Word mixed = (scattered >> (64 - bits_)) * second_inverse_ & mask();
    mixed ^= mixed >> fold();
    mixed = mixed * first_inverse_ & mask();
    return (mixed >> high_bits_) << 32 |
           (mixed & ((Word{1} << high_bits_) - 1));
  }

 private:
  static constexpr Word kFirst = 0x9e3779b97f4a7c15ull;
  static constexpr Word kSecond = 0xd6e8feb86659fd93ull;

  Word mask() const { return (Word{1} << bits_) - 1; }
  int fold() const { return (bits_ + 1) / 2; }

  int high_bits_;
  int bits_;
  // Others for each number of bits: pairs that lie together under one code are
  // scattered by the next, which they are brought to side by side.
  Word first_;
  Word first_inverse_;
  Word second_;
  Word second_inverse_;
};

}  // namespace btcheck
