// SPDX-License-Identifier: MIT
#include "check/findings/facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "model/tree/leaf_names.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"
#include "text/findings.hpp"
#include "text/wildcards.hpp"

namespace btcheck {

template <class Key>
TreeFacts::UsesBy::UsesBy(const std::vector<EntryUse>& uses, std::size_t keys,
                          Key key)
    : first_(keys + 1), sorted_(uses.size()) {
  for (const EntryUse& use : uses) ++first_[key(use) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::uint32_t> next = first_;
  for (const EntryUse& use : uses) sorted_[next[key(use)]++] = &use;
}

TreeFacts::TreeFacts(const NormalTree& normal)
    : normal_(normal),
      tree_(normal.tree()),
      of_node_(tree_.entry_uses, tree_.nodes.size(),
               [](const EntryUse& use) { return index(use.node); }),
      of_entry_(tree_.entry_uses, tree_.entries.size(),
                [](const EntryUse& use) { return use.entry; }),
      answers_(possible_answers(tree_)),
      end_(tree_.nodes.size()),
      may_run_(tree_.nodes.size()) {
  const BehaviorTree& tree = tree_;
  for (std::uint32_t n = static_cast<std::uint32_t>(end_.size()); n-- > 0;) {
    const Node& node = tree.nodes[n];
    end_[n] = node.children.empty() ? n + 1 : end_[index(node.children.back())];
    may_run_[n] = is_leaf(node.type) && answers_[n].runs;
    has_meanings_ = has_meanings_ || node.contract.meaning != LeafMeaning{};
    for (const NodeId child : node.children) {
      if (may_run_[index(child)]) may_run_[n] = true;
    }
  }
  deeds_before_ = {0};
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    deeds_before_.push_back(deeds_before_.back() +
                            (is_deed(NodeId{n}) ? 1 : 0));
  }
}

std::vector<NodeId> TreeFacts::subtree(NodeId node) const {
  std::vector<NodeId> nodes;
  ask_budget();
  for (std::uint32_t n = index(node); n < end_[index(node)]; ++n) {
    nodes.push_back(NodeId{n});
  }
  return nodes;
}

std::vector<NodeId> TreeFacts::leaves(NodeId node) const {
  std::vector<NodeId> found = subtree(node);
  std::erase_if(found,
                [&](NodeId each) { return !is_leaf(tree_.node(each).type); });
  return found;
}

bool TreeFacts::is_condition(NodeId id) const {
  const Node& of = node(id);
  if (of.type == NodeType::SetSV) return true;
  if (of.type == NodeType::Condition) return !only_sends(of.id);
  if (of.type == NodeType::Eval) return !of.assignment;
  if (of.type == NodeType::Script) return of.answers_value;
  return is_taken_for_condition(of);
}

bool TreeFacts::is_deed(NodeId id) const {
  const NodeType type = node(id).type;
  return (type == NodeType::Action || type == NodeType::Condition) &&
         !is_condition(id) && node(id).contract.meaning.tells_only != true;
}

std::optional<bool> TreeFacts::said(NodeId whole, Meaning meaning) const {
  if (!has_meanings_) return std::nullopt;
  std::optional<bool> all;
  for (const NodeId leaf : leaves(whole)) {
    const bool counts = leaf == whole || is_deed(leaf);
    if (!counts || is_constant(leaf)) continue;
    const auto& one = node(leaf).contract.meaning.*meaning;
    if (one == false) return false;
    all = one && all.value_or(true);
  }
  return all == true ? all : std::nullopt;
}

std::optional<bool> TreeFacts::said(const std::vector<NodeId>& nodes,
                                    Meaning meaning) const {
  bool is_yes = !nodes.empty();
  for (const NodeId each : nodes) {
    const auto one = said(each, meaning);
    if (one == false) return false;
    is_yes = is_yes && one;
  }
  return is_yes ? std::optional(true) : std::nullopt;
}

bool TreeFacts::is_named(NodeId leaf,
                         const std::vector<std::string>& names) const {
  const Node& of = node(leaf);
  return std::ranges::any_of(names, [&](const std::string& name) {
    return name == of.id || name == of.name || matches_wildcard(name, of.path);
  });
}

bool TreeFacts::only_tells(NodeId leaf) const {
  return node(leaf).contract.meaning.tells_only.value_or(
      btcheck::only_tells(node(leaf).id));
}

bool TreeFacts::is_constant(NodeId id) const {
  return node(id).id == "AlwaysSuccess" || node(id).id == "AlwaysFailure";
}

std::size_t TreeFacts::deeds(NodeId node) const {
  return deeds_before_[end_[index(node)]] - deeds_before_[index(node)];
}

NodeId TreeFacts::core(NodeId id) const {
  while (info_of(node(id).type).flow == Flow::AsChild) {
    id = node(id).children[0];
  }
  return id;
}

bool TreeFacts::is_relied_on(NodeId id) const {
  for (; !is_root(id); id = parent(id)) {
    const Node& above = node(parent(id));
    const Flow flow = info_of(above.type).flow;
    if (flow == Flow::OnSuccess) {
      if (place_of(id) + 1 < above.children.size()) return true;
      continue;
    }
    if (flow != Flow::AsChild && flow != Flow::Retries &&
        flow != Flow::Recovers) {
      return flow == Flow::Repeats || flow == Flow::UntilFailure;
    }
  }
  return false;
}

std::optional<LocationRole> TreeFacts::decided(NodeId above, NodeId child,
                                               LocationRole answer) const {
  const Node& of = node(above);
  const bool fails = answer == LocationRole::Failure;
  const bool is_last = of.children.back() == child;
  const auto count = static_cast<int>(of.children.size());
  const auto where = [&](bool is_so) {
    return is_so ? std::optional(answer) : std::nullopt;
  };
  switch (info_of(of.type).flow) {
    case Flow::AsChild:
      return answer;
    case Flow::Inverts:
      return fails ? LocationRole::Success : LocationRole::Failure;
    case Flow::OnSuccess:
      return where(fails || is_last);
    case Flow::OnFailure:
      return where(!fails || is_last);
    case Flow::Repeats:
      return where(fails);
    default:
      return where(of.type == NodeType::Parallel && fails &&
                   threshold_of(of.failure_threshold, count) == 1);
  }
}

bool TreeFacts::fails_with(NodeId above, NodeId below) const {
  auto answer = std::optional(LocationRole::Failure);
  for (; answer && parent(below) != above; below = parent(below)) {
    answer = decided(parent(below), below, *answer);
  }
  return answer == LocationRole::Failure;
}

std::size_t TreeFacts::place_of(NodeId id) const {
  const auto& children = node(parent(id)).children;
  // They are numbered in pre-order.
  return static_cast<std::size_t>(
      std::ranges::lower_bound(children, index(id), {},
                               [](NodeId child) { return index(child); }) -
      children.begin());
}

NodeId TreeFacts::child_with(NodeId above, NodeId node) const {
  const auto& children = tree_.node(above).children;
  return *std::prev(std::ranges::upper_bound(children, node));
}

std::string TreeFacts::told(NodeId node) const {
  if (names_.empty()) names_ = short_names(normal_.written());
  return "`" + names_[index(normal_.shown(node))] + "`";
}

std::string TreeFacts::told(const std::vector<NodeId>& nodes) const {
  std::vector<std::string> names;
  for (const NodeId each : nodes) names.push_back(told(each));
  return enumerated(names);
}

std::string TreeFacts::few(const std::vector<NodeId>& nodes) const {
  if (nodes.size() <= 3) return told(nodes);
  return fmt::format("{}, {} and {} more", told(nodes[0]), told(nodes[1]),
                     nodes.size() - 2);
}

SourcePlace TreeFacts::place(NodeId id) const {
  const SourceSpan& span = node(id).span;
  return {tree_.file_of(id), span.line, span.column};
}

SourcePlace TreeFacts::whole(NodeId id) const {
  const NodeId outermost = normal_.outermost(id);
  const SourceSpan& span = normal_.written().node(outermost).span;
  return {normal_.written().file_of(outermost), span.line, span.column};
}

std::string TreeFacts::type_word(NodeId id) const {
  const Node& of = node(id);
  return is_engine(tree_.profile) && !of.id.empty()
             ? of.id
             : std::string(type_name(of.type));
}

bool TreeFacts::has_scripts() const {
  return is_engine(tree_.profile) && !is_release_3(tree_.profile);
}

bool is_taken_for_condition(const Node& node) {
  return node.type == NodeType::Action && node.is_guessed &&
         sounds_like_condition(node.id);
}

bool is_ticked_while(const BehaviorTree& tree, NodeId node, NodeId running) {
  const auto fork = fork_of(tree, node, running);
  if (!fork) return root_of(tree, node) != root_of(tree, running);
  const Beside beside = info_of(tree.node(fork->node).type).beside;
  return beside == Beside::TheLeft ? fork->one < fork->other
                                   : beside != Beside::None;
}

bool resumes(const Node& node) {
  return info_of(node.type).beside == Beside::None;
}

bool is_reactive(const Node& node) {
  return info_of(node.type).beside == Beside::TheLeft;
}

bool is_endless(const Node& node) {
  return node.type == NodeType::KeepRunningUntilFailure ||
         ((node.type == NodeType::Repeat ||
           node.type == NodeType::RetryUntilSuccessful) &&
          node.repetitions == kEndlessRounds);
}

}  // namespace btcheck
