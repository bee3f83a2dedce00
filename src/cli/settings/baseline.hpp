// SPDX-License-Identifier: MIT
//
// A baseline: the findings that are known, as a file to be kept beside the
// trees. It has no numbers of lines, and one finding on each of its own, so
// that it changes where the findings change. Files are named from its folder.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "check/findings/judgement.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// The findings of a baseline; BT1511 for any other text. `name` is relative to
// `directory`, which is absolute; so are the files of what is returned.
Result<std::vector<KnownFinding>> read_baseline(const std::string& directory,
                                                const std::string& name,
                                                std::string_view text);

// The text of one, to be written as `name`. Its files are as `placed` has them.
std::string baseline_text(const std::string& directory, const std::string& name,
                          const std::vector<KnownFinding>& findings);

// What becomes of a baseline with the trees of one command.
struct BaselineChange {
  std::vector<KnownFinding> now;  // what is found, and what was not looked for
  std::size_t gone = 0;           // entries that occur no more, or less often
};
BaselineChange change_of(const Judgement& said,
                         const std::vector<const Judged*>& trees);

}  // namespace btcheck
