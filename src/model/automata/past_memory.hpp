// SPDX-License-Identifier: MIT
//
// Past operators as bits that the steps of a network keep up to date (Havelund
// and Rosu, "Synthesizing monitors for safety properties", TACAS 2002): whether
// `once P` or `P since Q` holds after a step is known from before it, and from
// P and Q after it. A step that changes neither P nor Q changes nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "model/automata/network.hpp"

namespace btcheck {

enum class PastOperator : std::uint8_t {
  Once,       // P now, or some time before
  Since,      // Q now or some time before, and P ever since then
  Previously  // P where the tick before this one ended; false in the first
};

// Conditions over the variables of the network.
struct PastCondition {
  PastOperator kind = PastOperator::Once;
  Expression held;        // P
  Expression began = {};  // Q of Since
};

// Adds such a bit to the network, under a key that nothing else has. Previously
// needs the answer of the tree's root to be remembered (tick_memory).
void remember_past(const BehaviorTree& tree, const PastCondition& condition,
                   std::string key, Network& network);

// The bit of that key.
std::optional<VariableId> past_memory(const Network& network,
                                      std::string_view key);

}  // namespace btcheck
