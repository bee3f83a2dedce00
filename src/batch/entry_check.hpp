// SPDX-License-Identifier: MIT
//
// One entry of a batch, from its files to what there is to report.
#pragma once

#include <string>

#include "batch/entries/entries.hpp"
#include "check/check.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/options/options.hpp"
#include "report/formats/reported.hpp"

namespace btcheck {

// The result of an entry that cannot be checked: what is wrong with it.
ReportedTree broken_tree(const BatchEntry& entry,
                         std::vector<Diagnostic> diagnostics);

// The result of one that was not begun, or not ended, and why.
ReportedTree unrun_tree(const BatchEntry& entry, std::string reason);

// The same for the same inputs, options and version of btcheck. The number of
// threads and the limit of memory are not part of it. `options` are those of
// the entry.
std::string key_of(const BatchEntry& entry, const Inputs& inputs,
                   const Options& options);

// Checks it, with the expectations of the entry. Runs are written where
// `options` say, to a folder of the entry's own. Never throws.
ReportedTree checked_tree(const BatchEntry& entry, const Inputs& inputs,
                          const Options& options, const Limits& limits);

// False for results that may differ the next time, though nothing has changed:
// out of memory, interrupted, an internal error.
bool may_be_kept(const ReportedTree& tree);
// False when a page of a run is no longer there.
bool has_all_pages(const ReportedTree& tree);

}  // namespace btcheck
