// SPDX-License-Identifier: MIT
//
// The types of nodes: one row of facts for each, all that depends on the type
// alone. What a type does is its drawing, in mapping/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

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
  AnswerQueue      // py_trees: StatusQueue, TickCounter, Periodic, …
};
inline constexpr std::size_t kNodeTypeCount = 51;

// Which trees have the type.
enum class In : std::uint8_t { Btf, Xml, Both };

// What a node ticks besides a child that runs, in the ticks after the first.
enum class Beside : std::uint8_t {
  None,     // it resumes that child: no guard to its left is asked again
  TheLeft,  // it is reactive: all to the left are ticked before it, each time
  Counted,  // all that have not ended; it decides by how many have ended how
  Any       // other children, too; or it has no other
};

// Which of its children the tick gets to, and what it answers by them.
enum class Flow : std::uint8_t {
  Leaf,
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
};
// Indexed by NodeType.
std::span<const NodeTypeInfo, kNodeTypeCount> node_types();
const NodeTypeInfo& info_of(NodeType type);
// The types that .btf files have.
const std::vector<NodeTypeInfo>& btf_node_types();
std::string_view type_name(NodeType type);
bool is_leaf(NodeType type);

}  // namespace btcheck
