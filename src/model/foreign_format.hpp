// SPDX-License-Identifier: MIT
//
// Files of other tools: named in one line instead of being read as a tree that
// they are not.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "text/diagnostic.hpp"

namespace btcheck {

// What stands behind a byte order mark and blanks.
std::string_view without_blanks(std::string_view text);

// BT1652 where the file is of a format that is known and not read: by what
// stands in it, else by its name. Nothing for what may be a tree, faults and
// all: XML with another root than SCXML's, and what begins with a parenthesis.
std::optional<Diagnostic> refusal_of_foreign(const std::string& name,
                                             std::string_view text);

}  // namespace btcheck
