// SPDX-License-Identifier: MIT
//
// A result beside an earlier one of the same mission: what has become worse.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "report/exit_code.hpp"
#include "report/whatif/runs.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// What is known of a fault, or of a pair.
struct EarlierFault {
  std::string by_name;  // "land fails-once", by the names of its leaves
  Harm harm = Harm::Undecided;
  std::vector<std::string> more;  // rules broken, leaves left running or on
};

struct EarlierResult {
  std::string file;
  int order = 1;
  std::string others;
  int late = 0;
  std::vector<std::string> kinds;  // empty: all
  bool is_part = false;            // of the faults of some leaves only
  std::map<std::string, EarlierFault, std::less<>> faults;  // by their paths
};

// What what_if_json has written; BT1515 for any other text.
Result<EarlierResult> read_earlier(const std::string& name,
                                   std::string_view text);

// What is otherwise now, as lines, and what that comes to.
struct WhatIfChange {
  std::string text;
  std::size_t worse = 0;   // or new, and bad
  std::size_t better = 0;  // or gone
  std::size_t open = 0;    // not decided now
};
WhatIfChange change_since(const EarlierResult& before,
                          const WhatIfReport& report);

ExitCode exit_code_of(const WhatIf& result, const WhatIfChange& change);

}  // namespace btcheck
