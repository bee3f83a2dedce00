// SPDX-License-Identifier: MIT
//
// A batch as a table for a terminal, and as a page for the browser.
#pragma once

#include <string>
#include <string_view>

#include "report/formats/reported.hpp"

namespace btcheck {

// A line for each entry, then what is not as expected. In pieces, since the
// table is printed as it grows: its heading, the line of an entry, and what
// comes after the last one.
std::string batch_heading();
std::string batch_line(const ReportedTree& tree);
std::string batch_ending(const Report& report);

// All of it.
std::string batch_text(const Report& report);

// The page that is to be written to `file`, as the user names it: links to the
// pages of runs and to trees are made from there. It opens from disk, asks for
// nothing from anywhere, and says all without its script.
std::string html_report(const Report& report, const std::string& file);

// The page's form, style sheet and script, compiled in from page/.
extern const std::string_view kBatchPage;
extern const std::string_view kBatchStyle;
extern const std::string_view kBatchScript;

}  // namespace btcheck
