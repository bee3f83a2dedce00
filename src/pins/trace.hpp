// SPDX-License-Identifier: MIT
//
// A trace that LTSmin has found, as a run of the tree.
#pragma once

#include <string>
#include <string_view>

#include "check/bind/verdict.hpp"
#include "explore/state/transition_system.hpp"
#include "pins/model.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// Reads what `ltsmin-printtrace` writes to a .csv. The model must be the one
// that was searched; a trace of linear time ends in a loop. `Lasso` has an
// empty cycle where there is none.
Result<Lasso> read_trace(const std::string& file, std::string_view text,
                         const PinsModel& model);

// The run, step by step executed on the network as it was lowered. Nothing, and
// `error` says why, where it cannot be.
std::optional<Run> replayed(const PinsModel& model, const Lasso& trace,
                            std::string& error);

}  // namespace btcheck
