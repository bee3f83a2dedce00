// SPDX-License-Identifier: MIT
//
// The entries of a batch, checked several at a time and told in order.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "batch/entries/entries.hpp"
#include "batch/results/kept_results.hpp"
#include "check/check.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/looked_at.hpp"
#include "cli/options/options.hpp"
#include "report/formats/reported.hpp"

namespace btcheck {

struct BatchRun {
  std::vector<ReportedTree> trees;  // one for each entry
  std::size_t resumed = 0;          // taken from what is kept
  double seconds = 0;
  // The names of entries that there is no result of, by the reason.
  std::map<std::string, std::vector<std::string>> missing;
  std::map<std::string, LookedAt> looked_at;  // by the names of entries
};

// What breaks a batch off before its end, other than an interrupt.
class BreakOff {
 public:
  virtual ~BreakOff() = default;
  // For poll(2): when to ask.
  virtual int number() const = 0;
  virtual bool is_wanted() = 0;
  // What has been looked at for an entry that takes longer than a moment.
  virtual void looks_at(const std::string& entry, const LookedAt& names) = 0;
};

// Checks all of them. `options` has max_bytes and threads as each entry gets
// them. `listener` is called with each tree as soon as those before it are
// told, with no line of progress in the way.
//
// Each entry is checked in a process of its own: one that is killed, for want
// of memory for instance, is undecided, and the others go on.
//
// Which entries are told, and what is told of each, depends neither on the
// number of jobs nor on which is done first. With --fail-fast those behind the
// first that fails are not run, even where one of them was done already; an
// interrupt leaves out what is not done.
//
// Of `kept` is taken what is there. What others hold is waited for, unless the
// options say otherwise, and checked here where they give it up. What took
// longest the last time is begun first, so that no long one is left for the
// end; with --fail-fast the first is.
//
// What is not done when it is broken off is told as not run.
BatchRun run_entries(const Options& options,
                     const std::vector<BatchEntry>& entries, KeptResults& kept,
                     std::function<void(const ReportedTree&)> listener,
                     BreakOff* break_off = nullptr);

// --- One entry, from its files to what there is to report ----------------

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
// `options` say, to a folder of the entry's own.
ReportedTree checked_tree(const BatchEntry& entry, const Inputs& inputs,
                          const Options& options, const Limits& limits);

}  // namespace btcheck
