// SPDX-License-Identifier: MIT
//
// `btcheck watch groot2://HOST[:PORT]…`: robots watched while they run.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/options.hpp"
#include "trace/live/live_log.hpp"
#include "trace/logs/behavior_log.hpp"

namespace btcheck {

// The rules for a robot of that name, or nothing where it has been shown what
// is wrong with them.
using RulesFor =
    std::function<std::optional<std::vector<LiveRules>>(const std::string&)>;

// Missed where a rule is violated that was not expected to be; bad input where
// a robot never answered, or said what cannot be understood.
ExitCode watch_robots(const Options& options, const LogReading& reading,
                      const RulesFor& rules_for);

}  // namespace btcheck
