// SPDX-License-Identifier: MIT
//
// The figures of a state space, as a table or as JSON.
#pragma once

#include <cstdint>
#include <string>

#include "check/space/space.hpp"

namespace btcheck {

// What was measured, how, and what it took.
struct SpaceContext {
  const std::string& tree;  // its file
  const Network& network;
  const SpaceOptions& options;
  double seconds = 0;
  std::uint64_t peak_bytes = 0;  // of the process
};

std::string space_text(const SpaceReport& report, const SpaceContext& context);

// One object on one line; figures are numbers, `stopped` is null or a word.
std::string space_json(const SpaceReport& report, const SpaceContext& context);

}  // namespace btcheck
