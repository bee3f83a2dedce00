// SPDX-License-Identifier: MIT
//
// The runs of single faults, as leaves can be made to play them.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "check/whatif/whatif.hpp"
#include "suites/forced_network.hpp"
#include "suites/suite.hpp"

namespace btcheck {

struct FaultRuns {
  std::vector<NamedRun> runs;  // in the forced network
  std::size_t shown = 0;       // faults that have one
  // Those that have none, by the reason: "dock throws".
  std::map<std::string, std::vector<std::string>> left_out;
};

// Of each row the run that shows it, where leaves that answer so make the tree
// do the same. One run stands for all faults that it shows.
FaultRuns fault_runs(const ForcedNetwork& forced, const WhatIfInput& input,
                     const WhatIf& result, TickSemantics ticks);

// "51 of 83 single faults have a test; left out by name: …", in lines.
std::string faults_summary(const FaultRuns& runs);

}  // namespace btcheck
