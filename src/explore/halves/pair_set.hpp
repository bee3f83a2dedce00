// SPDX-License-Identifier: MIT
//
// The visited set of a parallel search: pairs of half numbers, held exactly,
// in 8 bytes for each slot or in 4 (pair_coding.hpp). Threads insert without
// locks (pair_table.hpp). Growing needs the set for itself: searches ask
// between two chunks of work whether it is crowded, and let everybody rest
// first.
#pragma once

#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "explore/halves/pair_table.hpp"

namespace btcheck {

template <class Set>
concept PairSet = requires(Set& set, const Set& known, Word pair,
                           typename Set::Place place) {
  { known.place(pair) } -> std::same_as<typename Set::Place>;
  { set.insert(place) } -> std::same_as<Insertion>;
  { known.contains(pair) } -> std::same_as<bool>;
  { known.is_crowded(std::uint64_t{}) } -> std::same_as<bool>;
  {
    known.bytes_for(std::uint64_t{}, HalfCounts{})
    } -> std::same_as<std::size_t>;
  set.make_room(std::uint64_t{}, HalfCounts{});
};

class ExactPairSet {
 public:
  using Place = PairTable<ExactCoding>::Place;

  Place place(Word pair) const { return table_.place(pair); }
  Insertion insert(const Place& place) { return table_.insert(place); }
  bool contains(Word pair) const { return table_.contains(pair); }

  template <class Found>
  void for_each(Found&& found) const {
    for (std::uint32_t i = 0; i < table_.kSegments; ++i) {
      table_.for_each(i, found);
    }
  }

  // Whether it is time for more room, with so many pairs in it.
  bool is_crowded(std::uint64_t pairs) const { return pairs >= room_; }
  // Makes room for a few more than `pairs`, on as many threads as there are in
  // the present arena. Throws std::bad_alloc.
  void make_room(std::uint64_t pairs, HalfCounts counts);

  std::size_t bytes() const { return table_.bytes(); }
  // After make_room, what is held on the way included.
  std::size_t bytes_for(std::uint64_t pairs, HalfCounts counts) const;

 private:
  PairTable<ExactCoding> table_{ExactCoding()};
  std::uint64_t room_ = table_.room();
};

// While a search runs its halves become more, and so do the bits of a pair. A
// pair with too large a number waits in an exact set beside, and when those
// get many, all are coded anew; where that would not pay, they stay there.
class CompressedPairSet {
 public:
  struct Place : PairTable<QuotientCoding>::Place {
    bool fits = false;
  };

  Place place(Word pair) const {
    if (!narrow_.coding().fits(pair)) return {{.pair = pair}, false};
    return {narrow_.place(pair), true};
  }
  Insertion insert(const Place& place) {
    return place.fits ? narrow_.insert(place) : insert_wide(place.pair);
  }
  bool contains(Word pair) const {
    return narrow_.coding().fits(pair) ? narrow_.contains(pair)
                                       : wide_.contains(pair);
  }

  template <class Found>
  void for_each(Found&& found) const {
    for (std::uint32_t i = 0; i < Table::kSegments; ++i) {
      narrow_.for_each(i, found);
    }
    wide_.for_each(found);
  }

  bool is_crowded(std::uint64_t pairs) const {
    return pairs - wide_pairs() >= room_ || wide_.is_crowded(wide_pairs());
  }
  // With fewer halves than there are, {0, 0} for instance, nothing is coded
  // anew.
  void make_room(std::uint64_t pairs, HalfCounts counts);

  std::size_t bytes() const { return narrow_.bytes() + wide_.bytes(); }
  std::size_t bytes_for(std::uint64_t pairs, HalfCounts counts) const;

 private:
  using Table = PairTable<QuotientCoding>;

  std::uint64_t wide_pairs() const {
    return wide_pairs_.load(std::memory_order_relaxed);
  }
  Insertion insert_wide(Word pair);
  // Whether the halves have become so many that all are to be coded anew, and
  // how.
  std::optional<QuotientCoding> better_coding(std::uint64_t pairs,
                                              HalfCounts counts) const;
  void code_anew(const QuotientCoding& coding);
  void take_over(std::vector<Word> pairs);

  Table narrow_{
      QuotientCoding(QuotientCoding::kFewestBits, QuotientCoding::kFewestBits)};
  ExactPairSet wide_;
  std::atomic<std::uint64_t> wide_pairs_ = 0;
  std::uint64_t room_ = narrow_.room();
};

static_assert(PairSet<ExactPairSet>);
static_assert(PairSet<CompressedPairSet>);

// One thread's way into a set. A pair waits while its cache line is fetched,
// and is inserted when some others have come after it.
template <PairSet Set>
class Inserter {
 public:
  explicit Inserter(Set& set) : set_(set) {}

  // Calls found(pair) for the pair whose turn it is, if it is new.
  template <class Found>
  void offer(Word pair, Found&& found) {
    typename Set::Place& waiting = waiting_[next_ % kWaiting];
    if (next_ >= kWaiting) settle(waiting, found);
    waiting = set_.place(pair);
    ++next_;
  }
  // The same for all that still wait.
  template <class Found>
  void flush(Found&& found) {
    const std::size_t first = next_ < kWaiting ? 0 : next_ - kWaiting;
    for (std::size_t i = first; i < next_; ++i) {
      settle(waiting_[i % kWaiting], found);
    }
    next_ = 0;
  }
  // Pairs that found no place and have to be offered again after make_room.
  std::vector<Word> take_turned_away() { return std::move(turned_away_); }

 private:
  static constexpr std::size_t kWaiting = 32;

  template <class Found>
  void settle(const typename Set::Place& place, Found&& found) {
    const Insertion inserted = set_.insert(place);
    if (inserted == Insertion::New) found(place.pair);
    if (inserted == Insertion::Full) turned_away_.push_back(place.pair);
  }

  Set& set_;
  std::array<typename Set::Place, kWaiting> waiting_;
  std::size_t next_ = 0;
  std::vector<Word> turned_away_;
};

}  // namespace btcheck
