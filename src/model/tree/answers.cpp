// SPDX-License-Identifier: MIT
#include "model/tree/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>

#include "model/tree/node_types.hpp"
#include "model/tree/releases.hpp"

namespace btcheck {
namespace {

using AllAnswers = std::vector<Answers>;

// After a result of which the next child is ticked; of nodes whose children
// take turns.
bool Answers::*passing(Flow flow) {
  return flow == Flow::OnFailure ? &Answers::failure : &Answers::success;
}

bool takes_turns(Flow flow) {
  return flow == Flow::OnSuccess || flow == Flow::OnFailure ||
         flow == Flow::Tries;
}

// How many children the tick gets to.
std::size_t reached(const Node& node, const AllAnswers& answers) {
  const Flow flow = info_of(node.type).flow;
  const auto child = [&](std::size_t i) {
    return answers[index(node.children[i])];
  };
  std::size_t count = 1;
  while (count < node.children.size() &&
         (child(count - 1).*passing(flow) || child(count - 1).skipped)) {
    ++count;
  }
  return count;
}

// Of a Sequence: the last child succeeds, or one that is reached fails. A
// Fallback is the same the other way round.
Answers in_turn(const Node& node, const AllAnswers& answers) {
  const Flow flow = info_of(node.type).flow;
  const auto passes = passing(flow);
  const auto stops =
      flow == Flow::OnFailure ? &Answers::success : &Answers::failure;
  const std::size_t count = reached(node, answers);
  Answers made{.success = false, .failure = false};
  for (std::size_t i = 0; i < count; ++i) {
    made.*stops |= answers[index(node.children[i])].*stops;
  }
  const Answers& last = answers[index(node.children.back())];
  made.*passes =
      count == node.children.size() && (last.*passes || last.skipped);
  return made;
}

Answers of_queue(const Node& node) {
  const auto has = [&](NodeStatus answer) {
    return std::ranges::find(node.queue, answer, &QueuedAnswers::answer) !=
           node.queue.end();
  };
  return {has(NodeStatus::Success), has(NodeStatus::Failure),
          has(NodeStatus::Running)};
}

Answers mapped(const Node& node, const Answers& child) {
  const auto gives = [&](NodeStatus answer) {
    return (child.success && node.becomes.of_success == answer) ||
           (child.failure && node.becomes.of_failure == answer) ||
           (child.runs && node.becomes.of_running == answer);
  };
  return {gives(NodeStatus::Success), gives(NodeStatus::Failure),
          gives(NodeStatus::Running)};
}

// What a leaf answers by its fault as well.
Answers with_fault(Answers answers, const std::optional<LeafFault>& fault) {
  if (!fault) return answers;
  switch (fault->kind) {
    case FaultKind::Fails:
    case FaultKind::FailsOnce:
    case FaultKind::FailsOn:
      answers.failure = true;
      break;
    case FaultKind::Succeeds:
    case FaultKind::WritesNothing:
    case FaultKind::WritesOther:
      answers.success = true;
      break;
    case FaultKind::NeverEnds:
    case FaultKind::EndsLate:
      answers.runs = true;
      break;
    case FaultKind::Inverted:
    case FaultKind::FlipsOnce:
      answers.success = answers.failure = true;
      break;
    case FaultKind::Halted:
    case FaultKind::Throws:
      break;
  }
  return answers;
}

// Whatever its conditions do.
Answers by_flow(const Node& node, const AllAnswers& answers) {
  const LeafContract& contract = node.contract;
  const Answers first =
      is_leaf(node.type) ? Answers{} : answers[index(node.children[0])];
  const bool ends = first.success || first.failure;
  switch (info_of(node.type).flow) {
    case Flow::AsContract:
      return with_fault(
          {contract.may_succeed,
           contract.may_fail || !contract.needed().is_true(), contract.may_run},
          node.fault);
    case Flow::NeverFails:
      return {.failure = false};
    case Flow::Evaluates:
      return {.failure = !node.assignment.has_value()};
    case Flow::Executes:
      return {.failure = node.answers_value, .runs = false};
    case Flow::Queues:
      return of_queue(node);
    case Flow::AsChild:
      return {first.success, first.failure};
    case Flow::Inverts:
      return {first.failure, first.success};
    case Flow::Succeeds:
      return {ends, false};
    case Flow::Fails:
      return {false, ends};
    case Flow::UntilFailure:
      return {.success = false, .failure = first.failure};
    case Flow::Repeats:
      return {.success = node.repetitions != kEndlessRounds,
              .failure = first.failure};
    case Flow::Retries:
      return {.success = first.success,
              .failure = node.repetitions != kEndlessRounds};
    case Flow::Recovers:
      return {.success = first.success};
    case Flow::Maps:
      return mapped(node, first);
    case Flow::OnSuccess:
    case Flow::OnFailure:
      return in_turn(node, answers);
    case Flow::Tries:
    case Flow::Chooses:
    case Flow::Cases:
    case Flow::Any:
      break;
  }
  return {};
}

// Its conditions may answer for it.
void add_conditions(const Node& node, Answers& answers) {
  answers.failure |= node.script(ScriptTime::FailureIf) != nullptr;
  answers.success |= node.script(ScriptTime::SuccessIf) != nullptr;
}

// Whether the node may answer skipped, given its children. Of one that counts
// the children that are skipped: the count goes on where it stays.
bool may_skip(const Node& node, const AllAnswers& answers, bool stays) {
  if (node.script(ScriptTime::SkipIf) || node.script(ScriptTime::While)) {
    return true;
  }
  const auto skips = [&](NodeId child) {
    return answers[index(child)].skipped;
  };
  using Children = std::span<const NodeId>;
  const auto some = [&](Children of) { return std::ranges::any_of(of, skips); };
  const auto all = [&](Children of) { return std::ranges::all_of(of, skips); };
  const Children children(node.children);
  switch (info_of(node.type).skips) {
    case Skips::Never:
      break;
    case Skips::AsContract:
      return node.contract.may_skip;
    case Skips::Some:
      return some(children);
    case Skips::All:
      return all(children);
    case Skips::AllOrCounting:
      return all(children) || (some(children) && stays);
    case Skips::AllTried: {
      const Children tried = children.first(children.size() - 1);
      return all(tried) || (some(tried) && stays);
    }
    case Skips::First:
      return skips(children[0]);
    case Skips::SomeBranch:
      return some(children.subspan(1));
    case Skips::SomeOrOption:
      return some(children) || node.option;
    case Skips::SomeOrOtherwise:
      return some(children) || node.otherwise == NodeStatus::Skipped;
  }
  return false;
}

// Of Repeat and RetryUntilSuccessful.
bool is_skipped_empty(const Node& node, int release) {
  const Flow flow = info_of(node.type).flow;
  return (flow == Flow::Repeats || flow == Flow::Retries) &&
         node.repetitions == 0 && releases::kNoRoundIsSkipped.has(release);
}

// Whether the node may tick child i again after it has ended, and has not reset
// it.
bool leaves_ended(const Node& node, std::size_t i, int release) {
  const bool is_reactive = node.type == NodeType::ReactiveSequence ||
                           node.type == NodeType::ReactiveFallback;
  if (is_reactive && releases::reactive_resets_right(release)) return true;
  const Flow flow = info_of(node.type).flow;
  const bool goes_round = flow == Flow::Repeats || flow == Flow::Retries;
  if (goes_round && releases::kRoundsKeepChild.has(release)) return true;
  switch (info_of(node.type).ended) {
    case Ended::None:
      break;
    case Ended::First:
      return i == 0;
    case Ended::FirstOfTwo:
      return i == 0 && node.children.size() == 2;
    case Ended::All:
      return true;
  }
  return false;
}

class Unreached {
 public:
  explicit Unreached(const BehaviorTree& tree)
      : tree_(tree),
        answers_(possible_answers(tree)),
        is_dead_(tree.nodes.size(), false) {}

  std::vector<NeverTicked> find() {
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
      const Node& node = tree_.nodes[i];
      if (is_dead_[i]) {
        for (const NodeId child : node.children) is_dead_[index(child)] = true;
      } else if (!node.children.empty()) {
        look_at(node);
      }
    }
    return std::move(found_);
  }

 private:
  // At the children of a node that is ticked itself.
  void look_at(const Node& node) {
    const Flow flow = info_of(node.type).flow;
    if (takes_turns(flow)) look_at_turns(node);
    if (flow == Flow::Recovers) unless(node, 0, &Answers::failure, 1);
    if (flow == Flow::Chooses) {
      unless(node, 0, &Answers::success, 1);
      unless(node, 0, &Answers::failure, 2);
    }
    if (flow == Flow::Cases) look_at_cases(node);
    const bool goes_round = flow == Flow::Repeats || flow == Flow::Retries;
    if (goes_round && node.repetitions == 0)
      add(node, 0, "it goes round 0 times");
  }

  // Of a TryCatch the last child has no turn: it is ticked where one fails.
  void look_at_turns(const Node& node) {
    const Flow flow = info_of(node.type).flow;
    const std::size_t count = reached(node, answers_);
    const std::size_t turns = node.children.size() - (flow == Flow::Tries);
    if (count >= turns) return;
    unless(node, count - 1, passing(flow), count);
    for (std::size_t i = count; i < turns; ++i) {
      is_dead_[index(node.children[i])] = true;
    }
  }

  // Child `behind` is ticked after such an answer of child `before` alone.
  void unless(const Node& node, std::size_t before, bool Answers::*answer,
              std::size_t behind) {
    if (behind >= node.children.size()) return;
    const NodeId asked = node.children[before];
    if (answers_[index(asked)].*answer) return;
    add(node, behind,
        fmt::format("`{}` ({}) never {}", tree_.node(asked).name,
                    line_of(tree_, asked),
                    answer == &Answers::success ? "succeeds" : "fails"));
  }

  // The first case that matches is taken.
  void look_at_cases(const Node& node) {
    std::map<std::string_view, std::size_t> first;
    for (std::size_t i = 0; i < node.own_scripts.size(); ++i) {
      const auto [same, is_new] =
          first.emplace(node.own_scripts[i].text, i + 1);
      if (is_new) continue;
      add(node, i, fmt::format("`case_{}` has the same value", same->second));
    }
  }

  void add(const Node& node, std::size_t child, std::string why) {
    is_dead_[index(node.children[child])] = true;
    found_.push_back({node.children[child], std::move(why)});
  }

  const BehaviorTree& tree_;
  const AllAnswers answers_;
  std::vector<bool> is_dead_;
  std::vector<NeverTicked> found_;
};

}  // namespace

std::vector<Answers> possible_answers(const BehaviorTree& tree) {
  AllAnswers answers(tree.nodes.size());
  const int release = engine_release(tree.profile);
  for (const Node& node : tree.nodes) {
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      answers[index(node.children[i])].stays = leaves_ended(node, i, release);
    }
  }
  // Children have larger numbers than their parents.
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const Node& node = tree.nodes[i];
    const bool stays = answers[i].stays;
    answers[i] = by_flow(node, answers);
    answers[i].stays = stays;
    answers[i].skipped =
        is_engine(tree.profile) &&
        (may_skip(node, answers, stays) || is_skipped_empty(node, release));
    add_conditions(node, answers[i]);
  }
  return answers;
}

std::vector<NeverTicked> never_ticked(const BehaviorTree& tree) {
  return Unreached(tree).find();
}

}  // namespace btcheck
