// SPDX-License-Identifier: MIT
//
// A Sequence that resumes its running child does not come past the guards to
// the left again, however long that child runs ("control flow nodes with
// memory": Colledanchise and Ögren, Behavior Trees in Robotics and AI, 2018,
// section 1.3.2). The tree tells which guards are concerned, a run that it
// happens.
#include "check/questions/stale_guards.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "check/findings/facts.hpp"
#include "check/questions/watches.hpp"
#include "model/tree/answers.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// Whether the answer of a guard may be another one later, if anybody asked.
class Changes {
 public:
  explicit Changes(const BehaviorTree& tree)
      : tree_(tree), writers_(tree.variables.size()) {}

  static bool is_guard(const Node& node) {
    return node.type == NodeType::Condition || is_taken_for_condition(node) ||
           node.type == NodeType::SetSV ||
           (node.type == NodeType::Eval && !node.assignment) ||
           (node.type == NodeType::Script && node.answers_value);
  }

  bool may_go_stale(NodeId guard, NodeId running) {
    const Node& node = tree_.node(guard);
    if (node.type == NodeType::Script) return is_written_while(guard, running);
    if (node.type != NodeType::Eval) return true;
    const auto terms = node.expression.terms();
    return std::ranges::any_of(terms, [&](const Term& term) {
      return can_change_while(term, running);
    });
  }

 private:
  bool can_change_while(const Term& term, NodeId running) {
    const auto number = static_cast<std::uint32_t>(term.operand);
    if (term.operation == Operation::Status) {
      return is_ticked_while(tree_, NodeId{number}, running);
    }
    if (term.operation != Operation::Variable) return false;
    const Writers& writers = writers_of(StateVariableId{number});
    return writers.moves_freely ||
           std::ranges::any_of(writers.nodes, [&](NodeId writer) {
             return is_ticked_while(tree_, writer, running);
           });
  }

  // An entry that a script asks for, while something else runs.
  bool is_written_while(NodeId script, NodeId running) {
    if (entry_writers_.empty()) {
      entry_writers_.resize(tree_.entries.size());
      for (const EntryUse& use : tree_.entry_uses) {
        if (use.writes) entry_writers_[use.entry].push_back(use.node);
      }
    }
    // By node, so those of one stand together.
    auto use =
        std::ranges::lower_bound(tree_.entry_uses, script, {}, &EntryUse::node);
    for (; use != tree_.entry_uses.end() && use->node == script; ++use) {
      if (!use->reads || use->when) continue;
      const auto& writers = entry_writers_[use->entry];
      const bool changes = std::ranges::any_of(writers, [&](NodeId writer) {
        ask_budget();
        return is_ticked_while(tree_, writer, running);
      });
      if (changes) return true;
    }
    return false;
  }

  struct Writers {
    bool moves_freely = false;
    std::vector<NodeId> nodes;
  };

  // Worked out for those that are read.
  const Writers& writers_of(StateVariableId variable) {
    std::optional<Writers>& known = writers_[index(variable)];
    if (known) return *known;
    known.emplace();
    known->moves_freely = moves_freely(tree_, variable);
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      if (writes(tree_.nodes[n], variable)) known->nodes.push_back(NodeId{n});
    }
    return *known;
  }

  const BehaviorTree& tree_;
  std::vector<std::optional<Writers>> writers_;
  std::vector<std::vector<NodeId>> entry_writers_;  // once one is asked for
};

// What a node has answered; empty where both is possible.
using Answer = std::optional<NodeStatus>;

struct Ended {
  NodeId node{};
  Answer answer;
};

// It may answer without having been ticked.
bool has_other_answer(const Node& node) {
  return node.script(ScriptTime::SuccessIf) != nullptr ||
         node.script(ScriptTime::FailureIf) != nullptr;
}

// Of a node that was ticked and has ended, with nothing skipped: the children
// that were ticked for sure.
std::vector<Ended> surely_ticked(const BehaviorTree& tree, const Ended& ended) {
  const Node& node = tree.node(ended.node);
  const std::vector<NodeId>& children = node.children;
  if (children.empty()) return {};
  const auto all = [&](Answer answer) {
    std::vector<Ended> ticked;
    for (const NodeId child : children) ticked.push_back({child, answer});
    return ticked;
  };
  const auto first = [&](Answer answer) {
    return std::vector<Ended>{{children[0], answer}};
  };
  const auto in_turn = [&](NodeStatus passes) {
    return ended.answer == passes ? all(passes) : first({});
  };
  switch (info_of(node.type).flow) {
    case Flow::AsChild:
      if (node.type == NodeType::RunOnce) return {};
      return first(ended.answer);
    case Flow::Inverts:
      if (!ended.answer) return first({});
      return first(ended.answer == NodeStatus::Success ? NodeStatus::Failure
                                                       : NodeStatus::Success);
    case Flow::UntilFailure:
      return first(NodeStatus::Failure);
    case Flow::Repeats:
    case Flow::Retries:
      if (node.repetitions == 0 || node.repetitions == kOpenRounds) return {};
      return first(ended.answer);
    case Flow::OnSuccess:
      return in_turn(NodeStatus::Success);
    case Flow::OnFailure:
      return in_turn(NodeStatus::Failure);
    case Flow::Succeeds:
    case Flow::Fails:
    case Flow::Tries:
    case Flow::Recovers:
    case Flow::Chooses:
      return first({});
    default:
      break;
  }
  if (node.type == NodeType::Timeout) return first({});
  if (info_of(node.type).beside != Beside::Counted) return {};
  // The engine's Parallel may decide before it has come to the others.
  const bool begins_all =
      node.type == NodeType::ParallelAll || !is_engine(tree.profile);
  return begins_all ? all({}) : first({});
}

// The guards that were asked before a child runs, under nodes that resume it.
class Guards {
 public:
  explicit Guards(const BehaviorTree& tree)
      : tree_(tree), changes_(tree), answers_(possible_answers(tree)) {}

  std::vector<GuardedAction> of(NodeId action) {
    std::vector<GuardedAction> found;
    Statuses with = {{action, NodeStatus::Running}};
    for (NodeId node = action; !tree_.node(node).is_root();
         node = tree_.node(node).parent) {
      const NodeId above = tree_.node(node).parent;
      if (resumes(tree_.node(above))) add(node, with, action, found);
      // It may have begun anew since, and have left what is below it running.
      if (may_leave_behind(tree_.node(above))) {
        with.emplace_back(above, NodeStatus::Running);
      }
    }
    for (GuardedAction& each : found) std::ranges::sort(each.guards);
    return found;
  }

 private:
  using Statuses = std::vector<std::pair<NodeId, NodeStatus>>;

  // A guard, and the child that it stands in.
  struct Left {
    NodeId guard{};
    NodeId branch{};
  };

  void add(NodeId child, const Statuses& with, NodeId action,
           std::vector<GuardedAction>& found) {
    for (const auto& [guard, branch] : left_of(child)) {
      if (branch >= child) break;
      ask_budget();
      if (!changes_.may_go_stale(guard, action)) continue;
      if (found.empty() || found.back().sighting.with != with) {
        found.push_back({{action, LocationRole::Tick, with}, {}});
      }
      found.back().guards.push_back(guard);
    }
  }

  // By child, those left of some child, while that runs.
  const std::vector<Left>& left_of(NodeId running) {
    const NodeId above = tree_.node(running).parent;
    const auto& children = tree_.node(above).children;
    Answer answer;
    bool is_first_alone = false;
    switch (info_of(tree_.node(above).type).flow) {
      case Flow::OnSuccess:
        answer = NodeStatus::Success;
        break;
      case Flow::OnFailure:
        answer = NodeStatus::Failure;
        break;
      case Flow::Tries:
        is_first_alone = running == children.back();
        if (!is_first_alone) answer = NodeStatus::Success;
        break;
      case Flow::Recovers:
        is_first_alone = true;
        answer = NodeStatus::Failure;
        break;
      case Flow::Chooses:
        is_first_alone = true;
        answer =
            running == children[1] ? NodeStatus::Success : NodeStatus::Failure;
        break;
      default:
        return none_;  // not one after the other
    }
    const auto [known, is_new] = left_.try_emplace({above, answer});
    if (!is_new) return known->second;
    for (const NodeId child : children) {
      add_asked({child, answer}, known->second);
      if (is_first_alone) break;
    }
    return known->second;
  }

  // The guards that such a child has asked for sure.
  void add_asked(const Ended& branch, std::vector<Left>& left) const {
    std::vector<Ended> open = {branch};
    while (!open.empty()) {
      const Ended ended = open.back();
      open.pop_back();
      const Node& node = tree_.node(ended.node);
      if (answers_[index(ended.node)].skipped || has_other_answer(node)) {
        continue;
      }
      if (Changes::is_guard(node)) left.push_back({ended.node, branch.node});
      std::ranges::move(surely_ticked(tree_, ended), std::back_inserter(open));
    }
  }

  const BehaviorTree& tree_;
  Changes changes_;
  const std::vector<Answers> answers_;
  std::map<std::pair<NodeId, Answer>, std::vector<Left>> left_;
  const std::vector<Left> none_;
};

}  // namespace

std::vector<GuardedAction> guarded_actions(const BehaviorTree& tree,
                                           const Network& network) {
  std::vector<GuardedAction> all;
  Guards guards(tree);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const NodeId node{n};
    if (tree.node(node).type != NodeType::Action || !may_run(network, node)) {
      continue;
    }
    std::ranges::move(guards.of(node), std::back_inserter(all));
  }
  return all;
}

std::vector<NodeId> stale_guards(const Network& network,
                                 const GuardedAction& guarded,
                                 const std::vector<Step>& run) {
  std::optional<std::size_t> ran;
  std::map<NodeId, std::size_t> asked;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const std::uint32_t edge = run[i].edge;
    if (edge == kTimeStep) continue;
    if (node_entering(network, edge, LocationRole::Running) ==
        guarded.sighting.node) {
      ran = i;
    }
    if (const auto node = node_entering(network, edge, LocationRole::Tick)) {
      asked[*node] = i;
    }
  }
  std::vector<NodeId> stale;
  for (const NodeId guard : guarded.guards) {
    const auto last = asked.find(guard);
    if (ran && last != asked.end() && last->second < *ran) {
      stale.push_back(guard);
    }
  }
  return stale;
}

}  // namespace btcheck
