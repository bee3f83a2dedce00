// SPDX-License-Identifier: MIT
//
// Trees and their property files, found in a folder and all folders below it.
#pragma once

#include <string>
#include <vector>

#include "batch/entries/entry.hpp"

namespace btcheck {

// An entry for each property file (.ltl, .btp), and one with the default report
// for each tree (.btf) that none of them is about. A property file is about the
// tree that its `tree "…"` line names, else about the one beside it that has
// its name. Ascending by the names of the files.
//
// What begins with a dot is passed over, folders that are links too, and what
// is one of `exclude`: a file or a folder, relative to `folder`. A folder that
// cannot be read is an entry with a diagnostic (BT0002), and so is one in which
// nothing is found (BT1507).
std::vector<BatchEntry> entries_in(const std::string& folder,
                                   const std::vector<std::string>& exclude);

}  // namespace btcheck
