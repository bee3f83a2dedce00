// SPDX-License-Identifier: MIT
//
// Names of types become elements, and each stands for one kind of node: an
// action called `go home` is a <go_home name="go home"/>, and one called
// `Sequence` a <Sequence_/>. The layout of the XML is tinyxml2's, which
// BehaviorTree.CPP writes with.
#include "trace/logs/btcpp_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "model/btcpp/known_types.hpp"
#include "trace/run/recorded_run.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// What BehaviorTree.CPP takes as the name of a type or a tree.
std::string fit_name(std::string_view name) {
  std::string fit = plain_word(name, "-");
  const bool begins_badly =
      fit.empty() || fit[0] == '-' || (fit[0] >= '0' && fit[0] <= '9');
  if (begins_badly) fit.insert(0, "_");
  if (fit == "root" || fit == "Root") fit += '_';
  return fit;
}

// Our words for node types where BehaviorTree.CPP or Nav2 has another.
std::string_view type_id(std::string_view type) {
  return type == "Recovery" ? "RecoveryNode" : type;
}

// A type that BehaviorTree.CPP brings along, or nullptr.
const btcpp::NodeTypeRow* builtin(std::string_view id) {
  return btcpp::builtin_type(BtcppRelease::V4, id);
}

// The words of a TreeNodesModel for PortType and BtcppDirection.
constexpr std::string_view kTypeWords[] = {"BT::AnyTypeAllowed",
                                           "int",
                                           "unsigned int",
                                           "bool",
                                           "double",
                                           "std::string",
                                           "BT::NodeStatus",
                                           "std::string"};
constexpr std::string_view kDirectionWords[] = {"input_port", "output_port",
                                                "inout_port"};

BtcppKind leaf_kind(std::string_view type) {
  return type == "Condition" || type == "Eval" ? BtcppKind::Condition
                                               : BtcppKind::Action;
}

// Of a node with children.
BtcppKind inner_kind(std::string_view type, std::size_t child_count) {
  if (type == "BehaviorTree" || type == "SubTree") return BtcppKind::SubTree;
  const btcpp::NodeTypeRow* known = btcpp::known_type(BtcppRelease::V4, type);
  if (known != nullptr) return known->kind;
  return child_count > 1 ? BtcppKind::Control : BtcppKind::Decorator;
}

class Loader {
 public:
  explicit Loader(const RecordedRun& run)
      : run_(run), children_(children_of(run)), place_(run.nodes.size()) {}

  LoggedTree load() {
    const auto roots = std::ranges::count_if(
        run_.nodes, [](const RecordedNode& node) { return !node.parent; });
    tree_.id = "trees";
    if (roots > 1) {
      LoggedNode& above = tree_.nodes.emplace_back();
      above.kind = BtcppKind::Control;
      above.id = above.name = "ParallelAll";
    }
    for (std::uint32_t n = 0; n < run_.nodes.size(); ++n) add(n, roots > 1);
    return std::move(tree_);
  }

 private:
  void add(std::uint32_t number, bool has_siblings) {
    const RecordedNode& recorded = run_.nodes[number];
    const bool is_main = !recorded.parent && !has_siblings;
    if (is_main) tree_.id = fit_name(recorded.name);
    if (is_main && recorded.type == "BehaviorTree") return;
    LoggedNode node = described(recorded, children_[number].size());
    node.recorded = number;
    if (recorded.parent) {
      node.parent = place_[*recorded.parent];
    } else if (has_siblings) {
      node.parent = 0;
    }
    const std::size_t place = tree_.nodes.size();
    place_[number] = place;
    if (node.parent) tree_.nodes[*node.parent].children.push_back(place);
    if (node.kind == BtcppKind::SubTree) {
      node.path = fmt::format("{}{}::{}", path_of(node), node.id, place + 1);
    }
    tree_.nodes.push_back(std::move(node));
  }

  LoggedNode described(const RecordedNode& recorded, std::size_t child_count) {
    LoggedNode node;
    node.name = recorded.name;
    const bool is_tree =
        recorded.type == "BehaviorTree" || recorded.type == "SubTree";
    if (child_count > 0 || is_tree) {
      node.kind = inner_kind(type_id(recorded.type), child_count);
      node.id = is_tree ? fit_name(recorded.name)
                        : registered(type_id(recorded.type), node.kind);
      return node;
    }
    // Actions and conditions are types of their own; SetSV, Eval, Wait are one.
    const bool is_named =
        recorded.type == "Action" || recorded.type == "Condition";
    node.kind = leaf_kind(recorded.type);
    node.id = registered(is_named ? recorded.name : recorded.type, node.kind);
    return node;
  }

  // An id that stands for this kind and no other.
  std::string registered(std::string_view wanted, BtcppKind kind) {
    std::string id = fit_name(wanted);
    for (;; id += '_') {
      const btcpp::NodeTypeRow* known = builtin(id);
      const BtcppKind has =
          known ? known->kind
                : tree_.own_models.emplace(id, kind).first->second;
      if (has == kind) return id;
    }
  }

  // The path that the SubTree's own begins with.
  std::string path_of(const LoggedNode& node) const {
    for (auto above = node.parent; above; above = tree_.nodes[*above].parent) {
      const LoggedNode& outer = tree_.nodes[*above];
      if (outer.kind == BtcppKind::SubTree) return outer.path + "/";
    }
    return "";
  }

  const RecordedRun& run_;
  const Children children_;
  std::vector<std::optional<std::size_t>> place_;  // by recorded number
  LoggedTree tree_;
};

class Writer {
 public:
  explicit Writer(const LoggedTree& tree) : tree_(tree) {}

  std::string write() {
    text_ = "<root BTCPP_format=\"4\">\n";
    std::vector<std::size_t> top;
    if (!tree_.nodes.empty()) top.push_back(0);
    write_tree(tree_.id, "", top);
    for (const LoggedNode& node : tree_.nodes) {
      if (node.kind != BtcppKind::SubTree) continue;
      write_tree(node.id, node.path, node.children);
    }
    write_models();
    return text_ + "</root>\n";
  }

 private:
  void line(std::size_t depth, std::string_view tag) {
    text_ += fmt::format("{:{}}{}\n", "", 4 * depth, tag);
  }

  // `top` is none or one.
  void write_tree(const std::string& id, const std::string& path,
                  const std::vector<std::size_t>& top) {
    const std::string tag =
        fmt::format("<BehaviorTree ID=\"{}\" _fullpath=\"{}\"", xml_escaped(id),
                    xml_escaped(path));
    if (top.empty()) return line(1, tag + "/>");
    line(1, tag + ">");
    write_nodes(top[0]);
    line(1, "</BehaviorTree>");
  }

  // A node of this tree has no children here if it is a SubTree.
  const std::vector<std::size_t>& children(std::size_t place) const {
    static const std::vector<std::size_t> kNone;
    const LoggedNode& node = tree_.nodes[place];
    return node.kind == BtcppKind::SubTree ? kNone : node.children;
  }

  void write_nodes(std::size_t top) {
    struct Open {
      std::size_t place;
      std::size_t next = 0;
    };
    std::vector<Open> open{{top}};
    while (!open.empty()) {
      const std::size_t depth = open.size() + 1;
      Open& here = open.back();
      const auto& below = children(here.place);
      if (here.next == 0) line(depth, start_tag(here.place, below.empty()));
      if (here.next < below.size()) {
        open.push_back({below[here.next++]});
        continue;
      }
      if (!below.empty()) line(depth, "</" + tree_.nodes[here.place].id + ">");
      open.pop_back();
    }
  }

  std::string start_tag(std::size_t place, bool is_empty) const {
    const LoggedNode& node = tree_.nodes[place];
    const char* end = is_empty ? "/>" : ">";
    if (node.kind == BtcppKind::SubTree) {
      return fmt::format("<SubTree ID=\"{}\" _fullpath=\"{}\" _uid=\"{}\"{}",
                         xml_escaped(node.id), xml_escaped(node.path),
                         place + 1, end);
    }
    return fmt::format("<{} name=\"{}\" _uid=\"{}\"{}", node.id,
                       xml_escaped(node.name), place + 1, end);
  }

  void write_models() {
    std::map<std::string, BtcppKind> models = tree_.own_models;
    for (const std::string& id : btcpp::builtin_names(BtcppRelease::V4)) {
      models.emplace(id, builtin(id)->kind);
    }
    line(1, "<TreeNodesModel>");
    for (const auto& [id, kind] : models) write_model(id, kind);
    line(1, "</TreeNodesModel>");
  }

  void write_model(const std::string& id, BtcppKind kind) {
    const auto word = kBtcppKindNames[static_cast<std::size_t>(kind)];
    const std::string tag = fmt::format("<{} ID=\"{}\"", word, id);
    const btcpp::NodeTypeRow* type = builtin(id);
    if (type == nullptr || type->ports.empty()) return line(2, tag + "/>");
    line(2, tag + ">");
    // BehaviorTree.CPP goes through a hash table, mostly the last first.
    for (auto port = type->ports.rbegin(); port != type->ports.rend(); ++port) {
      write_port(*port);
    }
    line(2, fmt::format("</{}>", word));
  }

  void write_port(const btcpp::PortRow& port) {
    const auto word = kDirectionWords[static_cast<std::size_t>(port.direction)];
    const auto type = port.type_word.empty()
                          ? kTypeWords[static_cast<std::size_t>(port.type)]
                          : port.type_word;
    std::string tag =
        fmt::format("<{} name=\"{}\" type=\"{}\"", word, port.name, type);
    if (!port.preset.empty())
      tag += fmt::format(" default=\"{}\"", port.preset);
    tag +=
        port.about.empty() ? "/>" : fmt::format(">{}</{}>", port.about, word);
    line(3, tag);
  }

  const LoggedTree& tree_;
  std::string text_;
};

}  // namespace

LoggedTree btcpp_tree(const RecordedRun& run) { return Loader(run).load(); }

std::string btcpp_xml(const LoggedTree& tree) { return Writer(tree).write(); }

}  // namespace btcheck
