// SPDX-License-Identifier: MIT
//
// Reports for other programs: JSON, SARIF, JUnit XML, GitHub Actions, GitLab.
// And the result of each tree in a word and in numbers: for the table of a
// batch, its page and the summary of a job.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "report/formats/reported.hpp"
#include "report/text/report.hpp"

namespace btcheck {

struct SpaceReport;
struct SpaceContext;

// What a name means in JSON never changes; new names may come. docs/reports.md
inline constexpr std::string_view kJsonSchema = "btcheck/1";

// One object. What differs between two runs of the same check stands under
// `timing`.
std::string json_text(const Report& report);

// The lines of a check that is done: `start`, its `diagnostic`s, `verdict`s,
// `answer`s, `node`s and `finding`s, then `end`. Of a batch: `batch`, for each
// entry an `entry` with the same lines after it, then `end`.
std::string json_lines(const Report& report);

// The same lines in pieces, as a check goes on.
std::string json_start_line(const std::string& tree,
                            const std::vector<std::string>& properties);
std::string json_progress_line(const SearchProgress& progress, double seconds);
std::string json_result_lines(const Report& report);
std::string json_batch_line(std::size_t entries);
std::string json_tree_lines(const Report& report, const ReportedTree& tree);
std::string json_end_line(const Report& report);

// The figures of a state space: one object on one line. Figures are numbers,
// `stopped` is null or a word.
std::string space_json(const SpaceReport& report, const SpaceContext& context);

// Findings for code scanning: SARIF 2.1.0, with the runs as code flows. A code
// flow has no more steps than GitHub shows; of a longer run the middle is left
// out.
inline constexpr std::size_t kMostFlowSteps = 1000;
std::string sarif_text(const Report& report);

// Findings as GitLab's code quality report, whose widget compares a merge
// request with its target: what the exit code counts is of severity "major".
std::string gitlab_text(const Report& report);

// JUnit XML: a suite for each tree, a case for each property, or for each
// question of the default report about the tree as a whole, and for each
// finding. A case has failed when the verdict was not expected or the finding
// is an error, is skipped when undecided, and is an error when the mistake is
// ours or an input cannot be checked. One search answers many properties: its
// time is divided evenly among all.
std::string junit_text(const Report& report);

// Findings as workflow commands of GitHub Actions, which annotate a change.
// GitHub shows so many errors, warnings and notices of a step; the others are
// counted.
inline constexpr std::size_t kMostAnnotations = 10;
std::string github_text(const Report& report);

// The page that GitHub shows of a job, in Markdown: what somebody should look
// at, then, folded, what else was found and a table of all trees.
std::string job_summary_text(const Report& report);

// The first five are those of ExitCode, in its order.
enum class TreeOutcome : std::uint8_t {
  Met,        // every property is as expected
  Missed,     // some is not, or a finding is an error
  Broken,     // an input is wrong: nothing was checked
  Undecided,  // a limit was reached
  Failed,     // an internal error of btcheck
  NotRun,     // the batch ended before its turn
  NoFault,    // there is no property, and no fault
  Fault       // there is no property: a fault, or a finding that is an error
};
inline constexpr std::size_t kOutcomeCount = 8;

// MET, MISSED, BROKEN, UNDECIDED, FAILED, NOT RUN, NO FAULT, FAULT.
std::string_view word_of(TreeOutcome outcome);
// Met or NoFault.
bool is_good(TreeOutcome outcome);
// The tree was checked without any property.
bool has_no_rules(const ReportedTree& tree);

TreeOutcome outcome_of(const ReportedTree& tree);

// The properties of a tree, or the questions of its default report: a question
// counts as violated if its answer is a fault, else as one that holds.
struct PropertyCounts {
  std::size_t all = 0;
  std::size_t holds = 0;
  std::size_t violated = 0;
  std::size_t undecided = 0;
  std::size_t missed = 0;  // not as expected
};
PropertyCounts properties_of(const ReportedTree& tree);

// How many trees have each outcome.
using OutcomeCounts = std::array<std::size_t, kOutcomeCount>;
OutcomeCounts outcomes_of(const Report& report);

// The word for an answer of the default report: FINE, FAULT, UNDECIDED.
std::string_view word_of(const ReportedAnswer& answer);

// What the user has said of each tree's findings.
std::vector<const Judged*> judged_of(const Report& report);

// The findings of all trees that are not told.
JudgedCount count_of(const Report& report);

// "200 entries: 190 met, 10 broken; 10 errors, 3 warnings, 1 note".
std::string sum_of(const Report& report);

// How many of these findings there are of each level: "1 error, 2 warnings", ""
// for none.
std::string levels_text(const std::vector<Finding>& findings);

// Why a tree is not met: one reason.
struct Shortfall {
  std::string word = {};  // "VIOLATED", "FAULT", "UNDECIDED", "error[BT1003]"
  std::string name = {};  // of the property; "" for a mistake in an input
  std::string text = {};  // how it came about, or what is wrong
  std::string title = {};
  std::string told = {};  // the run as text; "" for none
  std::string page = {};  // the file in which a browser shows it; "" for none
};
std::vector<Shortfall> shortfalls_of(const ReportedTree& tree);

// Those of them that are verdicts of properties. What one limit leaves open is
// one of them, unless each is asked for.
enum class OpenRules : std::uint8_t { Together, Each };
std::vector<Shortfall> missed_rules(const ReportedTree& tree, OpenRules open);

}  // namespace btcheck
