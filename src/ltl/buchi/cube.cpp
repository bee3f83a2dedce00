// SPDX-License-Identifier: MIT
//
// Whether cubes cover a cube, by Shannon expansion.
#include "ltl/buchi/cube.hpp"

#include <vector>

namespace btcheck {

namespace {

constexpr int kMostExpansions = 256;

// A proposition on which `cover` decides and `cube` does not; 0 for none.
PropositionSet deciding_proposition(Cube cube, Cube cover) {
  const PropositionSet open =
      (cover.present | cover.absent) & ~(cube.present | cube.absent);
  return open & (~open + 1);
}

}  // namespace

bool is_covered(Cube cube, std::span<const Cube> cover) {
  std::vector<Cube> open{cube};
  for (int i = 0; i < kMostExpansions && !open.empty(); ++i) {
    const Cube part = open.back();
    open.pop_back();
    const Cube* meeting = nullptr;
    bool contained = false;
    for (const Cube& other : cover) {
      contained = contained || other.contains(part);
      if (other.meets(part)) meeting = &other;
    }
    if (contained) continue;
    if (meeting == nullptr) return false;
    const PropositionSet split = deciding_proposition(part, *meeting);
    open.push_back({part.present | split, part.absent});
    open.push_back({part.present, part.absent | split});
  }
  return open.empty();
}

}  // namespace btcheck
