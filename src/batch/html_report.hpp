// SPDX-License-Identifier: MIT
//
// A batch as one page for the browser.
#pragma once

#include <string>

#include "report/formats/reported.hpp"

namespace btcheck {

// The page that is to be written to `file`, as the user names it: links to the
// pages of runs and to trees are made from there. It opens from disk, asks for
// nothing from anywhere, and says all without its script.
std::string html_report(const Report& report, const std::string& file);

}  // namespace btcheck
