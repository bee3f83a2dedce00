// SPDX-License-Identifier: MIT
#include "check/replies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "check/findings/facts.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

class RepliesTo {
 public:
  RepliesTo(const BehaviorTree& tree, const TreeFinding& question)
      : tree_(tree), question_(question) {}

  std::vector<QuestionReply> all() const {
    std::vector<QuestionReply> answers = by_contracts();
    std::erase_if(answers, [](const QuestionReply& each) {
      return each.clauses.empty();
    });
    if (answers.empty()) answers = {{"that is meant", {}}};
    return answers;
  }

 private:
  std::vector<QuestionReply> by_contracts() const {
    const std::string_view code = question_.code;
    const auto& others = question_.others;
    if (code == "BT2501") return of_guards();
    if (code == "BT2502") {
      return either("that may be cut off", "it may not be cut off",
                    "may-be-cut-off",
                    deeds({others.begin() + 1, others.end()}));
    }
    if (code == "BT2503" || code == "BT2507") {
      return either("nobody has to hear of the failure", "the failure matters",
                    "may-be-lost", deeds({failing()}));
    }
    if (code == "BT2505") return that_take_time();
    if (code == "BT2506") {
      return either("the work may be called off", "it may not be called off",
                    "may-be-cut-off", deeds({others.front()}));
    }
    if (code == "BT2508") {
      return either("done again is as good as done once", "that does harm",
                    "idempotent", first_deed(question_.node));
    }
    if (code == "BT2510") {
      return {{"it always answers at once",
               said("returns", returned(question_.node), {question_.node})}};
    }
    if (code == "BT2513") {
      return either("it may stay so", "it may not stay so", "may-stay",
                    {question_.node});
    }
    return {};
  }

  static constexpr std::string_view kNo = "no";

  std::vector<QuestionReply> either(std::string yes, std::string no,
                                    std::string_view keyword,
                                    const std::vector<NodeId>& leaves) const {
    return {{std::move(yes), said(keyword, "", leaves)},
            {std::move(no), said(keyword, kNo, leaves)}};
  }

  // Of each type once.
  std::vector<LeafClause> said(std::string_view keyword, std::string_view value,
                               const std::vector<NodeId>& leaves) const {
    std::vector<LeafClause> clauses;
    for (const NodeId leaf : leaves) {
      const auto name = name_of(leaf);
      if (!name) return {};  // no contract can be made
      const bool is_known = std::ranges::any_of(
          clauses, [&](const LeafClause& each) { return each.name == *name; });
      if (is_known) continue;
      clauses.push_back(
          {type_of(leaf), *name, std::string(keyword), std::string(value)});
    }
    return clauses;
  }

  // Of a leaf of the program.
  std::optional<std::string> name_of(NodeId leaf) const {
    const Node& node = tree_.node(leaf);
    const bool is_own =
        (node.type == NodeType::Action || node.type == NodeType::Condition) &&
        node.id != "AlwaysSuccess" && node.id != "AlwaysFailure";
    return is_own ? contract_name(node.id) : std::nullopt;
  }

  NodeType type_of(NodeId leaf) const {
    const Node& node = tree_.node(leaf);
    return is_taken_for_condition(node) ? NodeType::Condition : node.type;
  }

  // What is done below these nodes.
  std::vector<NodeId> deeds(const std::vector<NodeId>& nodes) const {
    std::vector<NodeId> found;
    for (const NodeId each : nodes) {
      NodeId last = each;
      while (!tree_.node(last).children.empty()) {
        last = tree_.node(last).children.back();
      }
      for (NodeId at = each; at <= last; at = NodeId{index(at) + 1}) {
        const bool does = name_of(at) && type_of(at) == NodeType::Action;
        if (does) found.push_back(at);
      }
    }
    return found;
  }

  std::vector<NodeId> first_deed(NodeId node) const {
    std::vector<NodeId> found = deeds({node});
    if (found.size() > 1) found.resize(1);
    return found;
  }

  // What fails, of a failure that is lost: the child of the decorator, or what
  // a branch does about its condition.
  NodeId failing() const {
    const Node& node = tree_.node(question_.node);
    return node.children.size() == 1 ? node.children[0] : node.children.back();
  }

  std::string returned(NodeId leaf) const {
    const LeafContract& contract = tree_.node(leaf).contract;
    if (!contract.may_fail) return "(success)";
    return contract.may_succeed ? "(success failure)" : "(failure)";
  }

  // It need not be asked any longer, or has to be as long as the actions run.
  std::vector<QuestionReply> of_guards() const {
    std::vector<NodeId> guards = {question_.node};
    std::vector<std::string> actions;
    for (const NodeId each : question_.others) {
      const auto name = name_of(each);
      if (type_of(each) != NodeType::Action || !name) {
        guards.push_back(each);
      } else if (std::ranges::count(actions, *name) == 0) {
        actions.push_back(*name);
      }
    }
    return {
        {"the answer need not be asked again", said("asked-once", "", guards)},
        {"it has to be asked all along",
         said("holds-while", fmt::format("({})", fmt::join(actions, " ")),
              guards)}};
  }

  std::vector<QuestionReply> that_take_time() const {
    constexpr std::size_t kMost = 5;
    std::vector<QuestionReply> answers;
    for (const NodeId leaf : deeds({question_.node})) {
      const auto& duration = tree_.node(leaf).duration;
      if (duration && duration->min > 0) continue;
      const auto clauses = said("duration", "[1,inf]", {leaf});
      const bool is_known =
          std::ranges::any_of(answers, [&](const QuestionReply& each) {
            return each.clauses[0].name == clauses[0].name;
          });
      if (is_known || answers.size() == kMost) continue;
      answers.push_back(
          {fmt::format("`{}` always takes time", tree_.node(leaf).id),
           clauses});
    }
    return answers;
  }

  const BehaviorTree& tree_;
  const TreeFinding& question_;
};

}  // namespace

std::vector<QuestionReply> replies_to(const BehaviorTree& tree,
                                      const TreeFinding& question) {
  if (!is_question(question) || !is_engine(tree.profile)) return {};
  return RepliesTo(tree, question).all();
}

std::string with_reply(std::string text, const QuestionReply& reply) {
  for (const LeafClause& clause : reply.clauses) {
    text = with_clause(text, clause);
  }
  return text;
}

std::string allowing(const TreeFinding& question) {
  return fmt::format("btcheck: allow {}", question.code);
}

}  // namespace btcheck
