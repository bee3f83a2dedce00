// SPDX-License-Identifier: MIT
//
// Growing. Each time a little more room is made than was asked for, so that the
// next growth is not due at once; which segments grow follows from their sizes
// alone. Recoding goes segment by segment and frees the old ones on the way, so
// it holds hardly more than the larger of the two tables.
#include "explore/halves/pair_set.hpp"

#include <algorithm>
#include <bit>
#include <mutex>
#include <utility>

#include "explore/store/in_parallel.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kAlwaysAffordable = std::size_t{16} << 20;  // bytes

// A 64th more, and what the threads insert before they all have noticed.
std::uint64_t with_reserve(std::uint64_t pairs) {
  return pairs + pairs / 64 + 1024;
}

template <class Coding>
void grow_to(PairTable<Coding>& table, std::uint64_t pairs) {
  while (table.room() < pairs) {
    in_parallel(table.kSegments, [&](std::size_t i) {
      const auto segment = static_cast<std::uint32_t>(i);
      if (table.must_grow(segment, pairs)) table.grow(segment);
    });
  }
}

// For so many numbers and half as many to come.
int bits_for(std::size_t count) {
  return std::max(QuotientCoding::kFewestBits,
                  static_cast<int>(std::bit_width(count + count / 2)));
}

// Of a table with a place for every remainder.
std::size_t least_bytes(const QuotientCoding& coding) {
  return coding.fewest_buckets() * 64 * PairTable<QuotientCoding>::kSegments;
}

}  // namespace

void ExactPairSet::make_room(std::uint64_t pairs, HalfCounts) {
  grow_to(table_, with_reserve(pairs));
  room_ = table_.room();
}

std::size_t ExactPairSet::bytes_for(std::uint64_t pairs, HalfCounts) const {
  return table_.bytes_for(with_reserve(pairs));
}

Insertion CompressedPairSet::insert_wide(Word pair) {
  const Insertion inserted = wide_.insert(wide_.place(pair));
  if (inserted == Insertion::New) {
    wide_pairs_.fetch_add(1, std::memory_order_relaxed);
  }
  return inserted;
}

void CompressedPairSet::make_room(std::uint64_t pairs, HalfCounts counts) {
  if (const auto coding = better_coding(pairs, counts)) code_anew(*coding);
  grow_to(narrow_, with_reserve(pairs - wide_pairs()));
  room_ = narrow_.room();
  wide_.make_room(wide_pairs(), counts);
}

// The least table of a new code stands beside the old one for a while.
std::size_t CompressedPairSet::bytes_for(std::uint64_t pairs,
                                         HalfCounts counts) const {
  const std::size_t bytes =
      narrow_.bytes_for(with_reserve(pairs - wide_pairs())) +
      wide_.bytes_for(wide_pairs(), counts);
  const auto coding = better_coding(pairs, counts);
  return bytes + (coding ? least_bytes(*coding) : 0);
}

// A code with more bits leaves longer remainders, and those fit only where the
// table is large.
std::optional<QuotientCoding> CompressedPairSet::better_coding(
    std::uint64_t pairs, HalfCounts counts) const {
  if (wide_pairs() <= 512 || wide_pairs() <= pairs / 64) return std::nullopt;
  const int low = bits_for(counts.low);
  const int high = bits_for(counts.high);
  if (low + high > QuotientCoding::kMostBits ||
      low + high <= narrow_.coding().bits()) {
    return std::nullopt;
  }
  const QuotientCoding coding(low, high);
  const bool pays =
      least_bytes(coding) <= std::max(kAlwaysAffordable, 2 * bytes());
  return pays ? std::optional(coding) : std::nullopt;
}

void CompressedPairSet::code_anew(const QuotientCoding& coding) {
  Table old = std::exchange(narrow_, Table(coding));
  const ExactPairSet old_wide = std::exchange(wide_, ExactPairSet());
  std::uint64_t moved = wide_pairs_.exchange(0);
  std::vector<Word> wide;
  old_wide.for_each([&](Word pair) { wide.push_back(pair); });
  grow_to(narrow_, moved);
  take_over(std::move(wide));
  for (std::uint32_t segment = 0; segment < old.kSegments; ++segment) {
    std::vector<Word> pairs;
    old.for_each(segment, [&](Word pair) { pairs.push_back(pair); });
    old.drop(segment);
    moved += pairs.size();
    grow_to(narrow_, moved);
    take_over(std::move(pairs));
  }
}

void CompressedPairSet::take_over(std::vector<Word> pairs) {
  constexpr std::size_t kBlock = 4096;
  while (!pairs.empty()) {
    std::mutex mutex;
    std::vector<Word> turned_away;
    const std::size_t blocks = (pairs.size() + kBlock - 1) / kBlock;
    in_parallel(blocks, [&](std::size_t block) {
      Inserter<CompressedPairSet> inserter(*this);
      const auto ignore = [](Word) {};
      const std::size_t end = std::min(pairs.size(), (block + 1) * kBlock);
      for (std::size_t i = block * kBlock; i < end; ++i) {
        inserter.offer(pairs[i], ignore);
      }
      inserter.flush(ignore);
      const std::vector<Word> left = inserter.take_turned_away();
      const std::lock_guard<std::mutex> lock(mutex);
      turned_away.insert(turned_away.end(), left.begin(), left.end());
    });
    pairs = std::move(turned_away);
    if (!pairs.empty()) grow_to(narrow_, narrow_.room() + 1);
  }
}

}  // namespace btcheck
