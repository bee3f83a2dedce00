// SPDX-License-Identifier: MIT
//
// The figures of a state space as a table, and what makes the space large.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "check/space/contribution.hpp"
#include "check/space/quotient.hpp"
#include "check/space/space.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// What was measured, how, and what it took.
struct SpaceContext {
  const std::string& tree;  // its file
  const Network& network;
  const SpaceOptions& options;
  double seconds = 0;
  std::uint64_t peak_bytes = 0;             // of the process
  std::optional<Equivalence> modulo = {};   // of a quotient that was asked for
  const SpaceQuotient* quotient = nullptr;  // null where the whole is not known
};

std::string space_text(const SpaceReport& report, const SpaceContext& context);

// "none", "live", "full".
std::string_view reduction_word(Reduction reduction);
// That of --reduce: also "bisimulation" and "strong".
std::string_view reduction_asked(const SpaceContext& context);
// "root", "leaves", "all".
std::string_view seen_word(SeenAnswers seen);
// How many in a second, or bytes of each; nothing is ever divided by 0.
double per(std::uint64_t count, double unit);
double bytes_per_state(const SpaceReport& report);

// The parts with the largest factors, one a line, each with a way to make it
// smaller. Empty when no part matters much.
std::string contribution_text(const BehaviorTree& tree,
                              std::span<const Contribution> parts);

}  // namespace btcheck
