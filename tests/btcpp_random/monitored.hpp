// SPDX-License-Identifier: MIT
//
// What btcheck/monitor.hpp says of a run of the engine, told event by event.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "btcpp_random/engine_events.hpp"
#include "btcpp_random/naive_rules.hpp"

namespace btcheck::reference {

// By a table that `btcheck export --to monitor` has written for the tree.
std::vector<NaiveVerdict> monitored_verdicts(const EngineRun& run,
                                             std::string_view table);

}  // namespace btcheck::reference
