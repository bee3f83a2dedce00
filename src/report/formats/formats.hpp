// SPDX-License-Identifier: MIT
//
// Reports for other programs: JSON, SARIF, JUnit XML, GitHub Actions.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "report/formats/reported.hpp"

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

// JUnit XML: a suite for each tree, a case for each property, or for each
// question of the default report about the tree as a whole. A case has failed
// when the verdict was not expected, is skipped when undecided, and is an error
// when the mistake is ours or an input cannot be checked. One search answers
// many properties: its time is divided evenly among them.
std::string junit_text(const Report& report);

// Findings as workflow commands of GitHub Actions, which annotate a change.
// GitHub shows so many errors, warnings and notices of a step; the others are
// counted.
inline constexpr std::size_t kMostAnnotations = 10;
std::string github_text(const Report& report);

// The page that GitHub shows of a job, in Markdown: what somebody should look
// at, then a folded table of all trees.
std::string job_summary_text(const Report& report);

}  // namespace btcheck
