// SPDX-License-Identifier: MIT
//
// Repairs that are checked: what a kind of findings proposes is made in the
// texts in memory, and all is checked again.
#pragma once

#include <vector>

#include "check/check.hpp"

namespace btcheck {

// `check`, and then a repair beside each finding and warning that has one which
// helps: the finding is gone, no other finding or fault is there, and no rule
// that held breaks. Where the search was not complete there is none. It takes a
// small multiple of the states that the check has searched, at most, and half
// of the time and memory that are allowed for all.
CheckResult check_and_repair(const TreeInput& tree,
                             const std::vector<InputFile>& properties,
                             const CheckOptions& options);

// The second half of it, with what the first has made of the same inputs.
void add_repairs(const TreeInput& tree,
                 const std::vector<InputFile>& properties,
                 const CheckOptions& options, CheckResult& result);

}  // namespace btcheck
