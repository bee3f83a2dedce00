// SPDX-License-Identifier: MIT
//
// The visited set of the parallel search: what is in it, and nothing else.
#include "explore/halves/pair_set.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <mutex>
#include <random>
#include <set>

#include "explore/store/in_parallel.hpp"

namespace btcheck::pair_set_test {
namespace {

// Inserts all pairs, resting whenever the set asks for it, and returns those
// that were new, as often as they were.
template <class Set>
std::vector<Word> insert_all(Set& set, const std::vector<Word>& pairs,
                             HalfCounts counts, std::uint64_t& size,
                             std::size_t threads) {
  std::vector<Word> found;
  std::vector<Word> left = pairs;
  std::mutex mutex;
  while (!left.empty()) {
    std::atomic<std::size_t> next = 0;
    std::atomic<std::uint64_t> states = size;
    std::vector<Word> again;  // found no place
    constexpr std::size_t kBlock = 64;
    in_parallel(threads, [&](std::size_t) {
      Inserter<Set> inserter(set);
      std::vector<Word> own;
      const auto is_new = [&](Word pair) { own.push_back(pair); };
      while (!set.is_crowded(states)) {
        const std::size_t first = next.fetch_add(kBlock);
        if (first >= left.size()) break;
        const std::size_t before = own.size();
        for (std::size_t i = first; i < std::min(first + kBlock, left.size());
             ++i) {
          inserter.offer(left[i], is_new);
        }
        states += own.size() - before;
      }
      inserter.flush(is_new);
      const std::vector<Word> turned_away = inserter.take_turned_away();
      const std::lock_guard<std::mutex> lock(mutex);
      found.insert(found.end(), own.begin(), own.end());
      again.insert(again.end(), turned_away.begin(), turned_away.end());
    });
    size = found.size();
    set.make_room(again.empty() ? size : size + size / 4, counts);
    again.insert(again.end(),
                 left.begin() + static_cast<std::ptrdiff_t>(
                                    std::min(next.load(), left.size())),
                 left.end());
    left = std::move(again);
  }
  return found;
}

std::vector<Word> random_pairs(std::mt19937_64& random, HalfCounts counts,
                               std::size_t many) {
  std::vector<Word> pairs;
  for (std::size_t i = 0; i < many; ++i) {
    pairs.push_back(
        pair_of(static_cast<std::uint32_t>(random() % counts.low),
                static_cast<std::uint32_t>(random() % counts.high)));
  }
  return pairs;
}

template <class Set>
void check_against_std_set(HalfCounts counts, std::size_t many,
                           std::size_t threads, unsigned seed) {
  std::mt19937_64 random(seed);
  const std::vector<Word> pairs = random_pairs(random, counts, many);
  const std::set<Word> expected(pairs.begin(), pairs.end());
  Set set;
  std::uint64_t size = 0;
  const std::vector<Word> found = insert_all(set, pairs, counts, size, threads);
  // Each was new once.
  REQUIRE(found.size() == expected.size());
  CHECK(std::set<Word>(found.begin(), found.end()) == expected);
  for (const Word pair : expected) REQUIRE(set.contains(pair));
  for (const Word pair : random_pairs(random, counts, 2000)) {
    REQUIRE(set.contains(pair) == (expected.count(pair) > 0));
  }
  std::set<Word> listed;
  std::size_t count = 0;
  set.for_each([&](Word pair) {
    listed.insert(pair);
    ++count;
  });
  CHECK(count == expected.size());
  CHECK(listed == expected);
}

TEST_CASE_TEMPLATE("a set of pairs is the set that std::set says", Set,
                   ExactPairSet, CompressedPairSet) {
  check_against_std_set<Set>({1, 1}, 10, 1, 1);
  check_against_std_set<Set>({3, 1000}, 5000, 1, 2);
  check_against_std_set<Set>({300, 300}, 60'000, 1, 3);
  check_against_std_set<Set>({70'000, 20'000}, 100'000, 1, 4);
}

TEST_CASE_TEMPLATE("four threads insert what one would, and grow on the way",
                   Set, ExactPairSet, CompressedPairSet) {
  const tbb::global_control parallelism(
      tbb::global_control::max_allowed_parallelism, 4);
  for (unsigned seed = 1; seed <= 2; ++seed) {
    check_against_std_set<Set>({200, 300}, 100'000, 4, seed);
    check_against_std_set<Set>({70'000, 20'000}, 50'000, 4, seed);
  }
}

TEST_CASE("numbers of more bits than the code has are held all the same") {
  // Few that are too large: they wait beside. Many: all are coded anew. So
  // large that no code pays: they stay.
  check_against_std_set<CompressedPairSet>({1u << 20, 100}, 50'000, 1, 1);
  check_against_std_set<CompressedPairSet>({600'000, 600'000}, 50'000, 4, 2);
  check_against_std_set<CompressedPairSet>({1u << 31, 1u << 31}, 50'000, 4, 3);
}

TEST_CASE("a code is a permutation, and tells the pair back") {
  std::mt19937_64 random(5);
  for (int low = 19; low <= 23; ++low) {
    const QuotientCoding coding(low, 42 - low);
    for (int round = 0; round < 1000; ++round) {
      const Word pair = pair_of(
          static_cast<std::uint32_t>(random() % (Word{1} << low)),
          static_cast<std::uint32_t>(random() % (Word{1} << (42 - low))));
      REQUIRE(coding.fits(pair));
      CHECK(coding.pair(0, coding.scatter(pair)) == pair);
    }
  }
}

TEST_CASE("a slot tells the scattered pair back, in tables of any size") {
  std::mt19937_64 random(6);
  for (int round = 0; round < 20'000; ++round) {
    const QuotientCoding coding(19 + static_cast<int>(random() % 3), 20);
    const std::uint64_t buckets =
        coding.fewest_buckets() * (64 + random() % 100'000);
    const Word scattered =
        coding.scatter(pair_of(static_cast<std::uint32_t>(random() % 500'000),
                               static_cast<std::uint32_t>(random() % 500'000)))
        << kSegmentBits;
    const WideProduct product = multiplied(scattered, buckets);
    const int shift = coding.shift(buckets);
    const auto distance = static_cast<std::uint32_t>(random() % 31);
    const auto slot = QuotientCoding::slot(0, product.lower, shift, distance);
    REQUIRE(slot != 0);
    REQUIRE(QuotientCoding::distance(slot) == distance);
    REQUIRE(coding.scattered(slot, product.upper, buckets, shift) == scattered);
  }
}

TEST_CASE(
    "a compressed set takes five to seven and a half bytes for each pair") {
  std::mt19937_64 random(7);
  const HalfCounts counts{3000, 3000};
  CompressedPairSet compressed;
  ExactPairSet exact;
  std::uint64_t size = 0;
  const std::vector<Word> pairs = random_pairs(random, counts, 100'000);
  insert_all(compressed, pairs, counts, size, 1);
  CHECK(compressed.bytes() < size * 15 / 2);
  std::uint64_t exact_size = 0;
  insert_all(exact, pairs, counts, exact_size, 1);
  CHECK(exact_size == size);
  CHECK(exact.bytes() < size * 14);
}

}  // namespace
}  // namespace btcheck::pair_set_test
