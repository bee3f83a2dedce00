// SPDX-License-Identifier: MIT
//
// What the default report has found that is worth a look.
#pragma once

#include <string>
#include <string_view>

#include "check/check.hpp"
#include "trace/text.hpp"

namespace btcheck {

// Nodes of no use, guards that go stale, and nodes left running, each under a
// heading; "" where there are none. Of the last two the runs that show them
// are told as well where `detail` asks for every step.
std::string findings_text(const BehaviorTree& tree, const CheckedFile& file,
                          Detail detail);

// "e.g. in tick 3", "e.g. at time 3", with what is to stand before it; ""
// where no time passes.
std::string when_text(std::string_view before, TickSemantics ticks, int time);

}  // namespace btcheck
