// SPDX-License-Identifier: MIT
//
// Which interleavings and values a search may leave out.
#pragma once

#include <cstdint>

namespace btcheck {

// A reduced system is a TransitionSystem again, with fewer states, so searches
// and products need not know. live_variables.* and ample_sets.* say what each
// reduction preserves, and why.
enum class Reduction : std::uint8_t {
  None,  // every interleaving and every value: the reference
  Live,  // values that nothing reads any more are fixed
  Full   // and independent steps are not interleaved
};

}  // namespace btcheck
