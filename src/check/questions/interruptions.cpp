// SPDX-License-Identifier: MIT
#include "check/questions/interruptions.hpp"

#include <algorithm>
#include <span>

#include "model/tree/answers.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// Which answers a node may give in its first tick before anything in it runs.
struct Quiet {
  bool success = false;
  bool failure = false;
  bool skipped = false;

  bool any() const { return success || failure || skipped; }
};
constexpr Quiet kAll = {true, true, true};

// Of an action of which nobody says what it answers, the name may tell.
bool may_run(const Node& leaf, bool takes_guesses) {
  if (leaf.type == NodeType::Wait) return true;
  if (leaf.type != NodeType::Action || !leaf.contract.may_run) return false;
  if (leaf.is_guessed && !takes_guesses) return false;
  return leaf.contract.memory != LeafMemory::Unknown ||
         !sounds_like_condition(leaf.id);
}

class Search {
 public:
  Search(const BehaviorTree& tree, bool takes_guesses)
      : tree_(tree),
        takes_guesses_(takes_guesses),
        answers_(possible_answers(tree)),
        runs_(tree.nodes.size(), false),
        quiet_(tree.nodes.size()) {
    // Children have larger numbers than their parents.
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
      const Node& node = tree.nodes[i];
      runs_[i] = may_run(node, takes_guesses) ||
                 std::ranges::any_of(node.children, [&](NodeId child) {
                   return runs_[index(child)];
                 });
      quiet_[i] = quiet(NodeId{static_cast<std::uint32_t>(i)});
    }
  }

  std::vector<Interruption> find() const {
    std::vector<Interruption> found;
    for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
      const NodeType type = tree_.nodes[i].type;
      if (type == NodeType::ReactiveSequence ||
          type == NodeType::ReactiveFallback) {
        look_at(NodeId{i}, found);
      }
    }
    return found;
  }

 private:
  using Children = std::span<const NodeId>;

  void look_at(NodeId id, std::vector<Interruption>& found) const {
    const Node& node = tree_.node(id);
    const bool is_sequence = node.type == NodeType::ReactiveSequence;
    const auto restarts = std::ranges::find_if(node.children, [&](NodeId at) {
      const Answers& answers = answers_[index(at)];
      const Quiet& quiet = quiet_[index(at)];
      const bool passes = is_sequence ? answers.success : answers.failure;
      const bool is_quiet = is_sequence ? quiet.success : quiet.failure;
      return runs_[index(at)] && passes && !is_quiet && !quiet.skipped;
    });
    if (restarts == node.children.end()) return;
    const auto halted =
        std::find_if(restarts + 1, node.children.end(),
                     [&](NodeId at) { return runs_[index(at)]; });
    if (halted != node.children.end())
      found.push_back({id, *restarts, *halted, takes_guesses_});
  }

  // Preconditions answer before the node does.
  Quiet quiet(NodeId id) const {
    const Node& node = tree_.node(id);
    Quiet answers = is_leaf(node.type) ? of_leaf(id) : of_inner(node);
    const auto has = [&](ScriptTime time) {
      return node.script(time) != nullptr;
    };
    answers.success |= has(ScriptTime::SuccessIf);
    answers.failure |= has(ScriptTime::FailureIf);
    answers.skipped |= has(ScriptTime::SkipIf) || has(ScriptTime::While);
    return answers;
  }

  Quiet of_leaf(NodeId id) const {
    if (runs_[index(id)]) return {};
    const Answers& answers = answers_[index(id)];
    return {answers.success, answers.failure, answers.skipped};
  }

  const Quiet& of(NodeId child) const { return quiet_[index(child)]; }

  Quiet of_inner(const Node& node) const {
    const Children children(node.children);
    const Quiet first = of(children[0]);
    switch (info_of(node.type).flow) {
      case Flow::AsChild:
        return node.type == NodeType::RunOnce ? kAll : first;
      case Flow::Inverts:
        return {first.failure, first.success, first.skipped};
      case Flow::Succeeds:
        return {first.success || first.failure, false, first.skipped};
      case Flow::Fails:
        return {false, first.success || first.failure, first.skipped};
      case Flow::UntilFailure:
        return {false, first.failure, false};
      case Flow::Repeats:
      case Flow::Retries:
        return first;
      case Flow::OnSuccess:
        return in_turn(children, &Quiet::success, &Quiet::failure);
      case Flow::OnFailure:
        return in_turn(children, &Quiet::failure, &Quiet::success);
      case Flow::Recovers:
        return {first.success, first.failure, first.skipped};
      case Flow::Chooses:
        return chosen(children);
      case Flow::Cases:
        return some_of(children);
      case Flow::AsContract:
      case Flow::NeverFails:
      case Flow::Evaluates:
      case Flow::Executes:
      case Flow::Queues:
      case Flow::Tries:
      case Flow::Maps:
      case Flow::Any:
        break;
    }
    return of_other(node);
  }

  Quiet in_turn(Children children, bool Quiet::*passes,
                bool Quiet::*stops) const {
    Quiet made;
    bool all_skip = true;
    for (const NodeId child : children) {
      made.*stops |= of(child).*stops;
      all_skip &= of(child).skipped;
      if (!(of(child).*passes) && !of(child).skipped) return made;
    }
    made.*passes = true;
    made.skipped = all_skip;
    return made;
  }

  Quiet some_of(Children children) const {
    Quiet made;
    for (const NodeId child : children) {
      made.success |= of(child).success;
      made.failure |= of(child).failure;
      made.skipped |= of(child).skipped;
    }
    return made;
  }

  // Without a third child, a condition that fails makes the node fail.
  Quiet chosen(Children children) const {
    const Quiet& condition = of(children[0]);
    Quiet made;
    if (condition.success) made = some_of(children.subspan(1, 1));
    if (!condition.failure) return made;
    if (children.size() < 3) {
      made.failure = true;
      return made;
    }
    const Quiet otherwise = some_of(children.subspan(2, 1));
    made.success |= otherwise.success;
    made.failure |= otherwise.failure;
    made.skipped |= otherwise.skipped;
    return made;
  }

  // Of one that is not worked out, anything; of those that begin all or one of
  // their children, what these answer.
  Quiet of_other(const Node& node) const {
    const Children children(node.children);
    if (node.type == NodeType::Timeout) return of(children[0]);
    const bool begins_all =
        node.type == NodeType::Parallel || node.type == NodeType::ParallelAll;
    if (!begins_all) return kAll;
    const bool all_are = std::ranges::all_of(
        children, [&](NodeId child) { return of(child).any(); });
    return all_are ? some_of(children) : Quiet{};
  }

  const BehaviorTree& tree_;
  const bool takes_guesses_;
  const std::vector<Answers> answers_;
  std::vector<bool> runs_;
  std::vector<Quiet> quiet_;
};

}  // namespace

std::vector<Interruption> interruptions(const BehaviorTree& tree) {
  if (!is_engine(tree.profile)) return {};
  std::vector<Interruption> found = Search(tree, false).find();
  for (const Interruption& guess : Search(tree, true).find()) {
    const auto same = std::ranges::find(found, guess.node, &Interruption::node);
    if (same == found.end()) found.push_back(guess);
  }
  return found;
}

}  // namespace btcheck
