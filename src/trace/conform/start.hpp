// SPDX-License-Identifier: MIT
//
// Where a robot stands: the states that a model may be in after a recording.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/bind/verdict.hpp"
#include "explore/state/limits.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// At the last state of a run that btcheck has kept, or the last of a tick: what
// a run of this network is in that has the same nodes, values and times, one
// state after the other. Several where the recording leaves something open.
// Refused where no run of the network is that one (BT1808), or it has no such
// tick (BT1305).
Result<std::vector<Valuation>> states_after(const std::string& file,
                                            const BehaviorTree& tree,
                                            const Network& network,
                                            const RecordedRun& run,
                                            std::optional<int> tick);

// The same of a log, by following it in the network (conform.hpp). Refused is a
// tick of a log that does not show where its ticks begin (BT1814).
Result<std::vector<Valuation>> states_after(
    const std::string& file, const BehaviorTree& tree, const Network& network,
    const RecordedRun& recorded_tree, const BehaviorLog& log,
    const LogReading& reading, std::optional<int> tick, const Limits& limits);

// A clock has run there. Networks begin with all clocks at 0.
bool has_clock(const Valuation& state);

// Has the runs of the network begin there, where no clock has run.
void begin_at(Network& network, const Valuation& state);

}  // namespace btcheck
