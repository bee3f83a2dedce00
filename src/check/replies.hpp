// SPDX-License-Identifier: MIT
//
// What can be answered to a question of the findings, and where the answer is
// kept: in contracts of leaves, so that it holds in every tree that has them;
// or in a comment at the node, where no leaf of the program is concerned.
#pragma once

#include <string>
#include <vector>

#include "check/findings/suspicion.hpp"
#include "model/edits/contract_text.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

struct QuestionReply {
  std::string words;                // "that may be cut off"
  std::vector<LeafClause> clauses;  // none: the comment `allowing`
};

// The first is what the tree does; where there is a second one, the tree does
// what it forbids. Empty for what is no question.
std::vector<QuestionReply> replies_to(const BehaviorTree& tree,
                                      const TreeFinding& question);

// The text of a file of contracts that says it, too.
std::string with_reply(std::string text, const QuestionReply& reply);

// "btcheck: allow BT2504", which a comment at the node says.
std::string allowing(const TreeFinding& question);

}  // namespace btcheck
