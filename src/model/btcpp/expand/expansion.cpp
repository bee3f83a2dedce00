// SPDX-License-Identifier: MIT
//
// As XMLParser::instantiateTree of BehaviorTree.CPP 4.10 does it: uids count in
// pre-order from 1, a SubTree has one of its own, and a node without a name is
// called by its type and uid, "Sequence::1".
#include "model/btcpp/expand/expansion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/expand/checks.hpp"
#include "model/btcpp/findings.hpp"
#include "model/tree/releases.hpp"
#include "text/budget.hpp"
#include "text/choice.hpp"

namespace btcheck {
namespace btcpp {
namespace {

constexpr std::size_t kMostNodes = 65535;  // a uid has 16 bits
// All paths together, so that long names cannot use up the memory.
constexpr std::size_t kMostPathBytes = 64 << 20;

bool read_flag(const BtcppNode& node, std::string_view name,
               FileFindings& findings) {
  const BtcppAttribute* flag = find_attribute(node.others, name);
  if (flag == nullptr) return false;
  const std::optional<bool> value = parse_bool(flag->value);
  if (!value) {
    findings.error(
        flag->place,
        {"BT1610", fmt::format("`{}` is not a Boolean", flag->value),
         fmt::format("the value of `{}`", name), "write `true` or `false`"});
  }
  return value.value_or(false);
}

BtcppRemapping remapping_of(int engine, std::string_view inner,
                            std::string_view value) {
  if (value == "{=}" && !releases::kEqualSignIsKeyOfTree.has(engine)) {
    return {std::string(inner), std::string(inner), false};
  }
  const auto key = blackboard_key(engine, value);
  return {std::string(inner), std::string(key.value_or(value)), !key};
}

const BtcppRemapping* find_remapping(const BtcppSubtree& subtree,
                                     std::string_view inner) {
  const auto& all = subtree.remappings;
  const auto found = std::ranges::find(all, inner, &BtcppRemapping::inner);
  return found == all.end() ? nullptr : &*found;
}

void apply_model(int engine, const BtcppModel& model, const BtcppNode& node,
                 BtcppSubtree& subtree, FileFindings& findings) {
  if (subtree.is_autoremapped) return;
  for (const BtcppPort& port : model.ports) {
    if (find_remapping(subtree, port.name) != nullptr) continue;
    const std::string value = port.default_value.value_or("");
    if (!value.empty()) {
      subtree.remappings.push_back(remapping_of(engine, port.name, value));
      continue;
    }
    findings.error(
        node.place,
        {"BT1614",
         fmt::format("the port `{}` of `{}` is not remapped", port.name,
                     node.id),
         "its model gives no default",
         fmt::format("write `{}=\"{{…}}\"`, or `_autoremap=\"true\"`",
                     port.name)});
  }
}

// Before a tree was asked for each name when it is needed, `_autoremap` made a
// list of those in braces, in the attributes of the tree and its SubTrees.
void remap_ports(int engine, BtcppSubtree& subtree) {
  subtree.is_autoremapped = false;
  for (const BtcppNode& node : subtree.tree->nodes) {
    for (const BtcppAttribute& port : node.ports) {
      const auto key = blackboard_key(engine, port.value);
      if (!key || find_remapping(subtree, *key) != nullptr) continue;
      subtree.remappings.push_back({std::string(*key), std::string(*key)});
    }
  }
}

// Fills the remapping of `subtree`, which is what `node` names. Version 4:
// `a="{b}"` remaps, `a="b"` gives the entry a value, `_autoremap` lets every
// name through that does not begin with `_`. Version 3: a SubTree remaps
// without braces, or shares the blackboard by `__shared_blackboard`; a
// SubTreePlus is version 4's SubTree with `__autoremap`.
void read_remapping(const BtcppDocument& document, const BtcppNode& node,
                    BtcppSubtree& subtree, FileFindings& findings) {
  const bool is_v4 = document.release == BtcppRelease::V4;
  const bool has_braces = !passes_names(document, node);
  subtree.is_autoremapped =
      has_braces &&
      read_flag(node, is_v4 ? "_autoremap" : "__autoremap", findings);
  if (subtree.is_autoremapped && !node.name.empty() && node.name != node.id &&
      releases::kAutoremapsNoNamed.has(document.engine())) {
    findings.error(node.place, {"BT1655", "`_autoremap` beside another name",
                                "BehaviorTree.CPP before 4.3 crashes",
                                "leave `name` out, or name what is remapped"});
  }
  subtree.is_shared =
      !has_braces && read_flag(node, "__shared_blackboard", findings);
  for (const BtcppAttribute& port : node.ports) {
    if (has_braces) {
      subtree.remappings.push_back(
          remapping_of(document.engine(), port.name, port.value));
    } else {
      subtree.remappings.push_back({port.name, port.value, false});
    }
  }
  const int engine = document.engine();
  const BtcppModel* model = document.subtree_model(node.id);
  if (is_v4 && model != nullptr && releases::kHasModelsOfTrees.has(engine)) {
    apply_model(engine, *model, node, subtree, findings);
  }
  if (subtree.is_autoremapped && releases::autoremaps_ports(engine)) {
    remap_ports(engine, subtree);
  }
}

class Expander {
 public:
  Expander(const BtcppDocument& document, std::vector<std::string> given)
      : document_(document), findings_(document.files) {
    expansion_.document = &document;
    expansion_.given = std::move(given);
  }

  Result<BtcppExpansion> expand(std::string_view wanted) {
    const Stage stage("the subtrees were put in their places");
    if (const BtcppTree* main = main_tree(wanted)) expand_from(*main);
    if (wanted.empty() && !findings_.has_error()) tell_of_others();
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
    if (tree == nullptr && wanted.empty()) tree = only_unused();
    if (tree != nullptr) return tree;
    const std::vector<std::string> ids = tree_ids();
    Finding finding{"BT1611", "there is no tree in this file", "",
                    "a tree is written `<BehaviorTree ID=\"…\">`"};
    if (!ids.empty() && wanted.empty()) {
      finding.message = "the file does not say which tree runs";
      finding.help = fmt::format(
          "name one by {}, or in "
          "`<root main_tree_to_execute=\"…\">`; there are {}",
          word(Choice::MainTree), listed(ids));
    } else if (!ids.empty()) {
      finding.message = fmt::format("no tree is called `{}`", wanted);
      finding.help =
          did_you_mean(wanted, ids, fmt::format("there are {}", listed(ids)));
    }
    findings_.error({}, std::move(finding));
    return nullptr;
  }

  // The one tree of the file, or of all files of a .btproj, that no other uses;
  // a program can name another.
  const BtcppTree* only_unused() {
    const BtcppTree* found = nullptr;
    const bool is_project = is_project_name(document_.files.front().name);
    for (const BtcppTree& tree : document_.trees) {
      const bool is_candidate = is_project || tree.place.file == 0;
      if (!is_candidate || is_used(tree)) continue;
      if (found != nullptr) return nullptr;
      found = &tree;
    }
    if (found == nullptr) return nullptr;
    findings_.note(
        found->place,
        {"BT1648",
         fmt::format("`{}` is checked: no other tree uses it", found->id),
         "taken as the main tree",
         fmt::format(
             "write `<root main_tree_to_execute=\"{}\">`, or choose one "
             "by {}",
             found->id, word(Choice::MainTree))});
    return found;
  }

  bool is_used(const BtcppTree& used) const {
    return std::ranges::any_of(document_.trees, [&](const BtcppTree& tree) {
      return &tree != &used &&
             std::ranges::any_of(tree.nodes, [&](const BtcppNode& node) {
               return node.kind == BtcppKind::SubTree && node.id == used.id;
             });
    });
  }

  // Trees of the file itself that the main tree does not use; nobody has said
  // that they are not wanted.
  void tell_of_others() {
    std::vector<std::string> others;
    const BtcppTree* first = nullptr;
    for (const BtcppTree& tree : document_.trees) {
      if (tree.place.file != 0 ||
          std::ranges::count(expansion_.subtrees, &tree, &BtcppSubtree::tree)) {
        continue;
      }
      if (first == nullptr) first = &tree;
      others.push_back(tree.id);
    }
    if (first == nullptr) return;
    findings_.note(
        first->place,
        {"BT1647",
         fmt::format("{} {} not part of `{}`", listed(others),
                     others.size() == 1 ? "is" : "are",
                     expansion_.subtrees[0].tree->id),
         "not checked here",
         fmt::format("`{}` checks it", word(Choice::MainTree, first->id))});
  }

  std::vector<std::string> tree_ids() const {
    std::vector<std::string> ids;
    for (const BtcppTree& tree : document_.trees) ids.push_back(tree.id);
    return ids;
  }

  void expand_from(const BtcppTree& main) {
    BtcppSubtree whole;
    whole.tree = &main;
    expansion_.subtrees.push_back(std::move(whole));
    if (!main.nodes.empty()) pending_.push_back({&main, 0, 0, 0});
    while (!pending_.empty()) {
      ask_budget();
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
    // A name that repeats the type counts as none.
    instance.path = path_in(around, node, number, node.name != node.id);
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
    // Here a name that repeats the ID counts.
    subtree.path = path_in(expansion_.subtrees[around], node, number, true);
    subtree.first_node = number + 1;
    read_remapping(document_, node, subtree, findings_);
    if (!paths_.insert(subtree.path).second) {
      // Version 3 does not look at the name.
      if (document_.release == BtcppRelease::V4)
        report_same_path(node, subtree);
      subtree.path = path_in(expansion_.subtrees[around], node, number, false);
      paths_.insert(subtree.path);
    }
    const auto inner = static_cast<std::uint32_t>(expansion_.subtrees.size());
    expansion_.subtrees.push_back(std::move(subtree));
    if (!tree->nodes.empty()) pending_.push_back({tree, 0, inner, number});
    return true;
  }

  // By its name, or by its type and uid.
  static std::string path_in(const BtcppSubtree& around, const BtcppNode& node,
                             std::uint32_t number, bool takes_name) {
    return (around.path.empty() ? "" : around.path + "/") +
           (takes_name && !node.name.empty()
                ? node.name
                : fmt::format("{}::{}", node.id, number + 1));
  }

  bool contains(std::uint32_t subtree, const BtcppTree& tree) const {
    while (expansion_.subtrees[subtree].tree != &tree) {
      if (subtree == 0) return false;
      subtree = expansion_.subtrees[subtree].parent;
    }
    return true;
  }

  void report_missing(const BtcppNode& node) {
    findings_.error(
        node.place,
        {"BT1612", fmt::format("no tree is called `{}`", node.id),
         "this SubTree names it",
         did_you_mean(
             node.id, tree_ids(),
             fmt::format(
                 "include the file that has it, by `<include path=\"…\"/>`, or "
                 "check a folder that holds both files; a tree of another "
                 "package can be described as a leaf, by {}",
                 word(Choice::Leaves)))});
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
    findings_.refused(
        node.place, document_.version,
        {"BT1606",
         fmt::format("a second SubTree is called `{}`", subtree.path),
         "BehaviorTree.CPP tells subtrees apart by this name",
         "give it another `name`, or none",
         {},
         {releases::kForbidsSamePaths}});
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

bool passes_texts(const BtcppExpansion& expansion) {
  return releases::kPassesTexts.has(expansion.document->engine());
}

bool passes_names(const BtcppDocument& document, const BtcppNode& node) {
  return document.release == BtcppRelease::V3 && node.tag != "SubTreePlus";
}

EntryName entry_of(const BtcppExpansion& expansion, std::uint32_t subtree,
                   std::string_view name) {
  if (name.starts_with('@')) return {0, std::string(name.substr(1))};
  EntryName entry{subtree, std::string(name)};
  const bool remaps_private =
      releases::kRemapsPrivateNames.has(expansion.document->engine());
  while (entry.subtree != 0) {
    const BtcppSubtree& around = expansion.subtrees[entry.subtree];
    const BtcppRemapping* remapping = find_remapping(around, entry.name);
    if (around.is_shared) {
      entry.subtree = around.parent;
    } else if (remapping != nullptr && !remapping->is_literal) {
      if (remapping->outer.starts_with('@')) {
        return {0, remapping->outer.substr(1)};
      }
      entry = {around.parent, remapping->outer};
    } else if (remapping == nullptr && around.is_autoremapped &&
               (remaps_private || !entry.name.starts_with('_'))) {
      entry.subtree = around.parent;
    } else {
      break;
    }
  }
  return entry;
}

bool is_own_name(const EntryName& entry, std::uint32_t subtree,
                 std::string_view name) {
  return name.starts_with('@') ||
         (entry.subtree == subtree && entry.name == name);
}

std::size_t ScriptDetail::most_values(const EntryName& entry) const {
  const auto found = levels.find(entry);
  return kMostValues << (found == levels.end() ? 0 : 3 * found->second);
}

double ScriptDetail::reach(const EntryName& entry) const {
  const std::size_t most = most_values(entry);
  return most == kMostValues ? 0 : static_cast<double>(most) / 4;
}

}  // namespace btcpp

Result<BtcppExpansion> expand_btcpp(const BtcppDocument& document,
                                    std::string_view main_tree,
                                    std::vector<std::string> given) {
  return btcpp::Expander(document, std::move(given)).expand(main_tree);
}

}  // namespace btcheck
