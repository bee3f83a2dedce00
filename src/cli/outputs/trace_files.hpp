// SPDX-License-Identifier: MIT
//
// Runs as files, for --trace-dir.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "check/check.hpp"

namespace btcheck {

// Writes each run of the results to `directory`, which is made if need be, as
// TREE.PROPERTY.itf.json, and as TREE.PROPERTY.html for the browser. `source`
// is the text of the tree's file. Runs for which a limit leaves no time are
// left out. Those that show a mistake come first; once kMostNodeBytes are
// written, the default report's witnesses for single nodes are left out, too.
inline constexpr std::size_t kMostNodeBytes = std::size_t{64} << 20;
struct WrittenTraces {
  std::string complaint;     // what went wrong, or ""
  std::size_t left_out = 0;  // runs, for want of time
  std::size_t too_many = 0;  // runs of single nodes
};
WrittenTraces write_traces(const std::string& directory,
                           const CheckResult& result, const CheckedFile& file,
                           const std::string& source, const Limits& limits);

// Where write_traces puts the page of a run, by the name of its property or by
// that of a question about the tree as a whole.
std::string trace_page(const std::string& directory,
                       const std::string& tree_file, std::string_view name);
std::string_view trace_name(TreeQuestion question);

}  // namespace btcheck
