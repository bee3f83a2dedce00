// SPDX-License-Identifier: MIT
//
// The entries of a batch, checked several at a time and told in order.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "batch/entries/entries.hpp"
#include "batch/kept_results.hpp"
#include "cli/options/options.hpp"
#include "report/formats/reported.hpp"

namespace btcheck {

struct BatchRun {
  std::vector<ReportedTree> trees;  // one for each entry
  std::size_t resumed = 0;          // taken from an earlier run
  double seconds = 0;
};

// Checks all of them. `options` has max_bytes and threads as each entry gets
// them. `listener` is called with each tree as soon as those before it are
// told; by one thread at a time, with no line of progress in the way.
//
// Which entries are told, and what is told of each, depends neither on the
// number of jobs nor on which is done first. With --fail-fast those behind the
// first that fails are not run, even where one of them was done already; an
// interrupt leaves out what is not done.
BatchRun run_entries(const Options& options,
                     const std::vector<BatchEntry>& entries, KeptResults& kept,
                     std::function<void(const ReportedTree&)> listener);

}  // namespace btcheck
