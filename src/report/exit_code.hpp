// SPDX-License-Identifier: MIT
//
// What has come of a check in one number.
#pragma once

#include <cstdint>

namespace btcheck {

// `--help` and the man page tell what each means.
enum class ExitCode : std::uint8_t {
  Met = 0,        // every property met its expectation
  Missed = 1,     // some property missed its expectation
  BadInput = 2,   // usage, input or model error: nothing was checked
  Undecided = 3,  // a limit, timeout or interrupt, and nothing violated
  Internal = 4    // our mistake
};

}  // namespace btcheck
