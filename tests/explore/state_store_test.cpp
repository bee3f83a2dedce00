// SPDX-License-Identifier: MIT
//
// The visited set against std::map.
#include "explore/store/state_store.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

namespace btcheck::state_store_test {
namespace {

constexpr int kVectors = 100'000;

// Few different words, so that vectors recur and halves do more so.
std::vector<StateVector> random_vectors(std::size_t words, unsigned values,
                                        unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<StateVector> vectors;
  for (int n = 0; n < kVectors; ++n) {
    StateVector vector(words);
    for (Word& word : vector) {
      word = (random() % values) * 0x9e3779b97f4a7c15ull;
    }
    vectors.push_back(std::move(vector));
  }
  return vectors;
}

bool same(StateView view, const StateVector& vector) {
  return std::equal(view.begin(), view.end(), vector.begin(), vector.end());
}

// Inserts each vector and compares with a map from vectors to numbers.
template <class Insert>
void check_against_map(const std::vector<StateVector>& vectors, Insert insert) {
  std::map<StateVector, std::uint32_t> known;
  for (const StateVector& vector : vectors) {
    const auto next = static_cast<std::uint32_t>(known.size());
    const auto [entry, is_new] = known.emplace(vector, next);
    const auto [id, said_new] = insert(vector);
    if (id != entry->second || said_new != is_new) {
      FAIL("vector ", entry->second, " has become ", id);
    }
  }
}

TEST_CASE("a vector set numbers vectors densely and exactly") {
  for (const std::size_t words : {1u, 2u, 3u, 7u}) {
    CAPTURE(words);
    const auto vectors = random_vectors(words, words == 1 ? 60'000 : 400, 5);
    VectorSet set(words);
    check_against_map(vectors, [&](const StateVector& vector) {
      const VectorSet::Inserted made = set.insert(vector);
      return std::pair(made.id, made.is_new);
    });
    std::uint32_t next = 0;
    for (const StateVector& vector : vectors) {
      const std::uint32_t id = set.find(vector).value_or(UINT32_MAX);
      if (id >= set.size() || !same(set[id], vector)) FAIL("lost a vector");
      next = std::max(next, id + 1);
    }
    CHECK(set.size() == next);
  }
}

TEST_CASE("a state store numbers states densely and exactly") {
  for (const std::size_t words : {1u, 2u, 3u, 7u}) {
    CAPTURE(words);
    const auto vectors = random_vectors(words, words == 1 ? 60'000 : 300, 6);
    StateStore store(words);
    check_against_map(vectors, [&](const StateVector& vector) {
      const StateStore::Inserted made = store.insert(vector);
      return std::pair(index(made.id), made.is_new);
    });
    CHECK(store.word_count() == words);
    StateVector loaded(words);
    for (const StateVector& vector : vectors) {
      if (!store.find(vector)) FAIL("lost a state");
      store.load(store.insert(vector).id, loaded);
      if (loaded != vector) FAIL("a state has changed");
    }
  }
}

TEST_CASE("it makes no difference which stored state a new one is near") {
  for (const std::size_t words : {1u, 2u, 3u, 7u}) {
    CAPTURE(words);
    std::mt19937 random(8);
    const auto vectors = random_vectors(words, words == 1 ? 60'000 : 30, 7);
    StateStore store(words);
    const StateVector zero(words, 0);
    CHECK(index(store.insert(zero).id) == 0);
    std::map<StateVector, std::uint32_t> known{{zero, 0}};
    for (const StateVector& vector : vectors) {
      const auto next = static_cast<std::uint32_t>(known.size());
      const auto [entry, is_new] = known.emplace(vector, next);
      const StateId near{static_cast<std::uint32_t>(random() % next)};
      const StateStore::Inserted made = store.insert(store.key(vector, near));
      if (index(made.id) != entry->second || made.is_new != is_new) {
        FAIL("state ", entry->second, " has become ", index(made.id));
      }
    }
    CHECK(store.size() == known.size());
  }
}

TEST_CASE("vectors that differ in one bit are different states") {
  for (const std::size_t words : {1u, 2u, 3u, 7u}) {
    CAPTURE(words);
    StateStore store(words);
    StateVector vector(words, 0x5555aaaa5555aaaaull);
    CHECK(store.insert(vector).is_new);
    std::uint32_t next = 1;
    for (std::size_t bit = 0; bit < words * 64; ++bit) {
      vector[bit / 64] ^= Word{1} << (bit % 64);
      CHECK(!store.find(vector));
      const StateStore::Inserted made =
          store.insert(store.key(vector, StateId{0}));
      CHECK(made.is_new);
      CHECK(index(made.id) == next++);
      vector[bit / 64] ^= Word{1} << (bit % 64);
    }
    CHECK(!store.insert(vector).is_new);
    CHECK(store.size() == words * 64 + 1);
  }
}

TEST_CASE("a store that grows keeps what it has, and says what it holds") {
  StateStore store(2);
  const std::size_t empty = store.bytes();
  for (Word n = 0; n < 200'000; ++n) {
    const StateVector vector{n * n, n};
    if (index(store.insert(vector).id) != n) FAIL("not dense at ", n);
  }
  CHECK(store.size() == 200'000);
  CHECK(store.bytes() > empty + 200'000 * 2 * sizeof(Word));
  CHECK(store.bytes() < 200'000 * 100);
  StateVector loaded(2);
  for (Word n = 0; n < 200'000; n += 7) {
    store.load(StateId{static_cast<std::uint32_t>(n)}, loaded);
    if (loaded != StateVector{n * n, n}) FAIL("lost ", n);
  }
}

TEST_CASE("both halves of a state may be known while the state is not") {
  StateStore store(2);
  store.insert(StateVector{1, 10});
  store.insert(StateVector{2, 20});
  CHECK(!store.find(StateVector{1, 20}));
  CHECK(!store.find(StateVector{10, 1}));
  CHECK(store.insert(store.key(StateVector{1, 20}, StateId{1})).is_new);
  CHECK(store.find(StateVector{1, 20}));
  CHECK(store.size() == 3);
}

TEST_CASE("a set of vectors of no words holds at most the empty one") {
  VectorSet set(0);
  CHECK(!set.find({}).has_value());
  CHECK(set.insert({}).is_new);
  CHECK(!set.insert({}).is_new);
  CHECK(set.find({}) == 0u);
  CHECK(set.size() == 1);
}

}  // namespace
}  // namespace btcheck::state_store_test
