// SPDX-License-Identifier: MIT
//
// Nodes are stored in pre-order, so that the subtree of a node is the stretch
// of numbers that begins with it, and one backward or forward pass over the
// nodes replaces every recursion.
#include "model/tree/tree.hpp"
#include "model/tree/node_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace btcheck {
namespace {

// How many nodes have the name, and how many of these stand in its line.
struct Bearers {
  std::size_t of_name = 0;
  std::size_t in_line = 0;
};

Bearers bearers_of(const BehaviorTree& tree, const Node& named) {
  Bearers bearers;
  for (const Node& other : tree.nodes) {
    if (other.name != named.name) continue;
    ++bearers.of_name;
    bearers.in_line += other.span.line == named.span.line;
  }
  return bearers;
}

std::string name_of_its_own(const BehaviorTree& tree, NodeId node) {
  const std::string& path = tree.node(node).path;
  return path.empty() ? unique_name(tree, node) : path;
}

std::string short_name_among(const BehaviorTree& tree, NodeId node,
                             const Bearers& bearers) {
  const Node& named = tree.node(node);
  if (bearers.of_name == 1) return named.name;
  if (bearers.in_line > 1) return name_of_its_own(tree, node);
  return fmt::format("{}@{}", named.name, named.span.line);
}

}  // namespace

std::optional<Profile> profile_named(std::string_view name) {
  const auto found = std::ranges::find(kProfiles, name, &ProfileRow::name);
  if (found == kProfiles.end()) return std::nullopt;
  return static_cast<Profile>(found - kProfiles.begin());
}

std::string release_text(int release) {
  return fmt::format("{}.{}.{}", release / 10'000, release / 100 % 100,
                     release % 100);
}

std::span<const std::string_view> status_names(Profile profile) {
  if (profile == Profile::PyTrees) return kPyTreesStatusNames;
  if (is_engine(profile)) return kEngineStatusNames;
  return kStatusNames;
}

std::string StateVariable::value_name(int value) const {
  const bool has_name =
      value >= 0 && static_cast<std::size_t>(value) < states.size();
  if (!has_name) return scale.text(value);
  const auto state = static_cast<std::size_t>(value);
  return states[alike.empty() ? state : static_cast<std::size_t>(alike[state])];
}

bool Node::is_root() const { return type == NodeType::BehaviorTree; }

const std::string& BehaviorTree::file_of(NodeId id) const {
  const std::uint32_t number = node(id).included;
  return number == 0 ? file : included[number - 1];
}

std::string unique_name(const BehaviorTree& tree, NodeId node) {
  return fmt::format("{}_btn{}", tree.node(node).name, index(node));
}

std::string short_name(const BehaviorTree& tree, NodeId node) {
  return short_name_among(tree, node, bearers_of(tree, tree.node(node)));
}

std::vector<std::string> short_names(const BehaviorTree& tree) {
  std::unordered_map<std::string_view, std::size_t> of_name;
  std::map<std::pair<std::string_view, int>, std::size_t> in_line;
  for (const Node& node : tree.nodes) {
    ++of_name[node.name];
    ++in_line[{node.name, node.span.line}];
  }
  std::vector<std::string> names;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    names.push_back(short_name_among(
        tree, NodeId{n},
        {of_name[node.name], in_line[{node.name, node.span.line}]}));
  }
  return names;
}

std::string name_and_line(const BehaviorTree& tree, NodeId node) {
  const Node& named = tree.node(node);
  return fmt::format("{} ({})",
                     bearers_of(tree, named).in_line == 1
                         ? named.name
                         : name_of_its_own(tree, node),
                     line_of(tree, node));
}

std::string stable_name(const Node& node) {
  const std::string type(type_name(node.type));
  return node.name == fmt::format("{}{}", type, node.span.line) ? type
                                                                : node.name;
}

std::string short_file(const BehaviorTree& tree, NodeId node) {
  const std::filesystem::path folder =
      std::filesystem::path(tree.file).parent_path();
  const std::filesystem::path file(tree.file_of(node));
  const std::string from_there = file.lexically_proximate(folder).string();
  return folder.empty() || from_there.empty() ? file.string() : from_there;
}

std::string line_of(const BehaviorTree& tree, NodeId node) {
  const int line = tree.node(node).span.line;
  return tree.node(node).included == 0
             ? fmt::format("line {}", line)
             : fmt::format("{}, line {}", short_file(tree, node), line);
}

std::string path_name(const BehaviorTree& tree, NodeId node) {
  if (tree.node(node).is_root()) return tree.node(node).name;
  std::vector<std::string_view> names;
  for (NodeId at = node; !tree.node(at).is_root(); at = tree.node(at).parent) {
    names.push_back(tree.node(at).name);
  }
  std::ranges::reverse(names);
  return fmt::format("{}", fmt::join(names, "/"));
}

// A pre-order with the children of each node visited from right to left is a
// post-order read backwards.
std::vector<NodeId> post_order(const BehaviorTree& tree) {
  std::vector<NodeId> result;
  result.reserve(tree.nodes.size());
  std::vector<NodeId> open(tree.roots.begin(), tree.roots.end());
  while (!open.empty()) {
    const NodeId node = open.back();
    open.pop_back();
    result.push_back(node);
    const std::vector<NodeId>& children = tree.node(node).children;
    open.insert(open.end(), children.begin(), children.end());
  }
  std::ranges::reverse(result);
  return result;
}

std::optional<Fork> fork_of(const BehaviorTree& tree, NodeId one,
                            NodeId other) {
  const auto way_from_root = [&](NodeId node) {
    std::vector<NodeId> way{node};
    while (!tree.node(node).is_root()) {
      way.push_back(node = tree.node(node).parent);
    }
    std::ranges::reverse(way);
    return way;
  };
  const std::vector<NodeId> to_one = way_from_root(one);
  const std::vector<NodeId> to_other = way_from_root(other);
  const auto [at_one, at_other] = std::mismatch(
      to_one.begin(), to_one.end(), to_other.begin(), to_other.end());
  if (at_one == to_one.begin() || at_one == to_one.end() ||
      at_other == to_other.end()) {
    return std::nullopt;
  }
  const NodeId node = *std::prev(at_one);
  const std::vector<NodeId>& children = tree.node(node).children;
  const auto position = [&](NodeId child) {
    return static_cast<std::size_t>(std::ranges::find(children, child) -
                                    children.begin());
  };
  return Fork{node, position(*at_one), position(*at_other)};
}

NodeId root_of(const BehaviorTree& tree, NodeId node) {
  while (!tree.node(node).is_root()) node = tree.node(node).parent;
  return node;
}

bool writes(const Node& node, StateVariableId variable) {
  const auto is_it = [&](const StateAssignment& assignment) {
    return assignment.variable == variable;
  };
  const auto script_writes = [&](const Script& script) {
    return std::ranges::any_of(script.assignments, is_it);
  };
  return (node.type == NodeType::SetSV && node.variable == variable) ||
         (node.assignment && is_it(*node.assignment)) ||
         std::ranges::any_of(node.contract.on_success, is_it) ||
         std::ranges::any_of(node.contract.on_failure, is_it) ||
         std::ranges::any_of(node.contract.on_running, is_it) ||
         std::ranges::find(node.contract.measures, variable) !=
             node.contract.measures.end() ||
         std::ranges::any_of(
             node.scripts,
             [&](const auto& each) { return script_writes(each.second); }) ||
         std::ranges::any_of(node.own_scripts, script_writes);
}

bool is_written(const BehaviorTree& tree, StateVariableId variable) {
  return std::ranges::any_of(
      tree.nodes, [&](const Node& node) { return writes(node, variable); });
}

bool moves_freely(const BehaviorTree& tree, StateVariableId variable) {
  const StateVariable& declared = tree.variable(variable);
  if (!declared.is_enumeration()) return declared.moves == Moves::Free;
  if (declared.moves != Moves::Default) return declared.moves == Moves::Free;
  return !is_written(tree, variable);
}

std::string duration_text(const Duration& duration) {
  return fmt::format(
      "[{},{}]", duration.min,
      duration.max == kEndless ? "inf" : std::to_string(duration.max));
}

}  // namespace btcheck
