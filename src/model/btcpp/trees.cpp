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
#include "model/tree/releases.hpp"
#include "text/choice.hpp"

namespace btcheck::btcpp {
namespace {

constexpr int kDeepest = 256;  // BehaviorTree.CPP's own limit

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
    const XmlElement& element = file_.elements()[at];
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

  void refused(SourceSpan span, Finding finding) {
    findings_.refused(file_.place(span), context_.document.version,
                      std::move(finding));
  }

  BtcppRelease release() const { return context_.document.release; }
  bool is_in(const Releases& releases) const {
    return releases.has(context_.document.engine());
  }
  bool is_3() const { return release() == BtcppRelease::V3; }
  bool is_4() const { return release() == BtcppRelease::V4; }

  std::string id_of_tree(const XmlElement& element) {
    const XmlAttribute* id = element.attribute("ID");
    if (id == nullptr || id->value.empty()) {
      // Models and includes count as well.
      if (is_4() && file_.root().children.size() > 1) {
        refused(element.span,
                {"BT1604",
                 "this tree has no ID",
                 "`ID` is missing",
                 "only a tree that is alone in its file can do without; write "
                 "`<BehaviorTree ID=\"MainTree\">`",
                 {},
                 {releases::kForbidsNamesOfTypes}});
      }
      return fmt::format("BehaviorTree_{}", context_.unnamed++);
    }
    check_tree_id(*id);
    return id->value;
  }

  // Version 3 and py_trees take any name, and version 4 a blank in it until
  // 4.8.4.
  void check_type_name(SourceSpan span, std::string_view what,
                       const std::string& name) {
    if (!is_4()) return;
    if (auto flaw = flaw_of_type_name(name)) {
      findings_.refused(file_.place(span), context_.document.version,
                        {"BT1605",
                         fmt::format("no {} can be called `{}`", what, name),
                         *flaw + " from BehaviorTree.CPP 4.8.4 on",
                         "letters, digits and `_` are always allowed",
                         {},
                         {releases::kForbidsNames}});
    }
  }

  void check_tree_id(const XmlAttribute& id) {
    if (!is_4()) return;
    check_type_name(id.value_span, "tree", id.value);
    const bool is_taken = builtin_type(release(), id.value) != nullptr ||
                          context_.document.model(id.value) != nullptr;
    if (!is_taken) return;
    refused(id.value_span,
            {"BT1606",
             fmt::format("`{}` is the name of a node type", id.value),
             "a tree cannot have it as well",
             "give the tree another ID",
             {},
             {releases::kForbidsNamesOfTypes}});
  }

  // The elements below one stand together, in the order of their tags. Those
  // below a leaf are no nodes.
  void add_nodes(std::size_t first, BtcppTree& tree) {
    std::vector<std::size_t> open;  // elements, from the root to the last one
    std::size_t leaf_depth = kDeepest + 1;
    for (std::size_t at = first; at < file_.elements().size(); ++at) {
      const XmlElement& element = file_.elements()[at];
      while (!open.empty() && open.back() != element.parent) open.pop_back();
      if (open.empty() && at != first) return;
      if (open.size() > kDeepest) {
        error(element.span, {"BT1602", "the nodes are nested too deeply",
                             fmt::format("more than {} in another", kDeepest),
                             "move a part into a tree of its own"});
        return;
      }
      if (open.size() >= leaf_depth) {
        open.push_back(at);
        continue;
      }
      leaf_depth = kDeepest + 1;
      const auto number = static_cast<std::uint32_t>(tree.nodes.size());
      const std::uint32_t parent =
          open.empty() ? number : number_of_[open.back()];
      number_of_[at] = number;
      tree.nodes.push_back(node_of(element));
      tree.nodes.back().parent = parent;
      if (!open.empty()) tree.nodes[parent].children.push_back(number);
      open.push_back(at);
      if (has_no_children(tree.nodes.back())) leaf_depth = open.size();
    }
  }

  // Where it is not refused, what stands below one is given to nobody.
  static bool has_no_children(const BtcppNode& node) {
    return node.kind != BtcppKind::Decorator && node.kind != BtcppKind::Control;
  }

  BtcppNode node_of(const XmlElement& element) {
    BtcppNode node;
    node.tag = element.name;
    node.place = file_.place(element.span);
    sort_attributes(element, node);
    decide_type(element, node);
    if (is_3() && node.is_known && node.kind != BtcppKind::SubTree) {
      take_for_ports(node);
    }
    check_child_count(element, node);
    check_reactive_children(element, node);
    take_empty_script(node);
    return node;
  }

  // The script that a Script has at first is empty, and its own is read only if
  // it is another: nothing happens, and the node succeeds.
  void take_empty_script(BtcppNode& node) const {
    const BtcppAttribute* code = find_attribute(node.ports, "code");
    if (!is_4() || node.id != "Script" || code == nullptr) return;
    if (!code->value.empty()) return;
    node.id = "AlwaysSuccess";
    node.ports.clear();
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
      } else if (is_4() && from.name != "_autoremap" &&
                 is_reserved_attribute(from.name)) {
        node.conditions.push_back(std::move(attribute));
      } else if (release() == BtcppRelease::PyTrees) {
        refuse_attribute(from);
      } else {
        check_ignored(from);
        node.others.push_back(std::move(attribute));
      }
    }
  }

  // Version 3 knows no other attributes.
  void take_for_ports(BtcppNode& node) const {
    std::erase_if(node.others, [&](BtcppAttribute& each) {
      if (each.name == "_description" &&
          !is_in(releases::kTakesDescriptionForPort)) {
        return false;
      }
      node.ports.push_back(std::move(each));
      return true;
    });
  }

  void check_instance_name(const XmlAttribute& name) {
    if (auto flaw = flaw_of_instance_name(name.value)) {
      error(name.value_span, {"BT1605", "this name is not allowed",
                              std::move(*flaw), "write it without"});
    }
  }

  void refuse_attribute(const XmlAttribute& attribute) {
    error(attribute.name_span,
          {"BT1660", fmt::format("py_trees has no `{}`", attribute.name),
           "nothing of py_trees is written so", "delete it"});
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
    if (tag == "SubTreePlus" && is_3()) {
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
    if (names_a_tree_as_node(node)) return;
    decide_kind(element, node);
    check_explicit_kind(*kind, *id, node);
  }

  // A tree has the name, and no node type.
  bool is_tree_only(const std::string& name) const {
    return context_.tree_ids.contains(name) &&
           known_type(release(), name) == nullptr &&
           context_.document.model(name) == nullptr;
  }

  // <Action ID="MyTree"/> of version 3 is the tree that the name says, and
  // where there is none the ID.
  bool names_a_tree_as_node(BtcppNode& node) const {
    if (!is_3() || !is_tree_only(node.id)) return false;
    if (!node.name.empty()) node.id = node.name;
    node.kind = BtcppKind::SubTree;
    node.is_known = true;
    return true;
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
    const XmlAttribute* id = element.attribute("ID");
    if (id != nullptr && !is_3()) {
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
    if (release() == BtcppRelease::PyTrees) return false;
    const bool is_tree = is_tree_only(element.name);
    const bool is_plus = element.name == "SubTreePlus";
    if (!is_tree && !is_plus) return false;
    node.kind = BtcppKind::SubTree;
    node.is_known = true;
    Finding finding{
        "BT1608",
        fmt::format("`<{}>` is written as in version 3", element.name),
        "version 4 does not know this node",
        is_plus ? "write `<SubTree ID=\"…\" _autoremap=\"true\"/>`"
                : fmt::format("write `<SubTree ID=\"{}\"/>`", element.name)};
    if (!is_3()) {
      error(element.span, std::move(finding));
    } else if (is_tree) {
      finding.message =
          fmt::format("the tree `{}` stands here as a tag", element.name);
      finding.label = "BehaviorTree.CPP 3.8 and later do not know this node";
      finding.refused_by = {releases::kForbidsTreeTags};
      refused(element.span, std::move(finding));
    }
    return true;
  }

  // Its own composites and decorators, or any leaf.
  void decide_kind_in_py_trees(const XmlElement& element, BtcppNode& node) {
    const NodeTypeRow* type = builtin_type(release(), node.id);
    const BtcppModel* model = context_.document.model(node.id);
    node.is_known = type != nullptr || model != nullptr;
    node.kind = type != nullptr    ? type->kind
                : model != nullptr ? model->kind
                                   : BtcppKind::Action;
    if (type != nullptr || element.children.empty()) return;
    node.is_known = true;  // one error is enough
    node.kind = BtcppKind::Control;
    error(element.span,
          {"BT1660", fmt::format("py_trees has no node `{}`", node.id),
           "what a composite or decorator of yours does is not known",
           did_you_mean(node.id, builtin_names(release()),
                        "write it with those of py_trees (docs/pytrees.md)")});
  }

  // The kind of a type that nobody knows is guessed.
  void decide_kind(const XmlElement& element, BtcppNode& node) {
    if (release() == BtcppRelease::PyTrees) {
      return decide_kind_in_py_trees(element, node);
    }
    check_age(element, node);
    take_old_name(element, node);
    const NodeTypeRow* builtin = builtin_type(release(), node.id);
    const BtcppModel* model = context_.document.model(node.id);
    const NodeTypeRow* nav2 = nav2_type(node.id);
    if (nav2 == nullptr) nav2 = observer_type(node);
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

  // Whether the release that was named has the type yet.
  void check_age(const XmlElement& element, const BtcppNode& node) {
    const int since = first_release(node.id);
    const bool may_be_own = is_3() && since > kNewestRelease3;
    if (context_.document.engine() >= since || may_be_own) return;
    error(element.span,
          {"BT1608",
           fmt::format("`{}` came with BehaviorTree.CPP {}", node.id,
                       release_text(since)),
           fmt::format("{} does not know this node",
                       release_text(context_.document.engine())),
           since == releases::kMisspellsRetry.end
               ? "write `RetryUntilSuccesful`, as this release spells it"
               : fmt::format("name the release that you have by {}",
                             word(Choice::Profile))});
  }

  // Version 3 has types under the names of older releases, and is told once.
  void take_old_name(const XmlElement& element, BtcppNode& node) {
    const std::string_view today = old_name(release(), node.id).today;
    if (!is_3() || today.empty() ||
        context_.document.model(node.id) != nullptr) {
      return;
    }
    if (!is_in(releases::kMisspellsRetry) &&
        context_.told_names.insert(node.id).second) {
      findings_.warning(
          file_.place(element.span),
          {"BT1643", fmt::format("`{}` is now called `{}`", node.id, today),
           "read as that; 3.8 and 4 refuse the old name",
           fmt::format("write `{}`", today)});
    }
    node.id = today;
  }

  // In version 3 these find at once that no child is left.
  bool answers_without_children(const XmlElement& element, BtcppNode& node) {
    const bool is_sequence = element.name == "ReactiveSequence";
    if (!is_3() || (!is_sequence && element.name != "ReactiveFallback")) {
      return false;
    }
    findings_.warning(
        file_.place(element.span),
        {"BT1607", fmt::format("`{}` has no children", node.id),
         is_sequence ? "it succeeds in every tick" : "it fails in every tick",
         "add some, or delete the node"});
    node.id = is_sequence ? "AlwaysSuccess" : "AlwaysFailure";
    node.kind = BtcppKind::Action;
    return true;
  }

  void check_child_count(const XmlElement& element, BtcppNode& node) {
    Arity arity = arity_of(release(), node);
    if (node.id == "WhileDoElse" && is_in(releases::kNeedsElse)) arity.min = 3;
    if (element.name == "Control") arity.min = std::max(arity.min, 1);
    const int count = static_cast<int>(element.children.size());
    if (count >= arity.min && count <= arity.max) return;
    if (count == 0 && answers_without_children(element, node)) return;
    Finding finding{
        "BT1607",
        fmt::format("`{}` has {} child{}", node.id.empty() ? node.tag : node.id,
                    count == 0 ? "no" : std::to_string(count),
                    count == 1 ? "" : "ren"),
        expected(arity), advice(node, arity, count)};
    // Loading looks at the tags <Action>, <Condition> and <SubTree> only.
    const bool is_loaded = (is_3() || is_4()) && !kind_named(element.name);
    if (!has_no_children(node) || !is_loaded) {
      error(element.span, std::move(finding));
    } else if (is_3()) {
      finding.label = "they are never ticked";
      findings_.warning(file_.place(element.span), std::move(finding));
    } else {
      finding.refused_by = {releases::kForbidsChildrenOfLeaves};
      refused(element.span, std::move(finding));
    }
  }

  // VerifyXML of 4.7.0 to 4.10.0 looks the children's tags up among the node
  // types, and so does not know those of the explicit form.
  void check_reactive_children(const XmlElement& element,
                               const BtcppNode& node) {
    if (!is_4() || node.id != "ReactiveSequence") return;
    int asynchronous = 0;
    for (const std::size_t number : element.children) {
      const XmlElement& child = file_.elements()[number];
      if (child.name != "SubTree" && kind_named(child.name)) {
        findings_.refused(
            file_.place(child.span), context_.document.version,
            {"BT1619",
             fmt::format("`<{}>` directly in a ReactiveSequence", child.name),
             "BehaviorTree.CPP 4.7 to 4.10 refuse the explicit form here",
             "write the node type as the tag",
             {},
             {releases::kLooksAtReactive}});
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
             {releases::kLooksAtReactive}});
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
  const bool is_3 = context.document.release == BtcppRelease::V3;
  findings.warning(
      tree.place,
      {"BT1624", fmt::format("a second tree has the ID `{}`", tree.id),
       is_3 ? "version 3 keeps the first"
            : "this one takes the place of the first",
       fmt::format("the first is in line {} of {}; give one another ID",
                   same->place.span.line,
                   findings.source(same->place.file).name())});
  if (!is_3) *same = std::move(tree);
}

}  // namespace

void read_trees(const SourceFile& file, TreeContext& context,
                FileFindings& findings) {
  for (const std::size_t child : file.root().children) {
    if (file.elements()[child].name != "BehaviorTree") continue;
    BtcppTree tree = TreeReader(file, context, findings).read(child);
    add_tree(std::move(tree), context, findings);
  }
}

}  // namespace btcheck::btcpp
