// SPDX-License-Identifier: MIT
//
// Conjunctions of literals, as sets of labels.
#pragma once

#include <span>

#include "ltl/buchi/buchi.hpp"

namespace btcheck {

// The labels with all of `present` and none of `absent`.
struct Cube {
  PropositionSet present = 0;
  PropositionSet absent = 0;

  bool contains(Cube other) const {
    return (present & ~other.present) == 0 && (absent & ~other.absent) == 0;
  }
  bool meets(Cube other) const {
    return (present & other.absent) == 0 && (absent & other.present) == 0;
  }
  friend bool operator==(const Cube&, const Cube&) = default;
};

inline Cube cube_of(const BuchiTransition& transition) {
  return {transition.present, transition.absent};
}

// True when each label of `cube` is in one of `cover`. May say no when it is
// true but would take long to find out.
bool is_covered(Cube cube, std::span<const Cube> cover);

}  // namespace btcheck
