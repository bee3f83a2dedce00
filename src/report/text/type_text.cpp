// SPDX-License-Identifier: MIT
//
// What all releases have in common, in the words of docs/semantics.md and
// docs/btcpp.md; where they differ is told there.
#include "report/text/type_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "model/btcpp/known_types.hpp"

namespace btcheck {
namespace {

struct TypeSentence {
  NodeType type;
  std::string_view text;
};
constexpr auto kOfTypes = std::to_array<TypeSentence>({
    {NodeType::BehaviorTree, "Ticks the tree below it, once in each tick."},
    {NodeType::Sequence,
     "Ticks its children one after another; succeeds when all have succeeded, "
     "fails when one fails. A child that runs is resumed: no child before it "
     "is asked again."},
    {NodeType::Fallback,
     "Ticks its children one after another until one succeeds; fails when all "
     "have failed. A child that runs is resumed: no child before it is asked "
     "again."},
    {NodeType::SequenceWithMemory,
     "A Sequence that goes on with the child that has failed, instead of the "
     "first one."},
    {NodeType::ReactiveSequence,
     "A Sequence that begins with its first child in every tick; when a child "
     "fails or runs, the others are halted."},
    {NodeType::ReactiveFallback,
     "A Fallback that begins with its first child in every tick; when a child "
     "succeeds or runs, the others are halted."},
    {NodeType::Parallel,
     "Ticks all of its children in each tick; ends when enough of them have "
     "succeeded or failed, and halts the others."},
    {NodeType::ParallelAll,
     "Ticks all of its children in each tick; succeeds when all have ended, "
     "and "
     "not more have failed than may."},
    {NodeType::Inverter,
     "Answers success for the failure of its child, and failure for success."},
    {NodeType::ForceSuccess, "Succeeds when its child ends, however it ends."},
    {NodeType::ForceFailure, "Fails when its child ends, however it ends."},
    {NodeType::KeepRunningUntilFailure,
     "Runs, ticking its child again and again, and fails when the child "
     "fails."},
    {NodeType::Repeat,
     "Ticks its child again after each success, so many times; fails when the "
     "child fails."},
    {NodeType::RetryUntilSuccessful,
     "Ticks its child again after each failure, so many times; succeeds when "
     "the child succeeds."},
    {NodeType::RateController,
     "Ticks its child at most so often in a second, and whenever it runs."},
    {NodeType::Recovery,
     "Ticks its first child; when that fails, its second one, and then the "
     "first again, so many times. Fails when the second fails."},
    {NodeType::RoundRobin,
     "Ticks its children in turn until one succeeds, and begins the next time "
     "behind that one."},
    {NodeType::PipelineSequence,
     "A Sequence that ticks again, in every tick, all children that came "
     "before the one that runs."},
    {NodeType::SubTree, "Ticks the tree that it names, and answers the same."},
    {NodeType::SetSV, "Measures a state variable, and succeeds."},
    {NodeType::Eval,
     "Succeeds where its expression is true, and fails where it is not; or "
     "assigns a value, and succeeds."},
    {NodeType::Wait, "Runs for so long, then succeeds."},
    {NodeType::AsyncSequence,
     "A Sequence that answers running after each child that ends, so that "
     "others are heard in between."},
    {NodeType::AsyncFallback,
     "A Fallback that answers running after each child that ends, so that "
     "others are heard in between."},
    {NodeType::IfThenElse,
     "Asks its first child once; ticks the second where that has succeeded, "
     "else the third."},
    {NodeType::WhileDoElse,
     "Asks its first child in every tick; ticks the second while that "
     "succeeds, else the third, and halts one when the other's turn comes."},
    {NodeType::Switch,
     "Compares its variable with the cases in every tick, and ticks the child "
     "of the first that is equal, else the last."},
    {NodeType::TryCatch,
     "Ticks all children but the last as a Sequence; when one fails, ticks the "
     "last, and fails."},
    {NodeType::NonblockingSequence,
     "Ticks all of its children in every tick, also beside one that runs; "
     "succeeds when all have succeeded."},
    {NodeType::PersistentSequence,
     "A Sequence that keeps in an entry of the blackboard which child is next, "
     "also when it is halted."},
    {NodeType::PauseResumeController,
     "Ticks one child while it is resumed, another while it is paused, and "
     "others when that changes; services pause and resume it."},
    {NodeType::OtherControl,
     "A control node of the program: it may tick and halt its children in any "
     "order, and answer anything."},
    {NodeType::Precondition,
     "Ticks its child where its script is true, else answers what its `else` "
     "says."},
    {NodeType::Timeout,
     "Halts its child and fails when that has run for too long."},
    {NodeType::Delay, "Waits for so long, then ticks its child."},
    {NodeType::RunOnce,
     "Runs its child to its end once; later it is skipped, or answers what the "
     "child has answered."},
    {NodeType::Loop,
     "Takes values from a queue, one after another, and ticks its child for "
     "each."},
    {NodeType::WhenUpdated,
     "Ticks its child when an entry of the blackboard has been written since "
     "the last time."},
    {NodeType::WhenDue,
     "Ticks its child when the world says that it is due, and whenever it "
     "runs."},
    {NodeType::GoalUpdater,
     "Ticks its child with the goal that was sent last."},
    {NodeType::PathLongerOnApproach,
     "Ticks its child when the new path has become much longer close to the "
     "goal; else succeeds without it."},
    {NodeType::SingleTrigger,
     "Ticks its child until that has ended once, then fails until it is "
     "reset."},
    {NodeType::BlackboardCheck,
     "Ticks its child where two values are equal, else answers what its "
     "`return_on_mismatch` says."},
    {NodeType::OtherDecorator,
     "A decorator of the program: it may tick and halt its child at any time, "
     "and answer anything."},
    {NodeType::Script, "Executes a script on the blackboard."},
    {NodeType::PolicyParallel,
     "Ticks all of its children in each tick; succeeds as its policy says, and "
     "fails when one fails."},
    {NodeType::EternalGuard,
     "Asks its first child in every tick, and ticks the second while that "
     "succeeds; when it fails, halts the second and fails."},
    {NodeType::AnswerMap,
     "Answers as its table says for what its child "
     "answers."},
    {NodeType::AnswerQueue, "Gives answers in the order of its queue."},
});

struct IdSentence {
  std::string_view id;
  std::string_view text;
};
// Types that are lowered as one of several, and say more by their names.
constexpr auto kOfIds = std::to_array<IdSentence>({
    {"ScriptCondition",
     "Succeeds where its script is true, and fails where it is not."},
    {"SetBlackboard", "Writes a value to an entry of the blackboard."},
    {"UnsetBlackboard", "Removes an entry of the blackboard."},
    {"WasEntryUpdated",
     "Succeeds where an entry of the blackboard has been written since the "
     "last time."},
    {"SkipUnlessUpdated",
     "Ticks its child where an entry of the blackboard has been written since "
     "the last time; else it is skipped."},
    {"WaitValueUpdate",
     "Runs until an entry of the blackboard has been written, then ticks its "
     "child."},
    {"AlwaysSuccess", "Succeeds."},
    {"AlwaysFailure", "Fails."},
    {"DistanceController",
     "Ticks its child when the robot has come so far, and whenever it runs."},
    {"SpeedController",
     "Ticks its child the more often the faster the robot is, and whenever it "
     "runs."},
    {"GoalUpdatedController",
     "Ticks its child when the goal has changed, and whenever it runs."},
});

// "success, failure or running".
std::string answers_of(const LeafContract& contract) {
  std::vector<std::string_view> words;
  if (contract.may_succeed) words.push_back("success");
  if (contract.may_fail) words.push_back("failure");
  if (contract.may_run) words.push_back("running");
  if (contract.may_skip) words.push_back("skipped");
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text.empty() ? "nothing" : text;
}

// Whose program has the leaf.
std::string_view owner_of(const Node& node, Profile profile) {
  const bool is_of_py_trees =
      profile == Profile::PyTrees &&
      btcpp::builtin_type(BtcppRelease::PyTrees, node.id) != nullptr;
  if (is_of_py_trees) return "py_trees";
  return has_nav2(profile) && btcpp::nav2_type(node.id) != nullptr
             ? "Nav2"
             : "the program";
}

}  // namespace

std::string_view type_text(NodeType type) {
  const auto found = std::ranges::find(kOfTypes, type, &TypeSentence::type);
  return found == kOfTypes.end() ? std::string_view() : found->text;
}

std::string type_text(const Node& node, Profile profile) {
  const auto own = std::ranges::find(kOfIds, node.id, &IdSentence::id);
  if (own != kOfIds.end()) return std::string(own->text);
  const std::string_view text = type_text(node.type);
  if (!text.empty()) return std::string(text);
  if (!is_leaf(node.type)) return {};
  return fmt::format(
      "{} of {}; it may answer {}.",
      node.type == NodeType::Condition ? "A condition" : "An action",
      owner_of(node, profile), answers_of(node.contract));
}

}  // namespace btcheck
