// SPDX-License-Identifier: MIT
//
// What breaks, as a table for people.
#pragma once

#include <string>

#include "check/whatif/whatif.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// "FollowPath fails once", "FollowPath fails once and Spin never ends".
std::string faults_text(const BehaviorTree& tree, const FaultRow& row);
// "never ends", "breaks the rule `landing`".
std::string harm_text(const BehaviorTree& tree, const WhatIf& result,
                      const FaultRow& row);
// Who notices, and when: "`Navigate` fails, 3 ticks later"; "nobody".
std::string notice_text(const BehaviorTree& tree, const FaultRow& row);
// How it gets on: "caught by `Retry`, through `Spin`"; "" where it does not.
std::string recovery_text(const BehaviorTree& tree, const FaultRow& row);
// "the mission fails".
std::string event_text(const WhatIf& result, const TopEvent& event);

// The line that sums up: "of 126 single faults 118 are survived or reported;
// …".
std::string score_text(const Score& score);

struct TableChoices {
  bool tells_all = false;  // else of what is survived only how many
};
std::string what_if_text(const BehaviorTree& tree, const WhatIf& result,
                         const TableChoices& choices);

}  // namespace btcheck
