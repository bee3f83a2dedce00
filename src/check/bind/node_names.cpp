// SPDX-License-Identifier: MIT
//
// One pass over the nodes for each reference: property files are short.
#include "check/bind/node_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "check/bind/name_help.hpp"
#include "text/numbers.hpp"

namespace btcheck {
namespace {

// "land@23" → "land", 23.
struct AtLine {
  std::string_view name;
  std::optional<std::uint32_t> line;
};
AtLine split_line(std::string_view reference) {
  const std::size_t at = reference.rfind('@');
  if (at == std::string_view::npos) return {reference, {}};
  return {reference.substr(0, at),
          as_number<std::uint32_t>(reference.substr(at + 1))};
}

bool same_name(std::string_view written, std::string_view name, bool any_case) {
  return any_case ? equal_ignoring_case(written, name) : written == name;
}

// A path as written is the end of a node's whole path.
bool is_path_suffix(std::string_view written, std::string_view path,
                    bool any_case) {
  if (written.size() > path.size()) return false;
  const std::size_t start = path.size() - written.size();
  return same_name(written, path.substr(start), any_case) &&
         (start == 0 || path[start - 1] == '/');
}

}  // namespace

NodeNames::NodeNames(const BehaviorTree& tree)
    : tree_(tree), in_post_order_(post_order(tree)) {
  for (const StateVariable& variable : tree.variables) {
    first_process_ += variable.is_enumeration() ? 1 : 0;
  }
}

// "drone/8": enumerated state variables count first, then the nodes.
std::optional<NodeId> NodeNames::by_process(std::string_view reference) const {
  const std::size_t slash = reference.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto number = as_number<std::uint32_t>(reference.substr(slash + 1));
  if (!number || *number < first_process_ ||
      *number - first_process_ >= in_post_order_.size()) {
    return std::nullopt;
  }
  const bool is_root = std::ranges::any_of(tree_.roots, [&](NodeId root) {
    return equal_ignoring_case(reference.substr(0, slash),
                               tree_.node(root).name);
  });
  if (!is_root) return std::nullopt;
  return in_post_order_[*number - first_process_];
}

std::string NodeNames::references_to(const std::vector<NodeId>& nodes) const {
  return names_in_rules(tree_, nodes);
}

std::vector<NodeId> NodeNames::matches(std::string_view reference,
                                       bool any_case) const {
  const AtLine split = split_line(reference);
  std::vector<NodeId> found;
  if (split.name == "root") return found;
  if (const auto process = by_process(reference)) return {*process};
  for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
    const Node& node = tree_.nodes[i];
    if (split.line && static_cast<int>(*split.line) != node.span.line) {
      continue;
    }
    const bool fits =
        same_name(split.name, node.name, any_case) ||
        (!node.id.empty() && same_name(split.name, node.id, any_case)) ||
        same_name(split.name, unique_name(tree_, NodeId{i}), any_case) ||
        same_name(split.name, fmt::format("btn{}", i), any_case) ||
        is_path_suffix(split.name, path_name(tree_, NodeId{i}), any_case);
    if (fits) found.push_back(NodeId{i});
  }
  return found;
}

std::vector<NodeId> NodeNames::called(std::string_view reference) const {
  for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
    if (!reference.empty() && tree_.nodes[i].path == reference) {
      return {NodeId{i}};
    }
  }
  std::vector<NodeId> found = matches(reference, false);
  if (found.empty()) found = matches(reference, true);
  if (found.size() <= 1) return found;
  // A :name wins over another node's :ID of the same spelling.
  const std::string_view name = split_line(reference).name;
  std::vector<NodeId> named;
  std::ranges::copy_if(found, std::back_inserter(named), [&](NodeId node) {
    return equal_ignoring_case(tree_.node(node).name, name);
  });
  return named.size() == 1 ? named : found;
}

bool NodeNames::differs_in_case(std::string_view reference) const {
  return matches(reference, false).empty() && !matches(reference, true).empty();
}

std::string NodeNames::nearest_help(std::string_view reference) const {
  return nearest_help_in(tree_, *this, split_line(reference).name);
}

}  // namespace btcheck
