// SPDX-License-Identifier: MIT
//
// A run made of its steps.
#pragma once

#include <optional>
#include <span>

#include "check/bind/verdict.hpp"
#include "explore/state/transition_system.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// The finite run from the network's first state with these steps, executed from
// its tables; nothing where one of them is not possible.
std::optional<Run> executed(const Network& network,
                            std::span<const Step> steps);

}  // namespace btcheck
