// SPDX-License-Identifier: MIT
//
// The report on a tree without a property file: the mission as a whole, a table
// of its nodes, and what is worth a look.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"
#include "trace/formats/text.hpp"

namespace btcheck {

// All of it; with Detail::EveryStep also the runs of what is worth a look.
std::string defaults_text(const CheckResult& result, const CheckedFile& file,
                          Detail detail);

// A question about the tree as a whole, in words.
struct QuestionWords {
  std::string_view key;    // "can_succeed"
  std::string_view words;  // "the mission can succeed"
  std::string_view code;   // of the finding that it is not so; "" for none
};
const QuestionWords& words_of(TreeQuestion question);
// Its answer: "yes", "NO, see below".
std::string answer_text(const CheckResult& result, const CheckedFile& file,
                        const TreeReport& answer);
// False where a node of this type can never do what the question asks.
bool can_be_asked(const Network& network, NodeId node, std::size_t question);

// Something worth a look. It is no fault: a tree may well be meant that way.
struct DefaultFinding {
  std::string_view code;         // "BT2205"
  NodeId node{};                 // stale guards: the action
  std::vector<NodeId> others;    // the guards; the node above that has decided
  std::string text;              // a sentence without its full stop
  const KeptRun* run = nullptr;  // that shows it, in the report; may be null
};

// Useless nodes in pre-order, then guards that go stale, then nodes that are
// left running.
std::vector<DefaultFinding> default_findings(const BehaviorTree& tree,
                                             const CheckedFile& file);

// The findings as text, each kind under a heading; "" where there are none.
std::string findings_text(const BehaviorTree& tree, const CheckedFile& file,
                          Detail detail);

// "in tick 3" or "at time 3", after `before`; "" where no time passes.
std::string when_text(std::string_view before, TickSemantics ticks, int time);

}  // namespace btcheck
