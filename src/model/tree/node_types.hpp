// SPDX-License-Identifier: MIT
//
// The types of nodes: one row of facts for each, all that depends on the type
// alone. What a type does is its drawing, in mapping/; what XML trees call it,
// and what its ports say, is in btcpp/known_types.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "text/tables.hpp"

namespace btcheck {

enum class NodeType : std::uint8_t {
  BehaviorTree,
  Sequence,
  Fallback,
  SequenceWithMemory,
  ReactiveSequence,
  ReactiveFallback,
  Parallel,
  ParallelAll,
  Inverter,
  ForceSuccess,
  ForceFailure,
  KeepRunningUntilFailure,
  Repeat,
  RetryUntilSuccessful,
  RateController,
  Recovery,
  RoundRobin,
  PipelineSequence,
  SubTree,
  Action,
  Condition,
  SetSV,
  Eval,
  Wait,
  AsyncSequence,
  AsyncFallback,
  IfThenElse,
  WhileDoElse,
  Switch,
  TryCatch,
  NonblockingSequence,
  PersistentSequence,
  PauseResumeController,
  OtherControl,  // of the user's program
  Precondition,
  Timeout,
  Delay,
  RunOnce,
  Loop,         // LoopInt, LoopString, …
  WhenUpdated,  // SkipUnlessUpdated, WaitValueUpdate
  WhenDue,      // DistanceController, SpeedController, …
  GoalUpdater,
  PathLongerOnApproach,
  SingleTrigger,
  BlackboardCheck,
  OtherDecorator,  // of the user's program
  Script,          // Script, ScriptCondition, SetBlackboard, …
  PolicyParallel,  // py_trees: Parallel
  EternalGuard,    // py_trees
  AnswerMap,       // py_trees: FailureIsRunning, Condition, PassThrough, …
  AnswerQueue,     // py_trees: StatusQueue, TickCounter, Periodic, …
  Count            // no type: how many there are
};
inline constexpr auto kNodeTypeCount =
    static_cast<std::size_t>(NodeType::Count);

// Which languages have the type, a bit for each: .btf, XML of BehaviorTree.CPP
// and Nav2, XML of py_trees.
enum class In : std::uint8_t {
  Btf = 1,
  Btcpp = 2,
  PyTrees = 4,
  Both = Btf | Btcpp,
  Xml = Btcpp | PyTrees,
  All = Btf | Xml
};
constexpr bool has(In all, In language) {
  return (static_cast<unsigned>(all) & static_cast<unsigned>(language)) != 0;
}

// What a node ticks besides a child that runs, in the ticks after the first.
enum class Beside : std::uint8_t {
  None,     // it resumes that child: no guard to its left is asked again
  TheLeft,  // it is reactive: all to the left are ticked before it, each time
  Counted,  // all that have not ended; it decides by how many have ended how
  Any       // other children, too; or it has no other
};

// Which of its children the tick gets to, and what it answers by them. First
// those of leaves.
enum class Flow : std::uint8_t {
  AsContract,    // what its contract says
  NeverFails,    // it succeeds, or runs
  Evaluates,     // fails where it asks and assigns nothing
  Executes,      // a script: never runs, and fails where that has a value
  Queues,        // the answers of its queue
  AsChild,       // answers what its child answers
  Inverts,       // success for failure and failure for success
  Succeeds,      // whatever its child answers
  Fails,         // likewise
  UntilFailure,  // runs until its child fails, and fails then
  Repeats,       // its child, until that fails or the rounds are done
  Retries,       // its child, until that succeeds or the rounds are done
  OnSuccess,     // the next child when one has succeeded
  OnFailure,     // the next child when one has failed
  Tries,         // OnSuccess, but for the last: that when one has failed
  Recovers,      // its second child when the first has failed
  Chooses,       // its second child when the first succeeds, else its third
  Cases,         // the child of the first case that matches
  Maps,          // as its table says, by what its child answers
  Any            // not worked out
};

// Which children it may tick again after they have ended, without having reset
// them. (XML trees; in .btf trees an answer leaves nothing behind.)
enum class Ended : std::uint8_t { None, First, FirstOfTwo, All };

// When it may answer skipped, besides for its _skipIf and _while (XML trees).
enum class Skips : std::uint8_t {
  Never,
  AsContract,       // a leaf: what its contract says
  Some,             // when some child may be skipped
  All,              // when all may be skipped in one tick
  AllOrCounting,    // All; or Some, where the count goes on in a node that has
                    // ended and was not reset
  AllTried,         // AllOrCounting, but for the last child
  First,            // when its first child may be skipped
  SomeBranch,       // when a child behind the first may be skipped
  SomeOrOption,     // Some, or where its option says so
  SomeOrOtherwise,  // Some, or as its answer instead of ticking its child
};

// Where tick() calls setStatus(RUNNING) before the node answers, so that a log
// of BehaviorTree.CPP has it (4.10 and 3.8.8, src/controls, src/decorators;
// Nav2's plugins).
enum class SetsRunning : std::uint8_t {
  Never,              // at its answer only
  First,              // first of all, in every tick
  FirstMayHalt,       // likewise, and it may call its own halt() before it
                      // answers
  FromIdle,           // first of all, in a tick that finds it idle
  WithChild,          // before it ticks its child
  WithChildFromIdle,  // likewise, in a tick that finds it idle
  AsProgrammed        // by the user's program: anywhere, or never
};

// One row for each node type. kAnyNumber when there is no upper end.
inline constexpr int kAnyNumber = 1 << 20;
struct NodeTypeInfo {
  NodeType type;
  std::string_view name;
  In in;
  int min_children;
  int max_children;
  Flow flow;
  Beside beside;
  Ended ended;
  Skips skips;
  SetsRunning sets_running;
  std::string_view sign;  // in pictures, of nodes with several children
  // What it does, in whole sentences; "" for leaves of the program.
  std::string_view about;
};

namespace node_rows {
constexpr NodeTypeInfo leaf(NodeType type, std::string_view name, In in,
                            Flow flow, Skips skips, SetsRunning sets_running,
                            std::string_view about) {
  return {type,        name,  in,           0,  0,    flow, Beside::Any,
          Ended::None, skips, sets_running, "", about};
}

constexpr NodeTypeInfo decorator(NodeType type, std::string_view name, In in,
                                 Flow flow, Skips skips,
                                 SetsRunning sets_running,
                                 std::string_view about) {
  return {type,        name,  in,           1,  1,    flow, Beside::Any,
          Ended::None, skips, sets_running, "", about};
}

// Indexed by NodeType. A row without one of its columns does not compile.
inline constexpr std::array<NodeTypeInfo, kNodeTypeCount> kNodeTypes = {{
    decorator(NodeType::BehaviorTree, "BehaviorTree", In::All, Flow::AsChild,
              Skips::Some, SetsRunning::Never,
              "Ticks the tree below it, once in each tick."),
    {NodeType::Sequence, "Sequence", In::All, 1, kAnyNumber, Flow::OnSuccess,
     Beside::None, Ended::None, Skips::AllOrCounting, SetsRunning::First, "→",
     "Ticks its children one after another; succeeds when all have succeeded, "
     "fails when one fails. A child that runs is resumed: no child before it "
     "is asked again."},
    {NodeType::Fallback, "Fallback", In::All, 1, kAnyNumber, Flow::OnFailure,
     Beside::None, Ended::None, Skips::AllOrCounting, SetsRunning::First, "?",
     "Ticks its children one after another until one succeeds; fails when all "
     "have failed. A child that runs is resumed: no child before it is asked "
     "again."},
    {NodeType::SequenceWithMemory, "SequenceWithMemory", In::Both, 1,
     kAnyNumber, Flow::OnSuccess, Beside::None, Ended::None,
     Skips::AllOrCounting, SetsRunning::First, "→",
     "A Sequence that goes on with the child that has failed, instead of the "
     "first one."},
    {NodeType::ReactiveSequence, "ReactiveSequence", In::All, 1, kAnyNumber,
     Flow::OnSuccess, Beside::TheLeft, Ended::None, Skips::All,
     SetsRunning::First, "→",
     "A Sequence that begins with its first child in every tick; when a child "
     "fails or runs, the others are halted."},
    {NodeType::ReactiveFallback, "ReactiveFallback", In::All, 1, kAnyNumber,
     Flow::OnFailure, Beside::TheLeft, Ended::None, Skips::All,
     SetsRunning::First, "?",
     "A Fallback that begins with its first child in every tick; when a child "
     "succeeds or runs, the others are halted."},
    {NodeType::Parallel, "Parallel", In::Both, 1, kAnyNumber, Flow::Any,
     Beside::Counted, Ended::None, Skips::All, SetsRunning::First, "⇉",
     "Ticks all of its children in each tick; ends when enough of them have "
     "succeeded or failed, and halts the others."},
    {NodeType::ParallelAll, "ParallelAll", In::Both, 1, kAnyNumber, Flow::Any,
     Beside::Counted, Ended::None, Skips::All, SetsRunning::First, "⇉",
     "Ticks all of its children in each tick; succeeds when all have ended, "
     "and not more have failed than may."},
    decorator(NodeType::Inverter, "Inverter", In::All, Flow::Inverts,
              Skips::Some, SetsRunning::First,
              "Answers success for the failure of its child, and failure for "
              "success."),
    decorator(NodeType::ForceSuccess, "ForceSuccess", In::All, Flow::Succeeds,
              Skips::Some, SetsRunning::First,
              "Succeeds when its child ends, however it ends."),
    decorator(NodeType::ForceFailure, "ForceFailure", In::All, Flow::Fails,
              Skips::Some, SetsRunning::First,
              "Fails when its child ends, however it ends."),
    decorator(NodeType::KeepRunningUntilFailure, "KeepRunningUntilFailure",
              In::All, Flow::UntilFailure, Skips::Never, SetsRunning::First,
              "Runs, ticking its child again and again, and fails when the "
              "child fails."),
    decorator(NodeType::Repeat, "Repeat", In::All, Flow::Repeats, Skips::Some,
              SetsRunning::First,
              "Ticks its child again after each success, so many times; fails "
              "when the child fails."),
    decorator(NodeType::RetryUntilSuccessful, "RetryUntilSuccessful", In::All,
              Flow::Retries, Skips::Some, SetsRunning::First,
              "Ticks its child again after each failure, so many times; "
              "succeeds when the child succeeds."),
    decorator(
        NodeType::RateController, "RateController", In::Both, Flow::AsChild,
        Skips::Some, SetsRunning::First,
        "Ticks its child at most so often in a second, and whenever it runs."),
    {NodeType::Recovery, "Recovery", In::Both, 2, 2, Flow::Recovers,
     Beside::None, Ended::None, Skips::First, SetsRunning::FirstMayHalt, "?",
     "Ticks its first child; when that fails, its second one, and then the "
     "first again, so many times. Fails when the second fails."},
    {NodeType::RoundRobin, "RoundRobin", In::Both, 1, kAnyNumber, Flow::Any,
     Beside::None, Ended::All, Skips::All, SetsRunning::FirstMayHalt, "↻",
     "Ticks its children in turn until one succeeds, and begins the next time "
     "behind that one."},
    {NodeType::PipelineSequence, "PipelineSequence", In::Both, 1, kAnyNumber,
     Flow::OnSuccess, Beside::TheLeft, Ended::All, Skips::All,
     SetsRunning::Never, "→",
     "A Sequence that ticks again, in every tick, all children that came "
     "before the one that runs."},
    decorator(NodeType::SubTree, "SubTree", In::All, Flow::AsChild, Skips::Some,
              SetsRunning::FromIdle,
              "Ticks the tree that it names, and answers the same."),
    leaf(NodeType::Action, "Action", In::All, Flow::AsContract,
         Skips::AsContract, SetsRunning::AsProgrammed, ""),
    leaf(NodeType::Condition, "Condition", In::All, Flow::AsContract,
         Skips::AsContract, SetsRunning::AsProgrammed, ""),
    leaf(NodeType::SetSV, "SetSV", In::Btf, Flow::NeverFails, Skips::Never,
         SetsRunning::Never, "Measures a state variable, and succeeds."),
    leaf(NodeType::Eval, "Eval", In::Btf, Flow::Evaluates, Skips::Never,
         SetsRunning::Never,
         "Succeeds where its expression is true, and fails where it is not; or "
         "assigns a value, and succeeds."),
    leaf(NodeType::Wait, "Wait", In::All, Flow::NeverFails, Skips::Never,
         SetsRunning::Never, "Runs for so long, then succeeds."),
    {NodeType::AsyncSequence, "AsyncSequence", In::Btcpp, 1, kAnyNumber,
     Flow::OnSuccess, Beside::None, Ended::None, Skips::AllOrCounting,
     SetsRunning::First, "→",
     "A Sequence that answers running after each child that ends, so that "
     "others are heard in between."},
    {NodeType::AsyncFallback, "AsyncFallback", In::Btcpp, 1, kAnyNumber,
     Flow::OnFailure, Beside::None, Ended::None, Skips::AllOrCounting,
     SetsRunning::First, "?",
     "A Fallback that answers running after each child that ends, so that "
     "others are heard in between."},
    {NodeType::IfThenElse, "IfThenElse", In::Btcpp, 2, 3, Flow::Chooses,
     Beside::None, Ended::FirstOfTwo, Skips::SomeBranch, SetsRunning::First,
     "◇",
     "Asks its first child once; ticks the second where that has succeeded, "
     "else the third."},
    {NodeType::WhileDoElse, "WhileDoElse", In::Btcpp, 2, 3, Flow::Chooses,
     Beside::TheLeft, Ended::First, Skips::SomeBranch, SetsRunning::First, "◇",
     "Asks its first child in every tick; ticks the second while that "
     "succeeds, else the third, and halts one when the other's turn comes."},
    {NodeType::Switch, "Switch", In::Btcpp, 1, kAnyNumber, Flow::Cases,
     Beside::Any, Ended::None, Skips::Some, SetsRunning::Never, "◇",
     "Compares its variable with the cases in every tick, and ticks the child "
     "of the first that is equal, else the last."},
    {NodeType::TryCatch, "TryCatch", In::Btcpp, 2, kAnyNumber, Flow::Tries,
     Beside::None, Ended::None, Skips::AllTried, SetsRunning::First, "?",
     "Ticks all children but the last as a Sequence; when one fails, ticks the "
     "last, and fails."},
    {NodeType::NonblockingSequence, "NonblockingSequence", In::Btcpp, 1,
     kAnyNumber, Flow::Any, Beside::Any, Ended::All, Skips::Never,
     SetsRunning::Never, "⇉",
     "Ticks all of its children in every tick, also beside one that runs; "
     "succeeds when all have succeeded."},
    {NodeType::PersistentSequence, "PersistentSequence", In::Btcpp, 1,
     kAnyNumber, Flow::Any, Beside::Any, Ended::All, Skips::Never,
     SetsRunning::First, "→",
     "A Sequence that keeps in an entry of the blackboard which child is next, "
     "also when it is halted."},
    {NodeType::PauseResumeController, "PauseResumeController", In::Btcpp, 1, 4,
     Flow::Any, Beside::Any, Ended::All, Skips::Never, SetsRunning::First, "◇",
     "Ticks one child while it is resumed, another while it is paused, and "
     "others when that changes; services pause and resume it."},
    {NodeType::OtherControl, "Control", In::Btcpp, 1, kAnyNumber, Flow::Any,
     Beside::Any, Ended::All, Skips::Never, SetsRunning::AsProgrammed, "",
     "A control node of the program: it may tick and halt its children in any "
     "order, and answer anything."},
    decorator(NodeType::Precondition, "Precondition", In::Btcpp, Flow::Any,
              Skips::SomeOrOtherwise, SetsRunning::Never,
              "Ticks its child where its script is true, else answers what its "
              "`else` says."),
    decorator(NodeType::Timeout, "Timeout", In::All, Flow::Any, Skips::Some,
              SetsRunning::First,
              "Halts its child and fails when that has run for too long."),
    decorator(NodeType::Delay, "Delay", In::Btcpp, Flow::AsChild, Skips::Some,
              SetsRunning::First, "Waits for so long, then ticks its child."),
    decorator(NodeType::RunOnce, "RunOnce", In::Xml, Flow::AsChild,
              Skips::SomeOrOption, SetsRunning::WithChild,
              "Runs its child to its end once; later it is skipped, or answers "
              "what the child has answered."),
    decorator(NodeType::Loop, "Loop", In::Btcpp, Flow::Any,
              Skips::SomeOrOtherwise, SetsRunning::WithChildFromIdle,
              "Takes values from a queue, one after another, and ticks its "
              "child for each."),
    decorator(NodeType::WhenUpdated, "WhenUpdated", In::Btcpp, Flow::Any,
              Skips::SomeOrOtherwise, SetsRunning::Never,
              "Ticks its child when an entry of the blackboard has been "
              "written since the last time."),
    decorator(NodeType::WhenDue, "WhenDue", In::Btcpp, Flow::Any, Skips::Some,
              SetsRunning::WithChild,
              "Ticks its child when the world says that it is due, and "
              "whenever it runs."),
    decorator(NodeType::GoalUpdater, "GoalUpdater", In::Btcpp, Flow::AsChild,
              Skips::Some, SetsRunning::Never,
              "Ticks its child with the goal that was sent last."),
    decorator(NodeType::PathLongerOnApproach, "PathLongerOnApproach", In::Btcpp,
              Flow::Any, Skips::Some, SetsRunning::First,
              "Ticks its child when the new path has become much longer close "
              "to the goal; else succeeds without it."),
    decorator(NodeType::SingleTrigger, "SingleTrigger", In::Btcpp, Flow::Any,
              Skips::Some, SetsRunning::First,
              "Ticks its child until that has ended once, then fails until it "
              "is reset."),
    decorator(NodeType::BlackboardCheck, "BlackboardCheck", In::Btcpp,
              Flow::Any, Skips::SomeOrOtherwise, SetsRunning::First,
              "Ticks its child where two values are equal, else answers what "
              "its `return_on_mismatch` says."),
    decorator(NodeType::OtherDecorator, "Decorator", In::Btcpp, Flow::Any,
              Skips::Never, SetsRunning::AsProgrammed,
              "A decorator of the program: it may tick and halt its child at "
              "any time, and answer anything."),
    leaf(NodeType::Script, "Script", In::Btcpp, Flow::Executes, Skips::Never,
         SetsRunning::Never, "Executes a script on the blackboard."),
    {NodeType::PolicyParallel, "PolicyParallel", In::PyTrees, 1, kAnyNumber,
     Flow::Any, Beside::Any, Ended::All, Skips::Never, SetsRunning::Never, "⇉",
     "Ticks all of its children in each tick; succeeds as its policy says, and "
     "fails when one fails."},
    {NodeType::EternalGuard, "EternalGuard", In::PyTrees, 2, 2, Flow::OnSuccess,
     Beside::TheLeft, Ended::All, Skips::Never, SetsRunning::Never, "◇",
     "Asks its first child in every tick, and ticks the second while that "
     "succeeds; when it fails, halts the second and fails."},
    decorator(NodeType::AnswerMap, "AnswerMap", In::PyTrees, Flow::Maps,
              Skips::Never, SetsRunning::Never,
              "Answers as its table says for what its child answers."),
    leaf(NodeType::AnswerQueue, "AnswerQueue", In::PyTrees, Flow::Queues,
         Skips::Never, SetsRunning::Never,
         "Gives answers in the order of its queue."),
}};

static_assert(is_indexed(kNodeTypes, &NodeTypeInfo::type));
static_assert(is_unique(kNodeTypes, &NodeTypeInfo::name));
}  // namespace node_rows

using node_rows::kNodeTypes;

constexpr const NodeTypeInfo& info_of(NodeType type) {
  return kNodeTypes[static_cast<std::size_t>(type)];
}
constexpr std::string_view type_name(NodeType type) {
  return info_of(type).name;
}
constexpr bool is_leaf(NodeType type) {
  return info_of(type).max_children == 0;
}

// The types that .btf files have.
inline std::vector<NodeTypeInfo> btf_node_types() {
  std::vector<NodeTypeInfo> found(kNodeTypes.begin(), kNodeTypes.end());
  std::erase_if(found, [](const auto& info) { return !has(info.in, In::Btf); });
  return found;
}

}  // namespace btcheck
