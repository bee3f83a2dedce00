// SPDX-License-Identifier: MIT
//
// A tree's results as a line of text, and back: all of them, so that every
// report made of what was read is the report made of what was written.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "report/formats/reported.hpp"

namespace btcheck {

// One line without its end. Bytes that are no UTF-8 are replaced.
std::string kept_text(const ReportedTree& tree);

// Nothing for a text that kept_text of this version does not write.
std::optional<ReportedTree> tree_from(std::string_view text);

}  // namespace btcheck
