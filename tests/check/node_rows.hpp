// SPDX-License-Identifier: MIT
//
// XML trees of every type of node with children, for what holds of them all.
#pragma once

#include <map>
#include <string>

#include "check/asked.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {

// How XML trees write a type with two children; nothing where none has two.
inline const std::map<NodeType, std::string> kInXml = {
    {NodeType::Sequence, "Sequence"},
    {NodeType::Fallback, "Fallback"},
    {NodeType::SequenceWithMemory, "SequenceWithMemory"},
    {NodeType::ReactiveSequence, "ReactiveSequence"},
    {NodeType::ReactiveFallback, "ReactiveFallback"},
    {NodeType::Parallel, "Parallel success_count=\"2\""},
    {NodeType::ParallelAll, "ParallelAll max_failures=\"1\""},
    {NodeType::Recovery, "RecoveryNode number_of_retries=\"1\""},
    {NodeType::RoundRobin, "RoundRobin"},
    {NodeType::PipelineSequence, "PipelineSequence"},
    {NodeType::AsyncSequence, "AsyncSequence"},
    {NodeType::AsyncFallback, "AsyncFallback"},
    {NodeType::IfThenElse, "IfThenElse"},
    {NodeType::WhileDoElse, "WhileDoElse"},
    {NodeType::Switch, ""},
    {NodeType::TryCatch, "TryCatch"},
    {NodeType::NonblockingSequence, "NonblockingSequence"},
    {NodeType::PersistentSequence,
     "PersistentSequence current_child_idx=\"{at}\""},
    {NodeType::PauseResumeController, ""},
    {NodeType::OtherControl, ""},
    {NodeType::PolicyParallel,
     "Parallel policy=\"SuccessOnAll\" synchronise=\"false\""},
    {NodeType::EternalGuard, "EternalGuard"}};

inline bool is_of_nav2(NodeType type) {
  return type == NodeType::Recovery || type == NodeType::RoundRobin ||
         type == NodeType::PipelineSequence ||
         type == NodeType::NonblockingSequence ||
         type == NodeType::PersistentSequence;
}

inline Profile profile_with(NodeType type) {
  const bool is_of_py_trees =
      type == NodeType::PolicyParallel || type == NodeType::EternalGuard;
  return is_of_py_trees     ? Profile::PyTrees
         : is_of_nav2(type) ? Profile::Nav2Main
                            : Profile::Btcpp4;
}

// `n` of this type over a condition C and an action A.
inline Asked over_condition_and_action(NodeType type) {
  const std::string& written = kInXml.at(type);
  const std::string id = written.substr(0, written.find(' '));
  return {"<" + written + " name=\"n\"><C/><A/></" + id + ">",
          "(defaction A :returns (success failure running))",
          profile_with(type), true,
          "<TreeNodesModel><Condition ID=\"C\"/></TreeNodesModel>"};
}

}  // namespace btcheck
