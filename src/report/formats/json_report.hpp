// SPDX-License-Identifier: MIT
//
// Results for programs: one JSON object, or one for each line as things happen.
// What a name means never changes; new names may come. docs/reports.md
#pragma once

#include <string>
#include <vector>

#include "report/formats/reported.hpp"

namespace btcheck {

inline constexpr std::string_view kJsonSchema = "btcheck/1";

// One object. What differs between two runs of the same check stands under
// `timing`.
std::string json_text(const Report& report);

// The lines of a check that is done: `start`, its `diagnostic`s, `verdict`s,
// `answer`s, `node`s and `finding`s, then `end`. Of a batch: `batch`, for each
// entry an `entry` with the same lines after it, then `end`.
std::string json_lines(const Report& report);

// The same in pieces, for who reads along.
std::string json_start_line(const std::string& tree,
                            const std::vector<std::string>& properties);
std::string json_progress_line(const SearchProgress& progress, double seconds);
std::string json_result_lines(const Report& report);
std::string json_batch_line(std::size_t entries);
std::string json_tree_lines(const Report& report, const ReportedTree& tree);
std::string json_end_line(const Report& report);

}  // namespace btcheck
