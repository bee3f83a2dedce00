// SPDX-License-Identifier: MIT
//
// Results are written to standard output and to files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"
#include "cli/options/options.hpp"
#include "report/formats/reported.hpp"
#include "trace/formats/text.hpp"

namespace btcheck {

// How much is told, and how wide. A report in a file is the same on every
// terminal.
Layout layout_of(const Options& options);

// Results as the text that people read, "" where nothing was checked.
std::string text_report(const CheckResult& result, Layout layout);

// Why the files of reports and of a baseline cannot be written, as far as can
// be told before anything is checked; "" when nothing is in the way.
std::string obstacle_to(const Options& options);
std::string obstacle_to(const std::string& file);

// A report without trees yet, with the time and the folder, of a check that has
// taken so many seconds.
Report new_report(double seconds);

// Prints and writes a report in each of the formats; `text` is what people
// read, harmless, on a terminal in colours. Returns what went wrong, or "".
std::string write_report(const Options& options,
                         const std::vector<ReportTarget>& targets,
                         const Report& report, const std::string& text);

// Adds the report to the page of a job, where GitHub says that there is one,
// with pictures of runs that are kept. Returns what went wrong, or "".
std::string add_job_summary(const Report& report);

// A check that is done: the tree as the user calls it, and what it took.
struct CheckCost {
  std::string tree;
  ExitCode code = ExitCode::Met;
  double seconds = 0;
  std::uint64_t peak_bytes = 0;
};

// Prints and writes results in every format that is asked for. Returns what
// went wrong, or "".
std::string write_reports(const Options& options, const CheckResult& result,
                          Layout layout, const CheckCost& cost);

// True when lines for programs are printed while a check goes on. The first of
// these lines, where they are printed, and one in between.
bool prints_lines(const std::vector<ReportTarget>& targets);
void print_start(const std::vector<ReportTarget>& targets,
                 const std::string& tree,
                 const std::vector<std::string>& properties);
void print_progress(const SearchProgress& progress, double seconds);

// --- Runs as files, for --trace-dir --------------------------------------

// Writes a run to the directory, which is made if need be, as ITF JSON and as a
// page. Returns what went wrong, or "".
std::string write_trace(const std::string& directory,
                        const std::string& tree_file, std::string_view name,
                        const RecordedRun& run);

// Writes runs of the results to `directory`, which is made if need be, as
// TREE.NAME.itf.json, and as TREE.NAME.html for the browser: that of each rule,
// by the rule's name, and that of each finding (trace_names), the most serious
// first, and of no more than kMostFindings. Runs for which a limit leaves no
// time are left out.
//
// A page tells a long run by what changes, ITF by all that there is in each
// state: of a run that would take more bytes of it than these only the page is
// written.
inline constexpr std::size_t kMostFindings = 50;
inline constexpr std::size_t kMostStateBytes = std::size_t{8} << 20;
inline constexpr std::size_t kMostAskedBytes = std::size_t{64} << 20;
struct WrittenTraces {
  std::string complaint;           // what went wrong, or ""
  std::vector<std::string> names;  // of the runs that are written
  std::size_t left_out = 0;        // runs, for want of time
  std::size_t too_many = 0;        // runs of findings beyond kMostFindings
  std::size_t pages_alone = 0;     // of them no ITF is written

  void add(WrittenTraces more);
  // What is left out, in lines; "" for nothing.
  std::string omissions(const std::string& directory) const;
};
WrittenTraces write_traces(const std::string& directory,
                           const CheckResult& result, const CheckedFile& file,
                           const TreeInput& input, const Limits& limits);

// Where write_traces puts the page of a run, by the name of it.
std::string trace_page(const std::string& directory,
                       const std::string& tree_file, std::string_view name);

}  // namespace btcheck
