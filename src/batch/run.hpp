// SPDX-License-Identifier: MIT
//
// The entries of a batch, checked several at a time and told in order.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "batch/entries/entry.hpp"
#include "batch/kept/kept_results.hpp"
#include "batch/progress.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/options/options.hpp"
#include "report/formats/reported.hpp"

namespace btcheck {

// Which entries are told, and what is told of each, depends neither on the
// number of jobs nor on which is done first. With --fail-fast those behind the
// first that fails are not run, even where one of them was done already; an
// interrupt leaves out what is not done.
class BatchRun {
 public:
  // Called with each tree as soon as those before it are told; by one thread at
  // a time, with no line of progress in the way.
  using Listener = std::function<void(const ReportedTree&)>;

  // `options` with max_bytes and threads as each entry gets them.
  BatchRun(const Options& options, const std::vector<BatchEntry>& entries,
           KeptResults& kept, Listener listener);

  // The trees, one for each entry.
  std::vector<ReportedTree> run();

  std::size_t resumed() const { return resumed_; }  // taken from what was kept
  double seconds() const { return progress_.seconds(); }

 private:
  void work(std::size_t entry);
  std::optional<ReportedTree> result_of(std::size_t entry);
  std::optional<ReportedTree> checked(std::size_t entry, const Inputs& inputs,
                                      const Options& options);
  void finish(std::size_t entry, ReportedTree tree);
  void tell(ReportedTree tree);
  bool is_cancelled(std::size_t entry) const;

  const Options& options_;
  const std::vector<BatchEntry>& entries_;
  KeptResults& kept_;
  Listener listener_;
  BatchProgress progress_;
  std::atomic<std::size_t> resumed_ = 0;
  std::atomic<std::size_t> last_;  // no entry behind this one is run
  std::mutex mutex_;               // of what follows
  std::vector<std::optional<ReportedTree>> done_;
  std::vector<ReportedTree> told_;
};

}  // namespace btcheck
