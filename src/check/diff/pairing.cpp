// SPDX-License-Identifier: MIT
#include "check/diff/pairing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// Names from below the root down to the node, without lines.
std::string place_of(const BehaviorTree& tree, NodeId node) {
  std::string place = stable_name(tree.node(node));
  for (NodeId at = node; !tree.node(at).is_root();) {
    at = tree.node(at).parent;
    if (!tree.node(at).is_root()) {
      place = stable_name(tree.node(at)) + '/' + place;
    }
  }
  return place;
}

using Nodes = std::vector<NodeId>;

// Takes equal places out of both, in their order.
template <class Pair>
void pair_places(const BehaviorTree& one, Nodes& of_one,
                 const BehaviorTree& other, Nodes& of_other, Pair pair) {
  std::multimap<std::string, NodeId> places;
  for (const NodeId node : of_other)
    places.emplace(place_of(other, node), node);
  std::erase_if(of_one, [&](NodeId node) {
    const auto found = places.find(place_of(one, node));
    if (found == places.end()) return false;
    pair(node, found->second);
    std::erase(of_other, found->second);
    places.erase(found);
    return true;
  });
}

std::set<std::string> entries_of_ports(const BehaviorTree& tree, NodeId node) {
  std::set<std::string> names;
  for (const EntryUse& use : tree.entry_uses) {
    if (use.node == node && use.is_port) names.insert(tree.entries[use.entry]);
  }
  return names;
}

bool names_entry(std::string_view value) { return value.starts_with('{'); }

std::string value_of(const Node& node, std::string_view key) {
  const auto found = std::ranges::find(node.arguments, key, &Argument::key);
  return found == node.arguments.end() ? "nothing" : found->value;
}

}  // namespace

std::vector<NodePair> paired(const BehaviorTree& one,
                             std::span<const NodeId> of_one,
                             const BehaviorTree& other,
                             std::span<const NodeId> of_other) {
  std::map<std::string, std::pair<Nodes, Nodes>> called;
  for (const NodeId node : of_one) {
    called[stable_name(one.node(node))].first.push_back(node);
  }
  for (const NodeId node : of_other) {
    called[stable_name(other.node(node))].second.push_back(node);
  }
  std::map<NodeId, NodeId> partner;
  std::vector<NodePair> alone;
  for (auto& [name, nodes] : called) {
    auto& [here, there] = nodes;
    const auto pair = [&](NodeId first, NodeId second) {
      partner[first] = second;
    };
    if (here.size() > 1 || there.size() > 1) {
      pair_places(one, here, other, there, pair);
    }
    const std::size_t both = std::min(here.size(), there.size());
    for (std::size_t i = 0; i < both; ++i) pair(here[i], there[i]);
    for (std::size_t i = both; i < there.size(); ++i) {
      alone.push_back({std::nullopt, there[i]});
    }
  }
  std::vector<NodePair> pairs;
  for (const NodeId node : of_one) {
    const auto found = partner.find(node);
    pairs.push_back({node, found == partner.end()
                               ? std::nullopt
                               : std::optional(found->second)});
  }
  std::ranges::sort(alone, {},
                    [](const NodePair& each) { return *each.other; });
  pairs.insert(pairs.end(), alone.begin(), alone.end());
  return pairs;
}

std::vector<NodeId> leaves_of_world(const BehaviorTree& tree) {
  std::vector<NodeId> leaves;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    const bool asks = node.type == NodeType::Action ||
                      node.type == NodeType::Condition ||
                      node.type == NodeType::SetSV;
    const bool is_constant =
        is_engine(tree.profile) &&
        (node.id == "AlwaysSuccess" || node.id == "AlwaysFailure");
    if (asks && !is_constant) leaves.push_back(NodeId{n});
  }
  return leaves;
}

std::vector<NodeId> all_nodes(const BehaviorTree& tree) {
  std::vector<NodeId> nodes;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    nodes.push_back(NodeId{n});
  }
  return nodes;
}

std::string told_otherwise(const BehaviorTree& one, NodeId of_one,
                           const BehaviorTree& other, NodeId of_other) {
  const Node& was = one.node(of_one);
  const Node& is = other.node(of_other);
  std::string told;
  const auto add = [&](const std::string& text) {
    told += told.empty() ? text : ", " + text;
  };
  if (was.id != is.id) add(fmt::format("type {} instead of {}", is.id, was.id));
  std::set<std::string> keys;
  for (const Node* node : {&was, &is}) {
    for (const Argument& each : node->arguments) keys.insert(each.key);
  }
  bool entries_differ = false;
  for (const std::string& key : keys) {
    const std::string then = value_of(was, key);
    const std::string now = value_of(is, key);
    if (then == now) continue;
    if (names_entry(then) && names_entry(now)) {
      entries_differ = true;
    } else {
      add(fmt::format("`{}` {} instead of {}", key, now, then));
    }
  }
  if (entries_differ &&
      entries_of_ports(one, of_one) != entries_of_ports(other, of_other)) {
    add("other blackboard entries");
  }
  return told;
}

}  // namespace btcheck
