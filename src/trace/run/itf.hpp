// SPDX-License-Identifier: MIT
//
// A run as JSON: in the Informal Trace Format, the machine's copy of a
// counterexample; and for the user's own executor, as test nodes for
// BehaviorTree.CPP 4.
#pragma once

#include <string>
#include <string_view>

#include "text/diagnostic.hpp"
#include "text/json.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// JSON as Apalache's ADR 015 describes it: `vars`, `states`, and `loop` when
// the run is infinite. Tool, tree with its text, property and the table of
// nodes stand in the top `#meta`. Each state has `time`, `tick`, `step` (what
// led to it), `event` (the same in words), `chosen`, `status`, `location` and
// `phase` (records by unique node name), `variables`, and `atoms` (the truth of
// the property's parts, named in the top `#meta`). `loop` is the number of the
// state that the last one returns to, by the step that stands in the last one's
// `#meta` as `back`; there is also the `mover`, and the nodes that are `stale`.
std::string itf_text(const RecordedRun& run);

// Reads what itf_text writes. `name` is the file's, for diagnostics.
Result<RecordedRun> read_itf(std::string_view name, std::string_view text);

// Parts of it that other formats have as well: the value of a variable in a
// state, a number where the variable is one; the texts of the included files by
// their names; and the step back.
Json value_of(const RecordedRun& run, const RecordedState& state,
              std::size_t variable);
Json included_texts(const RecordedRun& run);
Json step_back(const RecordedRun& run);

// JSON for BehaviorTreeFactory::loadSubstitutionRuleFromJSON. Each leaf that
// the run ticks is replaced, by its name, with a test node that answers what it
// answered in the run, in that order, and on in its loop.
//
//   TestNodeConfigs     by the name of the leaf. A leaf that always answers the
//                       same has a return_status alone. Else a script (4.10)
//                       chooses by a counter on the blackboard.
//   SubstitutionRules   by the name of the leaf
//   Blackboard          counters: to be set on tree.rootBlackboard() before the
//                       first tick (BehaviorTree.CPP itself skips this member)
//   Notes               sentences: what a test node cannot repeat, and why
//
// A node that answers running first does so for one millisecond, so that ticks
// must be further apart than that.
std::string substitution_text(const RecordedRun& run);

}  // namespace btcheck
