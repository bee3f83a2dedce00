// SPDX-License-Identifier: MIT
//
// What the table of node types says of each, told by verdicts on trees of every
// profile.
#include <doctest/doctest.h>

#include <map>
#include <string>

#include "check/asked.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// How XML trees write a type with two children; nothing where none has two.
const std::map<NodeType, std::string> kInXml = {
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
    {NodeType::OtherControl, ""}};

bool is_of_nav2(NodeType type) {
  return type == NodeType::Recovery || type == NodeType::RoundRobin ||
         type == NodeType::PipelineSequence ||
         type == NodeType::NonblockingSequence ||
         type == NodeType::PersistentSequence;
}

TEST_CASE("what is ticked beside a running child is what the table says") {
  for (const NodeTypeInfo& info : node_types()) {
    if (info.max_children < 2) continue;
    CAPTURE(info.name);
    const auto written = kInXml.find(info.type);
    REQUIRE(written != kInXml.end());
    if (written->second.empty()) continue;
    const std::string id = written->second.substr(0, written->second.find(' '));
    const std::string tree =
        "<" + written->second + " name=\"n\"><C/><A/></" + id + ">";
    const Profile profile =
        is_of_nav2(info.type) ? Profile::Nav2Main : Profile::Btcpp4;
    const std::string told = verdicts(
        {tree, "(defaction A :returns (success failure running))", profile},
        "prove never C.ticked and A.status == running\n"
        "prove never A.running\n");
    // A is ticked, and so it may run.
    CHECK(told[1] == 'V');
    CHECK((told[0] == 'H') == (info.beside == Beside::None));
  }
}

}  // namespace
}  // namespace btcheck
