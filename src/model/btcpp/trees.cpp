// SPDX-License-Identifier: MIT
//
// The checks come in the order of BehaviorTree.CPP's VerifyXML, which verifies
// every tree of every file, used or not. Its errors about unregistered nodes
// are left out: a checker sees files, not the program that registers the nodes.
#include "model/btcpp/source_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::btcpp {
namespace {

constexpr int kDeepest = 256;  // BehaviorTree.CPP's own limit
// The releases that look at names, and at children of a ReactiveSequence.
constexpr Releases kForbidsNames = {40804, kNoRelease};
constexpr Releases kLooksAtReactive = {40700, kNoRelease};

struct Arity {
  int min = 0;
  int max = 0;
};

// When the node is ticked; loading is less strict.
Arity arity_of(BtcppRelease release, const BtcppNode& node) {
  const bool is_decorator = node.kind == BtcppKind::Decorator;
  if (!is_decorator && node.kind != BtcppKind::Control) return {0, 0};
  const NodeTypeRow* row = known_type(release, node.id);
  // A model may give a name of Nav2 to a node of another kind.
  if (row == nullptr || row->kind != node.kind) {
    return {1, is_decorator ? 1 : kAnyNumber};
  }
  if (row->exact_children > 0)
    return {row->exact_children, row->exact_children};
  const NodeTypeInfo& info = info_of(row->type);
  return {info.min_children, info.max_children};
}

std::string expected(Arity arity) {
  if (arity.max == 0) return "none is allowed";
  if (arity.min == arity.max)
    return fmt::format("exactly {} needed", arity.min);
  if (arity.max == kAnyNumber) {
    return fmt::format("at least {} needed", arity.min);
  }
  return fmt::format("{} to {} needed", arity.min, arity.max);
}

std::string advice(const BtcppNode& node, Arity arity, int count) {
  if (node.kind == BtcppKind::SubTree) {
    return "write them into the tree that its ID names";
  }
  if (arity.max == 0) return "put them beside it, under a Sequence";
  if (count > arity.max && arity.max == 1) {
    return "put them into a Sequence or Fallback below it";
  }
  if (node.id.starts_with("Switch")) {
    return "one child for each case, and a last one for all other values";
  }
  if (node.id == "IfThenElse" || node.id == "WhileDoElse") {
    return "condition, then, and else";
  }
  if (node.id == "RecoveryNode") return "the task, and what repairs it";
  return count > arity.max ? "delete some" : "add one, or delete the node";
}

class TreeReader {
 public:
  TreeReader(const SourceFile& file, TreeContext& context,
             FileFindings& findings)
      : file_(file), context_(context), findings_(findings) {}

  BtcppTree read(std::size_t at) {
    const XmlElement& element = file_.elements[at];
    BtcppTree tree;
    tree.place = file_.place(element.span);
    tree.id = id_of_tree(element);
    if (element.children.size() != 1) {
      error(element.span, {"BT1607",
                           fmt::format("the tree `{}` has {} nodes at its top",
                                       tree.id, element.children.size()),
                           "exactly one is needed",
                           element.children.empty()
                               ? "put a node into it, or delete it"
                               : "put them into a Sequence or Fallback"});
    }
    if (!element.children.empty()) add_nodes(element.children.front(), tree);
    return tree;
  }

 private:
  void error(SourceSpan span, Finding finding) {
    findings_.error(file_.place(span), std::move(finding));
  }

  BtcppRelease release() const { return context_.document.release; }

  std::string id_of_tree(const XmlElement& element) {
    const XmlAttribute* id = element.attribute("ID");
    if (id == nullptr || id->value.empty()) {
      if (is_one_of_several()) {
        error(element.span,
              {"BT1604", "this tree has no ID", "`ID` is missing",
               "only a tree that is alone in its file can do without; write "
               "`<BehaviorTree ID=\"MainTree\">`"});
      }
      return fmt::format("BehaviorTree_{}", context_.unnamed++);
    }
    check_tree_id(*id);
    return id->value;
  }

  // Version 4 counts models and includes as well.
  bool is_one_of_several() const {
    const auto& children = file_.root().children;
    if (release() == BtcppRelease::V4) return children.size() > 1;
    return std::ranges::count_if(children, [&](std::size_t child) {
             return file_.elements[child].name == "BehaviorTree";
           }) > 1;
  }

  // Version 3 takes any name, and version 4 a blank in it until 4.8.4.
  void check_type_name(SourceSpan span, std::string_view what,
                       const std::string& name) {
    if (release() == BtcppRelease::V3) return;
    if (auto flaw = flaw_of_type_name(name)) {
      findings_.refused(file_.place(span), context_.document.version,
                        {"BT1605",
                         fmt::format("no {} can be called `{}`", what, name),
                         *flaw + " from BehaviorTree.CPP 4.8.4 on",
                         "letters, digits and `_` are always allowed",
                         {},
                         kForbidsNames});
    }
  }

  void check_tree_id(const XmlAttribute& id) {
    check_type_name(id.value_span, "tree", id.value);
    const bool is_taken = builtin_type(release(), id.value) != nullptr ||
                          context_.document.model(id.value) != nullptr;
    if (!is_taken) return;
    error(id.value_span,
          {"BT1606", fmt::format("`{}` is the name of a node type", id.value),
           "a tree cannot have it as well", "give the tree another ID"});
  }

  // The elements below one stand together, in the order of their tags.
  void add_nodes(std::size_t first, BtcppTree& tree) {
    std::vector<std::size_t> open;  // elements, from the root to the last one
    for (std::size_t at = first; at < file_.elements.size(); ++at) {
      const XmlElement& element = file_.elements[at];
      while (!open.empty() && open.back() != element.parent) open.pop_back();
      if (open.empty() && at != first) return;
      if (open.size() > kDeepest) {
        error(element.span, {"BT1602", "the nodes are nested too deeply",
                             fmt::format("more than {} in another", kDeepest),
                             "move a part into a tree of its own"});
        return;
      }
      const auto number = static_cast<std::uint32_t>(tree.nodes.size());
      const std::uint32_t parent =
          open.empty() ? number : number_of_[open.back()];
      number_of_[at] = number;
      tree.nodes.push_back(node_of(element));
      tree.nodes.back().parent = parent;
      if (!open.empty()) tree.nodes[parent].children.push_back(number);
      open.push_back(at);
    }
  }

  BtcppNode node_of(const XmlElement& element) {
    BtcppNode node;
    node.tag = element.name;
    node.place = file_.place(element.span);
    sort_attributes(element, node);
    decide_type(element, node);
    check_child_count(element, node);
    check_reactive_children(element, node);
    return node;
  }

  void sort_attributes(const XmlElement& element, BtcppNode& node) {
    for (const XmlAttribute& from : element.attributes) {
      BtcppAttribute attribute{from.name, from.value,
                               file_.place(from.name_span),
                               file_.place(from.value_span)};
      if (from.name == "name") {
        check_instance_name(from);
        node.name = from.value;
      } else if (from.name == "ID") {
        continue;
      } else if (is_port_name(from.name)) {
        node.ports.push_back(std::move(attribute));
      } else if (release() == BtcppRelease::V4 && from.name != "_autoremap" &&
                 is_reserved_attribute(from.name)) {
        node.conditions.push_back(std::move(attribute));
      } else {
        check_ignored(from);
        node.others.push_back(std::move(attribute));
      }
    }
  }

  void check_instance_name(const XmlAttribute& name) {
    if (auto flaw = flaw_of_instance_name(name.value)) {
      error(name.value_span, {"BT1605", "this name is not allowed",
                              std::move(*flaw), "write it without"});
    }
  }

  // A condition that is misspelt changes nothing, silently.
  void check_ignored(const XmlAttribute& attribute) {
    std::string help = meant_condition(release(), attribute.name);
    if (help.empty()) return;
    findings_.warning(file_.place(attribute.name_span),
                      {"BT1625", fmt::format("`{}` is ignored", attribute.name),
                       "neither a port nor a condition", std::move(help)});
  }

  std::optional<BtcppKind> explicit_kind(std::string_view tag) const {
    if (tag == "SubTreePlus" && release() == BtcppRelease::V3) {
      return BtcppKind::SubTree;
    }
    return kind_named(tag);
  }

  void decide_type(const XmlElement& element, BtcppNode& node) {
    const XmlAttribute* id = element.attribute("ID");
    const auto kind = explicit_kind(element.name);
    node.is_explicit = kind.has_value();
    if (!kind) return decide_compact_type(element, node);
    if (id == nullptr || id->value.empty()) {
      error(
          element.span,
          {"BT1604", fmt::format("`<{}>` has no ID", element.name),
           "`ID` is missing",
           *kind == BtcppKind::SubTree ? "`ID` names the tree that stands here"
                                       : "`ID` names the node type"});
      node.kind = *kind;
      node.is_known = true;  // one error is enough
      return;
    }
    node.id = id->value;
    if (*kind == BtcppKind::SubTree) {
      node.kind = BtcppKind::SubTree;
      node.is_known = true;
      return check_tree_id(*id);
    }
    decide_kind(element, node);
    check_explicit_kind(*kind, *id, node);
  }

  void check_explicit_kind(BtcppKind kind, const XmlAttribute& id,
                           BtcppNode& node) {
    if (!node.is_known) {
      node.kind = kind;
    } else if (node.kind != kind) {
      findings_.warning(
          file_.place(id.value_span),
          {"BT1623", fmt::format("`{}` is no {}", node.id, kind_name(kind)),
           fmt::format("it is a node of kind {}", kind_name(node.kind)),
           fmt::format("write `<{}>`; BehaviorTree.CPP goes by the node type "
                       "and ignores the tag",
                       node.id)});
    }
  }

  void decide_compact_type(const XmlElement& element, BtcppNode& node) {
    node.id = element.name;
    if (names_a_tree(element, node)) return;
    if (const XmlAttribute* id = element.attribute("ID")) {
      error(id->name_span,
            {"BT1604", fmt::format("`<{}>` takes no ID", element.name),
             "the tag is the node type already",
             "delete `ID`; the name of an instance is `name`"});
    }
    check_type_name(element.span, "node type", element.name);
    decide_kind(element, node);
  }

  // <MyTree/> for <SubTree ID="MyTree"/> is of version 3, as is <SubTreePlus>.
  bool names_a_tree(const XmlElement& element, BtcppNode& node) {
    const bool is_tree = context_.tree_ids.contains(element.name) &&
                         known_type(release(), element.name) == nullptr &&
                         context_.document.model(element.name) == nullptr;
    const bool is_plus = element.name == "SubTreePlus";
    if (!is_tree && !is_plus) return false;
    node.kind = BtcppKind::SubTree;
    node.is_known = true;
    if (release() == BtcppRelease::V4) {
      error(element.span,
            {"BT1608",
             fmt::format("`<{}>` is written as in version 3", element.name),
             "version 4 does not know this node",
             is_plus
                 ? "write `<SubTree ID=\"…\" _autoremap=\"true\"/>`"
                 : fmt::format("write `<SubTree ID=\"{}\"/>`", element.name)});
    }
    return true;
  }

  // The kind of a type that nobody knows is guessed.
  void decide_kind(const XmlElement& element, BtcppNode& node) {
    take_old_name(element, node);
    const NodeTypeRow* builtin = builtin_type(release(), node.id);
    const BtcppModel* model = context_.document.model(node.id);
    const NodeTypeRow* nav2 = nav2_type(node.id);
    const std::size_t count = element.children.size();
    const LibraryType* library = library_type_of(node, count);
    node.is_known = builtin != nullptr || model != nullptr || nav2 != nullptr ||
                    library != nullptr;
    node.kind = builtin != nullptr   ? builtin->kind
                : model != nullptr   ? model->kind
                : nav2 != nullptr    ? nav2->kind
                : library != nullptr ? *kind_named(library->kind)
                : count == 0         ? BtcppKind::Action
                : count == 1         ? BtcppKind::Decorator
                                     : BtcppKind::Control;
  }

  // Version 3 has types under the names of older releases, and is told once.
  void take_old_name(const XmlElement& element, BtcppNode& node) {
    const std::string_view today = old_name(release(), node.id).today;
    if (release() == BtcppRelease::V4 || today.empty() ||
        context_.document.model(node.id) != nullptr) {
      return;
    }
    if (context_.told_names.insert(node.id).second) {
      findings_.warning(
          file_.place(element.span),
          {"BT1643", fmt::format("`{}` is now called `{}`", node.id, today),
           "read as that; 3.8 and 4 refuse the old name",
           fmt::format("write `{}`", today)});
    }
    node.id = today;
  }

  void check_child_count(const XmlElement& element, const BtcppNode& node) {
    const Arity arity = arity_of(release(), node);
    const int count = static_cast<int>(element.children.size());
    if (count >= arity.min && count <= arity.max) return;
    error(element.span, {"BT1607",
                         fmt::format("`{}` has {} child{}",
                                     node.id.empty() ? node.tag : node.id,
                                     count == 0 ? "no" : std::to_string(count),
                                     count == 1 ? "" : "ren"),
                         expected(arity), advice(node, arity, count)});
  }

  // VerifyXML of 4.7.0 to 4.10.0 looks the children's tags up among the node
  // types, and so does not know those of the explicit form.
  void check_reactive_children(const XmlElement& element,
                               const BtcppNode& node) {
    if (release() == BtcppRelease::V3 || node.id != "ReactiveSequence") return;
    int asynchronous = 0;
    for (const std::size_t number : element.children) {
      const XmlElement& child = file_.elements[number];
      if (child.name != "SubTree" && kind_named(child.name)) {
        findings_.refused(
            file_.place(child.span), context_.document.version,
            {"BT1619",
             fmt::format("`<{}>` directly in a ReactiveSequence", child.name),
             "BehaviorTree.CPP 4.7 to 4.10 refuse the explicit form here",
             "write the node type as the tag",
             {},
             kLooksAtReactive});
      }
      if (child.name == "AsyncSequence" && ++asynchronous == 2) {
        findings_.refused(
            file_.place(child.span), context_.document.version,
            {"BT1619",
             "a second AsyncSequence in a ReactiveSequence",
             "only one asynchronous child is allowed, from BehaviorTree.CPP "
             "4.7 on",
             "use a Parallel, or put both into one child",
             {},
             kLooksAtReactive});
      }
    }
  }

  const SourceFile& file_;
  TreeContext& context_;
  FileFindings& findings_;
  std::map<std::size_t, std::uint32_t> number_of_;  // element → node
};

void add_tree(BtcppTree tree, TreeContext& context, FileFindings& findings) {
  auto& trees = context.document.trees;
  const auto same = std::ranges::find(trees, tree.id, &BtcppTree::id);
  if (same == trees.end()) {
    trees.push_back(std::move(tree));
    return;
  }
  findings.warning(
      tree.place,
      {"BT1624", fmt::format("a second tree has the ID `{}`", tree.id),
       "this one takes the place of the first",
       fmt::format("the first is in line {} of {}; give one another ID",
                   same->place.span.line,
                   findings.source(same->place.file).name())});
  *same = std::move(tree);
}

}  // namespace

void read_trees(const SourceFile& file, TreeContext& context,
                FileFindings& findings) {
  for (const std::size_t child : file.root().children) {
    if (file.elements[child].name != "BehaviorTree") continue;
    BtcppTree tree = TreeReader(file, context, findings).read(child);
    add_tree(std::move(tree), context, findings);
  }
}

}  // namespace btcheck::btcpp
