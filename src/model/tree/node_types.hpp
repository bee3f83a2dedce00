// SPDX-License-Identifier: MIT
//
// The types of nodes: one row each, of which everything is asked that depends
// on the type alone. What a type does stands in mapping/, one drawing each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

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
  // In XML trees only.
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
  Script           // Script, ScriptCondition, SetBlackboard, …
};
inline constexpr std::size_t kNodeTypeCount = 47;
// Of the types before AsyncSequence, which .btf files have.
inline constexpr std::size_t kBtfTypeCount = 24;

// What a node ticks besides a child that runs, in the ticks after the first.
enum class Beside : std::uint8_t {
  None,     // it resumes that child: no guard to its left is asked again
  TheLeft,  // it is reactive: all to the left are ticked before it, each time
  Any       // other children, too; or it has no other
};

// One row for each node type. kAnyNumber when there is no upper end.
inline constexpr int kAnyNumber = 1 << 20;
struct NodeTypeInfo {
  NodeType type;
  std::string_view name;
  int min_children;
  int max_children;
  Beside beside = Beside::Any;
  std::string_view sign = "";  // in pictures, of nodes with several children
};
// Indexed by NodeType.
std::span<const NodeTypeInfo, kNodeTypeCount> node_types();
std::span<const NodeTypeInfo, kBtfTypeCount> btf_node_types();
std::string_view type_name(NodeType type);
bool is_leaf(NodeType type);
Beside ticked_beside(NodeType type);

}  // namespace btcheck
