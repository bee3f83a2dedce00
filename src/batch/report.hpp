// SPDX-License-Identifier: MIT
//
// A batch as a table for a terminal, and as a page for the browser.
#pragma once

#include <string>
#include <string_view>

#include "report/formats/formats.hpp"
#include "report/formats/reported.hpp"
#include "trace/formats/text.hpp"

namespace btcheck {

// A line for each entry with its findings below, the worst first: the first
// kMostBelow, each in a sentence, or with Detail::EveryStep all, as the check
// of one tree tells them. Then the verdicts that are not as expected. In
// pieces, since the table is printed as it grows: its heading, the lines of an
// entry, and what comes after the last one.
inline constexpr std::size_t kMostBelow = 5;
std::string batch_heading();
std::string batch_lines(const ReportedTree& tree, Layout layout);
std::string batch_ending(const Report& report, Layout layout);

// One finding as a line below its entry, and a rule that is not met as it is
// told behind the last entry.
std::string finding_line(const ReportedTree& tree, const Finding& finding,
                         std::size_t width);
std::string shortfall_text(const Shortfall& found, std::size_t width);

// All of it.
std::string batch_text(const Report& report, Layout layout);

// How many notes on the inputs of a tree stand nowhere in its lines.
std::size_t notes_left_out(const ReportedTree& tree, Layout layout);

// The page that is to be written to `file`, as the user names it: links to the
// pages of runs and to trees are made from there. It opens from disk, asks for
// nothing from anywhere, and says all without its script.
std::string html_report(const Report& report, const std::string& file);

// The page's form, style sheet and script, compiled in from page/.
extern const std::string_view kBatchPage;
extern const std::string_view kBatchStyle;
extern const std::string_view kBatchScript;

}  // namespace btcheck
