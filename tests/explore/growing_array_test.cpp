// SPDX-License-Identifier: MIT
#include "explore/store/growing_array.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace btcheck::growing_array_test {
namespace {

struct Pair {
  std::uint32_t first;
  std::uint64_t second;
};

TEST_CASE("an array keeps its elements while it grows and moves") {
  GrowingArray<Pair> array;
  CHECK(array.empty());
  constexpr std::uint32_t kCount = 2'000'000;  // 32 MB, far beyond the heap
  for (std::uint32_t i = 0; i < kCount; ++i) {
    array.push_back({i, std::uint64_t{i} * i});
  }
  REQUIRE(array.size() == kCount);
  CHECK(array.bytes() == kCount * sizeof(Pair));
  bool is_whole = true;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    is_whole = is_whole && array[i].first == i &&
               array[i].second == std::uint64_t{i} * i;
  }
  CHECK(is_whole);
  GrowingArray<Pair> taken = std::move(array);
  CHECK(taken.back().first == kCount - 1);
  CHECK(array.size() == 0);
}

TEST_CASE("an array is filled, cut and filled again") {
  GrowingArray<int> array;
  array.resize(3, 7);
  CHECK(std::vector<int>(array.begin(), array.end()) ==
        std::vector<int>{7, 7, 7});
  array.resize(1);
  array.resize(3);
  CHECK(std::vector<int>(array.begin(), array.end()) ==
        std::vector<int>{7, 0, 0});
  array.pop_back();
  const std::vector<int> more{1, 2, 3};
  array.append(more);
  CHECK(std::vector<int>(array.begin(), array.end()) ==
        std::vector<int>{7, 0, 1, 2, 3});
  array.push_back(array[0]);
  CHECK(array.back() == 7);
  array.clear();
  CHECK(array.empty());
}

TEST_CASE("an element may be pushed back while the array moves") {
  GrowingArray<std::uint64_t> array;
  array.push_back(42);
  for (int i = 0; i < 1'000'000; ++i) array.push_back(array[0]);
  bool is_same = true;
  for (const std::uint64_t value : array) is_same = is_same && value == 42;
  CHECK(is_same);
}

}  // namespace
}  // namespace btcheck::growing_array_test
