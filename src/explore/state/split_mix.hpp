// SPDX-License-Identifier: MIT
//
// Chance that is the same on every machine.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>

namespace btcheck {

// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
// generators", OOPSLA 2014).
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t mixed = state_ += 0x9E3779B97F4A7C15u;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBu;
    return mixed ^ (mixed >> 31);
  }

  // A number in [0, bound), each as likely as any other; bound >= 1.
  std::size_t below(std::size_t bound) {
    assert(bound >= 1);
    // Numbers above the last whole multiple of the bound are drawn again.
    const std::uint64_t rest = (UINT64_MAX % bound + 1) % bound;
    while (true) {
      const std::uint64_t number = next();
      if (number <= UINT64_MAX - rest) return number % bound;
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace btcheck
