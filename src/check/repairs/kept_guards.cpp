// SPDX-License-Identifier: MIT
#include "check/repairs/kept_guards.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "check/findings/facts.hpp"
#include "model/tree/answers.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostLeaves = 1'000;

std::vector<NodeId> leaves_of(const BehaviorTree& tree) {
  std::vector<NodeId> leaves;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (is_leaf(tree.nodes[n].type)) leaves.push_back(NodeId{n});
  }
  return leaves;
}

// A leaf in another tree: by its place, and which of those that stand there.
class SameLeaf {
 public:
  SameLeaf(const BehaviorTree& before, const BehaviorTree& after,
           const EditedFiles& edits)
      : of_(before.nodes.size()) {
    std::map<std::tuple<std::string, int, int>, std::vector<NodeId>> there;
    for (const NodeId leaf : leaves_of(after)) {
      const SourcePlace place = place_of(after, leaf);
      there[{place.file, place.line, place.column}].push_back(leaf);
    }
    std::map<std::tuple<std::string, int, int>, std::size_t> seen;
    for (const NodeId leaf : leaves_of(before)) {
      const auto place = edits.moved(place_of(before, leaf));
      if (!place) continue;
      const std::tuple key(place->file, place->line, place->column);
      const std::size_t number = seen[key]++;
      const auto& alike = there[key];
      if (number < alike.size()) of_[index(leaf)] = alike[number];
    }
  }

  // Nothing where it is not there any more.
  std::optional<NodeId> operator[](NodeId leaf) const {
    return of_[index(leaf)];
  }

 private:
  static SourcePlace place_of(const BehaviorTree& tree, NodeId node) {
    const SourceSpan& span = tree.node(node).span;
    return {tree.file_of(node), span.line, span.column};
  }

  std::vector<std::optional<NodeId>> of_;  // by node
};

// That it is asked, or done, in each tick is what these are about.
bool is_about_asking(std::string_view code) {
  return code == "BT2210" || code == "BT2211";
}

bool is_below(const BehaviorTree& tree, NodeId node, NodeId above) {
  while (node != above && !tree.node(node).is_root()) {
    node = tree.node(node).parent;
  }
  return node == above;
}

// The finding speaks of the leaf, or of a branch with it but not the other.
bool is_spoken_of(const BehaviorTree& tree, const std::vector<NodeId>& about,
                  NodeId asked, NodeId running) {
  return std::ranges::any_of(about, [&](NodeId node) {
    return is_below(tree, asked, node) && !is_below(tree, running, node);
  });
}

// A branch of WhileDoElse is no question to the other.
bool is_other_branch(const BehaviorTree& tree, NodeId asked, NodeId running) {
  const auto fork = fork_of(tree, asked, running);
  return fork && fork->one > 0 &&
         tree.node(fork->node).type == NodeType::WhileDoElse;
}

// Each leaf that says yes or no, beside each that may run.
bool asks_as_before(const BehaviorTree& before, const BehaviorTree& after,
                    const SameLeaf& same, const std::vector<NodeId>& about) {
  const auto answers = possible_answers(before);
  const auto leaves = leaves_of(before);
  for (const NodeId running : leaves) {
    const auto runs = same[running];
    if (!answers[index(running)].runs || !runs) continue;
    for (const NodeId asked : leaves) {
      const Answers& of = answers[index(asked)];
      if (asked == running || !of.success || !of.failure) continue;
      if (!is_ticked_while(before, asked, running) ||
          is_other_branch(before, asked, running) ||
          is_spoken_of(before, about, asked, running)) {
        continue;
      }
      const auto still = same[asked];
      if (still && !is_ticked_while(after, *still, *runs)) return false;
    }
  }
  return true;
}

// Whether some root can succeed where the leaf always answers the one thing.
bool can_succeed(BehaviorTree& tree, NodeId leaf, bool succeeds) {
  LeafContract& contract = tree.nodes[index(leaf)].contract;
  const LeafContract kept = contract;
  contract.may_succeed = succeeds;
  contract.may_fail = !succeeds;
  const auto answers = possible_answers(tree);
  contract = kept;
  return std::ranges::any_of(
      tree.roots, [&](NodeId root) { return answers[index(root)].success; });
}

bool fails_as_before(BehaviorTree before, BehaviorTree after,
                     const SameLeaf& same, std::string_view code,
                     const std::vector<NodeId>& about) {
  const auto answers = possible_answers(before);
  const bool could = std::ranges::any_of(
      before.roots, [&](NodeId root) { return answers[index(root)].success; });
  if (!could) return true;
  for (const NodeId leaf : leaves_of(before)) {
    const auto now = same[leaf];
    const LeafContract& contract = before.node(leaf).contract;
    const bool is_open = before.node(leaf).type == NodeType::Condition &&
                         contract.may_succeed && contract.may_fail;
    // A loop that gets a way out did not fail before: it went on.
    const bool is_meant =
        code == "BT2215"
            ? is_spoken_of(before, about, leaf, before.roots.front())
            : std::ranges::count(about, leaf) > 0;
    if (!now || !is_open || is_meant) continue;
    for (const bool succeeds : {true, false}) {
      if (!can_succeed(before, leaf, succeeds) &&
          can_succeed(after, *now, succeeds)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

bool keeps_guards(const BehaviorTree& before, const BehaviorTree& after,
                  const EditedFiles& edits, std::string_view code,
                  const std::vector<NodeId>& about) {
  if (leaves_of(before).size() > kMostLeaves ||
      leaves_of(after).size() > kMostLeaves) {
    return false;
  }
  const SameLeaf same(before, after, edits);
  const std::vector<NodeId> none;
  return asks_as_before(before, after, same,
                        is_about_asking(code) ? about : none) &&
         fails_as_before(before, after, same, code, about);
}

}  // namespace btcheck
