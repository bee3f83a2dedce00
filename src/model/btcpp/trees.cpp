// SPDX-License-Identifier: MIT
//
// The order of the checks is that of BehaviorTree.CPP's VerifyXML, which looks
// at every tree of every file, whether or not it is used. What it says of nodes
// it does not know is left out: a checker sees files, not the program that
// registers the nodes.
#include "model/btcpp/trees.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "model/btcpp/children.hpp"
#include "model/btcpp/names.hpp"
#include "model/btcpp/node_types.hpp"

namespace btcheck::btcpp {
namespace {

constexpr int kDeepest = 256;  // BehaviorTree.CPP's own limit

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
      if (file_.root().children.size() > 1) {
        error(element.span,
              {"BT1604", "this tree has no ID", "`ID` is missing",
               "only a tree that is alone in its file can do without; write "
               "`<BehaviorTree ID=\"MainTree\">`"});
      }
      return fmt::format("BehaviorTree_{}", context_.unnamed++);
    }
    check_type_name(*id, "tree");
    check_not_a_node_type(*id);
    return id->value;
  }

  // Version 3 takes any name.
  void check_type_name(const XmlAttribute& id, std::string_view what) {
    if (release() == BtcppRelease::V3) return;
    if (auto flaw = flaw_of_type_name(id.value)) {
      error(id.value_span,
            {"BT1605", fmt::format("no {} can be called `{}`", what, id.value),
             std::move(*flaw), "letters, digits and `_` are always allowed"});
    }
  }

  void check_not_a_node_type(const XmlAttribute& id) {
    if (builtin_type(release(), id.value) == nullptr &&
        context_.document.model(id.value) == nullptr) {
      return;
    }
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
    check_children(element, node);
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
    if (release() == BtcppRelease::V3 || attribute.name == "_autoremap") return;
    std::vector<std::string> names(kBtcppConditionNames.begin(),
                                   kBtcppConditionNames.end());
    names.emplace_back("_autoremap");
    std::string help = did_you_mean(attribute.name, names);
    if (help.empty()) return;
    findings_.warning(file_.place(attribute.name_span),
                      {"BT1625", fmt::format("`{}` is ignored", attribute.name),
                       "neither a port nor a condition", std::move(help)});
  }

  std::optional<BtcppKind> explicit_kind(std::string_view tag) const {
    for (std::size_t i = 0; i < kBtcppKindNames.size(); ++i) {
      if (kBtcppKindNames[i] == tag) return static_cast<BtcppKind>(i);
    }
    if (tag == "SubTreePlus" && release() == BtcppRelease::V3) {
      return BtcppKind::SubTree;
    }
    return std::nullopt;
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
      node.is_known = true;  // nothing more is said of it
      return;
    }
    node.id = id->value;
    if (*kind == BtcppKind::SubTree) {
      node.kind = BtcppKind::SubTree;
      node.is_known = true;
      check_type_name(*id, "tree");
      return check_not_a_node_type(*id);
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
          {"BT1623",
           fmt::format("`{}` is no {}", node.id,
                       kBtcppKindNames[static_cast<std::size_t>(kind)]),
           fmt::format("it is a node of kind {}",
                       kBtcppKindNames[static_cast<std::size_t>(node.kind)]),
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
    if (release() == BtcppRelease::V4) {
      if (auto flaw = flaw_of_type_name(element.name)) {
        error(element.span,
              {"BT1605",
               fmt::format("no node type can be called `{}`", element.name),
               std::move(*flaw), "letters, digits and `_` are always allowed"});
      }
    }
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
             fmt::format("`<{}>` is the way of version 3", element.name),
             "version 4 does not know this node",
             is_plus
                 ? "write `<SubTree ID=\"…\" _autoremap=\"true\"/>`"
                 : fmt::format("write `<SubTree ID=\"{}\"/>`", element.name)});
    }
    return true;
  }

  void decide_kind(const XmlElement& element, BtcppNode& node) {
    if (const NodeTypeRow* type = builtin_type(release(), node.id)) {
      node.kind = type->kind;
      node.is_known = true;
    } else if (const BtcppModel* model = context_.document.model(node.id)) {
      node.kind = model->kind;
      node.is_known = true;
    } else if (const NodeTypeRow* nav2 = nav2_type(node.id)) {
      node.kind = nav2->kind;
      node.is_known = true;
    } else {
      node.kind = element.children.empty()       ? BtcppKind::Action
                  : element.children.size() == 1 ? BtcppKind::Decorator
                                                 : BtcppKind::Control;
    }
  }

  void check_children(const XmlElement& element, const BtcppNode& node) {
    std::vector<ChildTag> children;
    for (const std::size_t child : element.children) {
      const XmlElement& below = file_.elements[child];
      children.push_back({below.name, file_.place(below.span)});
    }
    check_child_count(release(), node, children, findings_);
    check_reactive_children(release(), node, children, findings_);
  }

  const SourceFile& file_;
  TreeContext& context_;
  FileFindings& findings_;
  std::map<std::size_t, std::uint32_t> number_of_;  // element → node
};

void add_tree(BtcppTree tree, TreeContext& context, FileFindings& findings) {
  auto& trees = context.document.trees;
  const auto same =
      std::find_if(trees.begin(), trees.end(),
                   [&](const BtcppTree& other) { return other.id == tree.id; });
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
