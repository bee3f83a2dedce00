// SPDX-License-Identifier: MIT
//
// What is found of an entry, as it is kept and as workers hand it over.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "report/formats/reported.hpp"

namespace btcheck {

// A tree's results as one line of text, without its end, and back. Nothing is
// lost: a report made of what was read is the report made of what was written.
// Bytes that are no UTF-8 are replaced.
std::string kept_text(const ReportedTree& tree);
// Nothing for a text that kept_text of this version does not write.
std::optional<ReportedTree> tree_from(std::string_view text);

// False for results that may differ the next time, though nothing has changed:
// out of memory, interrupted, an internal error.
bool may_be_kept(const ReportedTree& tree);

// Forgets the pages of runs that are no longer there; true if there were any.
bool drop_lost_pages(ReportedTree& tree);

}  // namespace btcheck
