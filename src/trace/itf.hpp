// SPDX-License-Identifier: MIT
//
// A run in the Informal Trace Format: the machine's copy of a counterexample.
#pragma once

#include <string>

#include "check/verdict.hpp"
#include "model/network.hpp"
#include "model/tree.hpp"

namespace btcheck {

// What is told of the run beside its states.
struct RunHeading {
  std::string property;  // its name
  std::string formula;   // its text
  std::string verdict;   // HOLDS, VIOLATED
};

// JSON as Apalache's ADR 015 describes it: `vars`, `states`, and `loop` when
// the run is infinite. Tool, tree, property and the table of nodes stand in
// the top `#meta`. Each state has `time`, `step` (what led to it), `status`
// and `location` (records by unique node name) and `variables`. `loop` is the
// number of the state that the last one returns to, by the step that stands in
// the last one's `#meta` as `back`.
std::string itf_text(const BehaviorTree& tree, const Network& network,
                     const Run& run, const RunHeading& heading);

}  // namespace btcheck
