// SPDX-License-Identifier: MIT
//
// The faults of a tree in whole, with the run of each: what files are made of.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "check/whatif/whatif.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// A result, and what it was made of. All must outlive it.
struct WhatIfReport {
  const TreeInput& file;
  const WhatIfInput& input;
  const WhatIf& result;
  TickSemantics ticks = TickSemantics::Root;
  std::string only = {};  // the node below which leaves have faults
  std::vector<std::string> runs = {};  // by row: the file of its run, "" none

  const BehaviorTree& tree() const { return input.tree; }
};

// Rows have numbers from 1: first those of single faults, then the pairs.
std::size_t row_count(const WhatIf& result);
const FaultRow& row_numbered(const WhatIf& result, std::size_t number);

// The run that shows it; nothing where a row has none.
std::optional<RecordedRun> run_of_row(const WhatIfReport& report,
                                      std::size_t number);

// "17.FollowPath.fails-once", a part of the name of a file.
std::string run_name(const WhatIfReport& report, std::size_t number);

}  // namespace btcheck
