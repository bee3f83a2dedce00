// SPDX-License-Identifier: MIT
//
// The advice is about what can be changed without changing the mission: how
// finely time and numbers are told apart, what may move by itself, and which
// answers a leaf can give at all.
#include "report/text/contribution_text.hpp"
#include "model/tree/node_types.hpp"

#include <fmt/format.h>

namespace btcheck {
namespace {

constexpr std::size_t kMostShown = 6;
constexpr double kLeastShown = 1.3;

std::string_view advice_for(const Node& node) {
  if (node.duration && node.duration->max > 0) {
    return "count in larger units, or give it a fixed :duration";
  }
  switch (node.type) {
    case NodeType::RateController:
      return "its timer counts ticks: raise :hz, or scale all times down";
    case NodeType::Action:
      return node.contract.may_run
                 ? "it may run for any number of ticks: :SF if it never runs"
                 : "defaction … :returns, if some answer is impossible";
    case NodeType::Condition:
      return "defcondition … :returns, if some answer is impossible";
    case NodeType::Repeat:
    case NodeType::RetryUntilSuccessful:
    case NodeType::Recovery:
      return "it counts its rounds: two often show what ten would";
    case NodeType::Parallel:
    case NodeType::ParallelAll:
      return "its children interleave; --reduce full explores one order";
    default:
      return "it remembers where it was and what it answered";
  }
}

std::string_view advice_for(const BehaviorTree& tree, StateVariableId id) {
  const StateVariable& variable = tree.variable(id);
  if (moves_freely(tree, id)) {
    return "it moves at any instant: :moves sampled, if only the tree looks";
  }
  return variable.is_enumeration() ? "merge values that no node tells apart"
                                   : "narrow :min and :max";
}

std::string part_name(const BehaviorTree& tree, const Contribution& part) {
  if (part.variable) return tree.variable(*part.variable).name;
  const Node& node = tree.node(*part.node);
  const std::string type(type_name(node.type));
  const std::string name = node.name.rfind(type, 0) == 0
                               ? node.name
                               : fmt::format("{} {}", type, node.name);
  return fmt::format("{} ({})", name, line_of(tree, *part.node));
}

}  // namespace

std::string contribution_text(const BehaviorTree& tree,
                              std::span<const Contribution> parts) {
  std::string text;
  std::size_t shown = 0;
  for (const Contribution& part : parts) {
    if (part.factor < kLeastShown || shown++ == kMostShown) break;
    const std::string name = part_name(tree, part);
    text +=
        fmt::format("  x {:>6.1f}  {}\n             {}\n", part.factor, name,
                    part.variable ? advice_for(tree, *part.variable)
                                  : advice_for(tree.node(*part.node)));
  }
  if (text.empty()) return text;
  return "What multiplies the states, and what would help\n" + text;
}

}  // namespace btcheck
