// SPDX-License-Identifier: MIT
//
// As XMLParser::instantiateTree of BehaviorTree.CPP 4.10: uids count in
// pre-order from 1, a SubTree has one of its own, and a node without a name is
// called by its type and uid.
#include "model/btcpp/expand/expansion.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>

#include "model/btcpp/expand/blackboard.hpp"
#include "model/btcpp/expand/node_checks.hpp"
#include "model/btcpp/expand/subtrees.hpp"
#include "model/btcpp/findings.hpp"

namespace btcheck {
namespace btcpp {
namespace {

constexpr std::size_t kMostNodes = 65535;  // a uid has 16 bits
// Of all paths together, so that long names cannot take all memory.
constexpr std::size_t kMostPathBytes = 64 << 20;

class Expander {
 public:
  explicit Expander(const BtcppDocument& document)
      : document_(document), findings_(document) {
    expansion_.document = &document;
  }

  Result<BtcppExpansion> expand(std::string_view wanted) {
    if (const BtcppTree* main = main_tree(wanted)) expand_from(*main);
    if (!findings_.has_error()) {
      check_nodes(expansion_, findings_);
      check_blackboard(expansion_, findings_);
    }
    Result<BtcppExpansion> result;
    if (!findings_.has_error()) result.value = std::move(expansion_);
    result.diagnostics = findings_.take();
    return result;
  }

 private:
  // A node that still has to be made.
  struct Pending {
    const BtcppTree* tree;
    std::uint32_t node;     // in the tree
    std::uint32_t subtree;  // in the expansion
    std::uint32_t parent;   // in the expansion
  };

  const BtcppTree* main_tree(std::string_view wanted) {
    if (wanted.empty() && document_.main_tree) wanted = *document_.main_tree;
    const BtcppTree* tree = document_.tree(wanted);
    if (tree != nullptr) return tree;
    if (document_.trees.empty()) {
      findings_.error({}, {"BT1611", "there is no tree in this file", "",
                           "a tree is written `<BehaviorTree ID=\"…\">`"});
      return nullptr;
    }
    std::vector<std::string> ids;
    for (const BtcppTree& each : document_.trees) ids.push_back(each.id);
    if (wanted.empty()) {
      findings_.error(
          {}, {"BT1611", "it is open which tree runs", "",
               fmt::format("name one by --main-tree, or in "
                           "`<root main_tree_to_execute=\"…\">`; there are {}",
                           listed(ids))});
    } else {
      std::string help = did_you_mean(wanted, ids);
      if (help.empty()) help = fmt::format("there are {}", listed(ids));
      findings_.error(
          {}, {"BT1611", fmt::format("no tree is called `{}`", wanted), "",
               std::move(help)});
    }
    return nullptr;
  }

  void expand_from(const BtcppTree& main) {
    BtcppSubtree whole;
    whole.tree = &main;
    expansion_.subtrees.push_back(std::move(whole));
    if (!main.nodes.empty()) pending_.push_back({&main, 0, 0, 0});
    while (!pending_.empty()) {
      const Pending next = pending_.back();
      pending_.pop_back();
      if (expansion_.nodes.size() == kMostNodes ||
          path_bytes_ > kMostPathBytes) {
        return report_too_large(next);
      }
      const std::uint32_t number = add_node(next);
      const BtcppNode& node = *expansion_.nodes[number].node;
      for (auto at = node.children.rbegin(); at != node.children.rend(); ++at) {
        pending_.push_back({next.tree, *at, next.subtree, number});
      }
      if (node.kind == BtcppKind::SubTree && !open_subtree(node, number)) {
        return;
      }
    }
  }

  std::uint32_t add_node(const Pending& from) {
    const auto number = static_cast<std::uint32_t>(expansion_.nodes.size());
    const BtcppSubtree& around = expansion_.subtrees[from.subtree];
    const BtcppNode& node = from.tree->nodes[from.node];
    BtcppInstance instance{&node, from.subtree, from.parent, {}, {}};
    if (number > 0) expansion_.nodes[from.parent].children.push_back(number);
    instance.path = around.path.empty() ? "" : around.path + "/";
    // A name that repeats the type counts as none.
    const bool is_named = !node.name.empty() && node.name != node.id;
    instance.path +=
        is_named ? node.name : fmt::format("{}::{}", node.id, number + 1);
    path_bytes_ += instance.path.size();
    expansion_.nodes.push_back(std::move(instance));
    return number;
  }

  // False when the expansion cannot go on.
  bool open_subtree(const BtcppNode& node, std::uint32_t number) {
    const BtcppTree* tree = document_.tree(node.id);
    const std::uint32_t around = expansion_.nodes[number].subtree;
    if (tree == nullptr) return report_missing(node), true;
    if (contains(around, *tree)) return report_recursion(node), false;
    BtcppSubtree subtree;
    subtree.tree = tree;
    subtree.parent = around;
    subtree.path = path_of(node, number);
    subtree.first_node = number + 1;
    read_remapping(document_, node, subtree, findings_);
    if (!paths_.insert(subtree.path).second) report_same_path(node, subtree);
    const auto inner = static_cast<std::uint32_t>(expansion_.subtrees.size());
    expansion_.subtrees.push_back(std::move(subtree));
    if (!tree->nodes.empty()) pending_.push_back({tree, 0, inner, number});
    return true;
  }

  // A name that repeats the ID is kept here, unlike in the node's own path.
  std::string path_of(const BtcppNode& node, std::uint32_t number) const {
    const BtcppSubtree& around =
        expansion_.subtrees[expansion_.nodes[number].subtree];
    return (around.path.empty() ? "" : around.path + "/") +
           (node.name.empty() ? fmt::format("{}::{}", node.id, number + 1)
                              : node.name);
  }

  bool contains(std::uint32_t subtree, const BtcppTree& tree) const {
    while (expansion_.subtrees[subtree].tree != &tree) {
      if (subtree == 0) return false;
      subtree = expansion_.subtrees[subtree].parent;
    }
    return true;
  }

  void report_missing(const BtcppNode& node) {
    std::vector<std::string> ids;
    for (const BtcppTree& tree : document_.trees) ids.push_back(tree.id);
    std::string help = did_you_mean(node.id, ids);
    if (help.empty()) {
      help = "include the file that has it, by `<include path=\"…\"/>`";
    }
    findings_.error(node.place,
                    {"BT1612", fmt::format("no tree is called `{}`", node.id),
                     "this SubTree names it", std::move(help)});
  }

  void report_recursion(const BtcppNode& node) {
    findings_.error(
        node.place,
        {"BT1613", fmt::format("the tree `{}` contains itself", node.id),
         "it stands inside itself here",
         "repeat by RetryUntilSuccessful, Repeat or "
         "KeepRunningUntilFailure"});
  }

  void report_same_path(const BtcppNode& node, const BtcppSubtree& subtree) {
    findings_.error(
        node.place,
        {"BT1606", fmt::format("a second SubTree is called `{}`", subtree.path),
         "BehaviorTree.CPP tells subtrees apart by this name",
         "give it another `name`, or none"});
  }

  void report_too_large(const Pending& at) {
    const bool has_many = expansion_.nodes.size() == kMostNodes;
    findings_.error(
        at.tree->nodes[at.node].place,
        {"BT1602",
         has_many
             ? fmt::format("more than {} nodes, subtrees expanded", kMostNodes)
             : fmt::format("the paths of the nodes take more than {} MiB",
                           kMostPathBytes >> 20),
         has_many ? "BehaviorTree.CPP cannot number more" : "",
         has_many ? "use fewer subtrees" : "use shorter names"});
  }

  const BtcppDocument& document_;
  FileFindings findings_;
  BtcppExpansion expansion_;
  std::vector<Pending> pending_;
  std::set<std::string> paths_ = {""};
  std::size_t path_bytes_ = 0;
};

}  // namespace
}  // namespace btcpp

Result<BtcppExpansion> expand_btcpp(const BtcppDocument& document,
                                    std::string_view main_tree) {
  return btcpp::Expander(document).expand(main_tree);
}

}  // namespace btcheck
