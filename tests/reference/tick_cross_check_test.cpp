// SPDX-License-Identifier: MIT
//
// Random trees ticked by recursion and by their networks, side by side.
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "reference/random_tree.hpp"
#include "reference/tick_driver.hpp"

namespace btcheck::reference {
namespace {

constexpr int kTicks = 20;

std::uint64_t first_seed() {
  const char* text = std::getenv("BTCHECK_SEED");
  return text == nullptr ? 1 : std::strtoull(text, nullptr, 10);
}

bool is_long_run() { return std::getenv("BTCHECK_LONG") != nullptr; }

// What goes differently in some of the runs of a tree, "" for nothing or when
// it cannot be read.
std::string difference_of(const std::string& text, std::uint64_t seed, int runs,
                          TickCensus& census) {
  const Result<BehaviorTree> tree = read_btf("random.btf", text);
  if (!tree.value) return {};
  const Network network = lower(*tree.value, TickSemantics::Root);
  for (int run = 0; run < runs; ++run) {
    const auto found = first_difference(*tree.value, network,
                                        seed + static_cast<std::uint64_t>(run),
                                        kTicks, census);
    if (found) return *found;
  }
  return {};
}

}  // namespace

TEST_CASE("networks tick as the trees do they were made of") {
  const std::uint64_t seed = first_seed();
  const std::uint64_t trees = is_long_run() ? 5000 : 500;
  TickCensus census;
  RandomTreeWeights large;
  large.max_nodes = 16;
  large.max_parallels = 3;
  large.max_running = 6;
  large.duration = 40;
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t here = seed * 1'000'000 + i;
    const std::string text =
        i % 2 == 0 ? random_tree(here) : random_tree(here, large);
    REQUIRE(read_btf("random.btf", text).value.has_value());
    if (difference_of(text, here, 2, census).empty()) continue;
    const std::string small = shrink(text, [&](const std::string& candidate) {
      return !difference_of(candidate, here, 20, census).empty();
    });
    FAIL("seed ", here, "\n", small, difference_of(small, here, 20, census));
  }
  MESSAGE(trees << " trees, " << census.ticks << " ticks, " << census.events
                << " events, " << census.halts << " halts, " << census.faults
                << " faults");
  CHECK(census.halts > census.ticks / 50);
  CHECK(census.faults > 10);
}

}  // namespace btcheck::reference
