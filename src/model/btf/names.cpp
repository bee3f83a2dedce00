// SPDX-License-Identifier: MIT
//
// Names to nodes.
//
// Several nodes may share a name, and a subtree used twice doubles all of its
// names. A reference therefore looks around itself first: in the nearest copy
// of a BehaviorTree form, then in the one that contains that copy, and last in
// the whole file. Nodes are numbered in pre-order, so that what lies below a
// node is an interval of numbers.
#include "model/btf/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "model/btf/variables.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::btf {
namespace {

NodeId node_id(std::size_t number) {
  return NodeId{static_cast<std::uint32_t>(number)};
}

}  // namespace

NodeNames::NodeNames(const BehaviorTree& tree) : tree_(tree) {
  const std::size_t count = tree.nodes.size();
  scope_.resize(count);
  end_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const NodeId parent = tree.nodes[i].parent;
    const bool opens_scope = tree.node(parent).is_root() ||
                             tree.node(parent).type == NodeType::SubTree;
    scope_[i] = opens_scope ? parent : scope_[index(parent)];
    by_name_[name_key(tree.nodes[i].name)].push_back(node_id(i));
  }
  for (std::size_t i = count; i-- > 0;) {
    const std::vector<NodeId>& children = tree.nodes[i].children;
    end_[i] = children.empty() ? node_id(i + 1) : end_[index(children.back())];
  }
}

std::optional<NodeId> NodeNames::find(const Reading& reading, const Form& place,
                                      std::string_view word,
                                      NodeId from) const {
  if (const auto unique = find_unique_name(word)) return unique;
  const auto found = by_name_.find(name_key(word));
  if (found == by_name_.end()) {
    report_unknown(reading, place, word);
    return std::nullopt;
  }
  const std::vector<NodeId> meant = candidates(found->second, word, from);
  assert(!meant.empty());
  if (meant.size() > 1) {
    report_ambiguous(reading, place, word, meant);
    return std::nullopt;
  }
  reading.findings.case_warning(place.span, word,
                                tree_.node(meant.front()).name);
  return meant.front();
}

// `name_btnM`, where M is the number of a node called `name`.
std::optional<NodeId> NodeNames::find_unique_name(std::string_view word) const {
  constexpr std::string_view kInfix = "_btn";
  const std::size_t at = word.rfind(kInfix);
  if (at == std::string_view::npos) return std::nullopt;
  const auto number = whole_number(word.substr(at + kInfix.size()));
  if (!number || *number < 0 ||
      *number >= static_cast<long long>(tree_.nodes.size())) {
    return std::nullopt;
  }
  const NodeId id = node_id(static_cast<std::size_t>(*number));
  if (!equal_ignoring_case(tree_.node(id).name, word.substr(0, at))) {
    return std::nullopt;
  }
  return id;
}

// The nodes that a name may mean: in the innermost scope that has any, the
// ones in that very scope before those in subtrees of it, and those spelled
// exactly so before the others.
std::vector<NodeId> NodeNames::candidates(const std::vector<NodeId>& all,
                                          std::string_view word,
                                          NodeId from) const {
  NodeId scope = scope_[index(from)];
  auto first = all.begin();
  auto last = all.end();
  while (true) {
    first = std::lower_bound(all.begin(), all.end(), scope);
    last = std::lower_bound(first, all.end(), end_[index(scope)]);
    if (first != last) break;
    if (tree_.node(scope).is_root()) {
      first = all.begin();
      last = all.end();
      break;
    }
    scope = scope_[index(scope)];
  }
  std::vector<NodeId> meant(first, last);
  const auto prefer = [&](const auto& is_better) {
    std::vector<NodeId> better;
    std::copy_if(meant.begin(), meant.end(), std::back_inserter(better),
                 is_better);
    if (!better.empty()) meant = std::move(better);
  };
  prefer([&](NodeId id) { return scope_[index(id)] == scope; });
  prefer([&](NodeId id) { return tree_.node(id).name == word; });
  return meant;
}

void NodeNames::report_unknown(const Reading& reading, const Form& place,
                               std::string_view word) const {
  if (reading.findings.is_full()) return;
  std::vector<std::string> names;
  for (const auto& [key, nodes] : by_name_) {
    names.push_back(tree_.node(nodes.front()).name);
  }
  const std::string guess = did_you_mean(word, names);
  reading.findings.error(
      place.span,
      {"BT1014", fmt::format("unknown node `{}`", word),
       "no node has this name",
       guess.empty() ? fmt::format("there are {}", listed(names)) : guess});
}

void NodeNames::report_ambiguous(const Reading& reading, const Form& place,
                                 std::string_view word,
                                 const std::vector<NodeId>& candidates) const {
  if (reading.findings.is_full()) return;
  constexpr std::size_t kMost = 6;
  std::string choices;
  for (std::size_t i = 0; i < std::min(candidates.size(), kMost); ++i) {
    choices += i == 0 ? "" : i + 1 == candidates.size() ? " or " : ", ";
    choices += fmt::format("`{}` (line {})", unique_name(tree_, candidates[i]),
                           tree_.node(candidates[i]).span.line);
  }
  if (candidates.size() > kMost) choices += " and more";
  reading.findings.error(
      place.span,
      {"BT1014",
       fmt::format("`{}` is the name of {} nodes", word, candidates.size()),
       "which one is meant?", fmt::format("write {}", choices)});
}

}  // namespace btcheck::btf
