// SPDX-License-Identifier: MIT
//
// What the default report has found that is worth a look.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"
#include "trace/formats/text.hpp"

namespace btcheck {

enum class FindingKind : std::uint8_t {
  NeverTicked,
  NeverSucceeds,  // a Parallel
  AlwaysTrue,     // an Eval
  NeverTrue,
  StaleGuards,
  LeftRunning
};

struct DefaultFinding {
  FindingKind kind{};
  NodeId node{};               // StaleGuards: the action, LeftRunning: the leaf
  std::vector<NodeId> others;  // the guards; the node above that has decided
  std::string text;            // a sentence without its full stop
  const KeptRun* run = nullptr;  // that shows it, in the report; may be null
};

// Nodes of no use in pre-order, then guards that go stale, then nodes that are
// left running.
std::vector<DefaultFinding> default_findings(const BehaviorTree& tree,
                                             const CheckedFile& file);

// Nodes of no use, guards that go stale, and nodes left running, each under a
// heading; "" where there are none. Of the last two the runs that show them
// are told as well where `detail` asks for every step.
std::string findings_text(const BehaviorTree& tree, const CheckedFile& file,
                          Detail detail);

// What a question about the tree as a whole asks: "it is never stuck".
std::string_view words_of(TreeQuestion question);
// Its answer: "yes", "NO, see below".
std::string answer_text(const CheckResult& result, const CheckedFile& file,
                        const TreeReport& answer);
// True when it is a question at all for a node of this type.
bool can_be_asked(const Network& network, NodeId node, std::size_t question);

// "e.g. in tick 3", "e.g. at time 3", with what is to stand before it; ""
// where no time passes.
std::string when_text(std::string_view before, TickSemantics ticks, int time);

}  // namespace btcheck
