// SPDX-License-Identifier: MIT
//
// What has become of the entries of a batch since they were told last, as text.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/options.hpp"
#include "report/formats/reported.hpp"
#include "trace/formats/text.hpp"

namespace btcheck {

// "-- 14:03:12  trees/dock.xml -----": when, and which files.
std::string round_heading(const std::string& time,
                          const std::vector<std::string>& files,
                          std::size_t width);

class ChangeTeller {
 public:
  // `saved` are the files that have changed. It must outlive this.
  ChangeTeller(const Options& options, Layout layout,
               const std::set<std::string>& saved)
      : is_verbose_(options.is_verbose), layout_(layout), saved_(saved) {}

  // All findings of an entry with the change since `before`, nullptr for one
  // that was not there: those that are gone in a line, the others as the check
  // of one tree tells them.
  std::string whole(const ReportedTree* before, const ReportedTree& now);
  // Of an entry whose own files have not changed: what is new, what is gone and
  // what stands in the files that have changed, but for what was told of
  // another entry; "" where that is nothing.
  std::string difference(const ReportedTree* before, const ReportedTree& now);

 private:
  struct Sorted;
  Sorted sorted(const ReportedTree* before, const ReportedTree& now) const;
  std::vector<Finding> shown(const ReportedTree& tree) const;
  bool stands_in_saved(const Finding& finding) const;
  std::string told(const ReportedTree& tree, const Finding& finding) const;
  template <class IsWanted>
  std::string part(std::string_view label, const ReportedTree& tree,
                   const std::vector<Finding>& findings,
                   const IsWanted& is_wanted);
  std::string gone_text(const ReportedTree* before, const Sorted& all) const;

  bool is_verbose_;
  Layout layout_;
  const std::set<std::string>& saved_;
  std::set<std::string> told_;  // findings, as texts
};

}  // namespace btcheck
