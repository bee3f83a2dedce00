// SPDX-License-Identifier: MIT
//
// What is said of a fault, of what it does, and of the mission.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/whatif/whatif.hpp"
#include "model/tree/tree.hpp"
#include "report/exit_code.hpp"

namespace btcheck {

// "`land@23`".
std::string name_in_text(const BehaviorTree& tree, NodeId node);
// "`a`, `b` and `c`"; of more than `most`, "`a`, `b` and 7 more".
std::string names_in_text(const BehaviorTree& tree,
                          const std::vector<NodeId>& nodes, std::size_t most);

// "fails whenever it is asked, once, or from some tick on".
std::string kinds_text(std::span<const FaultKind> kinds);
// "fails, fails-once".
std::string kind_words(std::span<const FaultKind> kinds);

// "FollowPath fails once", "FollowPath fails once and Spin never ends".
std::string faults_text(const BehaviorTree& tree, const FaultRow& row);
// What becomes of the mission, in a sentence without its subject: "never ends",
// "breaks the rule `landing`".
std::string harm_text(const BehaviorTree& tree, const WhatIf& result,
                      const FaultRow& row);
// Who notices, and when: "`Navigate` fails, 3 ticks later"; "nobody".
std::string notice_text(const BehaviorTree& tree, const FaultRow& row);
// What a node does then: "fails", "is halted".
std::string_view does(Happening what);
// "success" of a notice.
std::string_view answer_word(Happening what);
// How it gets on: "caught by `Retry`, through `Spin`"; "" where it does not.
std::string recovery_text(const BehaviorTree& tree, const FaultRow& row);
// "the mission fails".
std::string event_text(const WhatIf& result, const TopEvent& event);
// What the mission does then, as a heading has it.
std::string_view heading_of(Harm harm);

// "success", "failure", "exception", "no end": what an Effect allows.
std::vector<std::string_view> outcomes_of(const Effect& effect);

// The names of the rules that an effect breaks.
std::vector<std::string> broken_rules(const WhatIf& result,
                                      const Effect& effect);

// What the mission does without a fault, and what is assumed.
std::string healthy_text(const WhatIf& result);

// The line that sums up: "of 126 single faults 118 are survived or reported;
// …".
std::string score_text(const Score& score);

// The parts of the mission that have a score of their own: subtrees; where
// there are none, the children of the first node that has several.
std::vector<NodeId> scored_parts(const BehaviorTree& tree);

// A fault of this harm is nothing that a mission should do: silent, without an
// end, against a rule, something left on.
constexpr bool is_bad(Harm harm) { return harm <= Harm::LeftOn; }

// 1 for a single fault that is bad, 3 for what is not decided, 4 for a mistake
// of ours.
ExitCode exit_code_of(const WhatIf& result);

}  // namespace btcheck
