// SPDX-License-Identifier: MIT
#include "model/export/conversion.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "model/export/told.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

using Type = NodeType;

constexpr std::string_view kInBetween =
    "the engine's answers running in between where its child ends in the tick "
    "in which it began";
constexpr std::string_view kKeepsOthers =
    "the engine's halts all other children while one runs";

constexpr std::array<Counterpart, 23> kCounterparts = {{
    {Type::BehaviorTree, "BehaviorTree"},
    {Type::Sequence, "Sequence"},
    {Type::Fallback, "Fallback"},
    {Type::SequenceWithMemory, "SequenceWithMemory", kInBetween},
    {Type::ReactiveSequence, "ReactiveSequence", kKeepsOthers},
    {Type::ReactiveFallback, "ReactiveFallback", kKeepsOthers},
    {Type::Parallel, "Parallel",
     "the engine's decides as soon as enough children have answered, and does "
     "not tick the others then"},
    {Type::ParallelAll, "Parallel",
     "the engine's decides as soon as enough children have answered, and does "
     "not tick the others then"},
    {Type::Inverter, "Inverter"},
    {Type::ForceSuccess, "ForceSuccess"},
    {Type::ForceFailure, "ForceFailure"},
    {Type::KeepRunningUntilFailure, "KeepRunningUntilFailure"},
    {Type::Repeat, "Repeat", kInBetween},
    {Type::RetryUntilSuccessful, "RetryUntilSuccessful", kInBetween},
    {Type::RateController, "RateController",
     "the engine's counts from the child's last success, and ticks it at once "
     "when it is called anew"},
    {Type::Recovery, "RecoveryNode"},
    {Type::RoundRobin, "RoundRobin",
     "the engine's goes on with the next child after a success also where it "
     "was halted in between"},
    {Type::PipelineSequence, "PipelineSequence"},
    {Type::SubTree, "SubTree"},
    {Type::Timeout, "Timeout"},
    {Type::Wait, "Sleep"},
    {Type::Action, "",
     "what an action of the engine has answered may stand until it is reset; "
     "`:answers anew` in a file of leaf contracts says that it does not"},
    {Type::Condition, ""},
}};

}  // namespace

const Counterpart* counterpart_of(NodeType type) {
  const auto* found =
      std::ranges::find(kCounterparts, type, &Counterpart::type);
  return found == kCounterparts.end() ? nullptr : found;
}

namespace conversion {

void Told::error(const Node& node, std::string message, std::string help) {
  add(Severity::Error, "BT0010", node, std::move(message), std::move(help));
}

void Told::left_out(const Node& node, std::string message, std::string help) {
  add(Severity::Warning, "BT0011", node, std::move(message), std::move(help));
}

void Told::differs(const Node& node) {
  const Counterpart* other = counterpart_of(node.type);
  if (other == nullptr || other->differs.empty()) return;
  if (!told_types_.insert(node.type).second) return;
  add(Severity::Note, "BT0012", node,
      std::string(type_name(node.type)) +
          " differs: " + std::string(other->differs),
      "");
}

void Told::add(Severity severity, std::string_view code, const Node& node,
               std::string message, std::string help) {
  const bool is_here = node.included == 0;
  Diagnostic found =
      source_.diagnostic(severity, code, is_here ? node.span : SourceSpan{},
                         std::move(message), "", std::move(help));
  if (!is_here) {
    found.file = tree_.included.at(node.included - 1);
    found.span = node.span;
  }
  found_.push_back(std::move(found));
}

std::vector<NodeId> subtrees_of(const BehaviorTree& tree) {
  std::vector<NodeId> first = tree.roots;
  std::set<std::string> known;
  for (const NodeId root : tree.roots) known.insert(tree.node(root).name);
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const Node& node = tree.nodes[i];
    if (node.type == NodeType::SubTree &&
        known.insert(tree_name(node)).second) {
      first.push_back(NodeId{i});
    }
  }
  return first;
}

std::string tree_name(const Node& node) {
  if (node.type == NodeType::BehaviorTree) return node.name;
  return node.id.empty() || node.id == "SubTree" ? node.name : node.id;
}

}  // namespace conversion
}  // namespace btcheck
