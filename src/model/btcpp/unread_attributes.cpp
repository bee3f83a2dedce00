// SPDX-License-Identifier: MIT
//
// Attributes that neither the engine reads nor a leaf of the program can ask
// for: other tools keep guards in them, which are lost here. MoVe4BT has its
// own on leaves, where they look like ports.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/source_files.hpp"
#include "text/choice.hpp"

namespace btcheck::btcpp {
namespace {

// What editors and logs write for themselves: Groot2, MoveIt Pro, Nav2's
// loggers. And what is read elsewhere.
constexpr std::array<std::string_view, 17> kKnown = {
    "ID",           "name",       "BTCPP_format", "main_tree_to_execute",
    "project_name", "_autoremap", "__autoremap",  "__shared_blackboard",
    "_description", "_fullpath",  "_uid",         "_collapsed",
    "_external",    "_favorite",  "_hardcoded",   "_subtreeOnly",
    "py_trees"};

constexpr std::array<std::string_view, 6> kOfMove4bt = {
    "success_guard",   "failure_guard",   "running_guard",
    "success_program", "failure_program", "running_program"};

template <class Names>
bool is_among(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

class UnreadAttributes {
 public:
  explicit UnreadAttributes(BtcppRelease release) : release_(release) {}

  void add(std::string_view name, const BtcppPlace& place) {
    const bool is_of_xml =
        name.starts_with("xmlns") || name.starts_with("xsi:");
    if (is_of_xml || is_among(kKnown, name)) return;
    if (!meant_condition(release_, name).empty()) return;  // there is a warning
    if (names_.empty()) first_ = place;
    names_.emplace(name);
  }

  void add(const BtcppNode& node) {
    for (const BtcppAttribute& other : node.others) {
      add(other.name, other.name_place);
    }
    if (node.is_known || !node.children.empty()) return;
    for (const BtcppAttribute& port : node.ports) {
      if (is_among(kOfMove4bt, port.name)) add(port.name, port.name_place);
    }
  }

  void note(FileFindings& findings) const {
    if (names_.empty()) return;
    const std::vector<std::string> names(names_.begin(), names_.end());
    const bool has_guards = std::ranges::any_of(
        names, [](const auto& name) { return is_among(kOfMove4bt, name); });
    findings.note(
        first_,
        {"BT1653",
         fmt::format("{} {} not read", listed(names),
                     names.size() == 1 ? "is" : "are"),
         "neither a port nor a condition of the engine",
         has_guards
             ? fmt::format("MoVe4BT's guards and programs are lost: say in a "
                           "contract what the leaf does ({}, `:succeeds-when` "
                           "and `:on-success`)",
                           word(Choice::Leaves))
             : "if another tool has a guard there, it is lost: version 4 has "
               "`_while`, `_skipIf` and others"});
  }

 private:
  BtcppRelease release_;
  BtcppPlace first_;
  std::set<std::string, std::less<>> names_;
};

// MoveIt Pro writes the entries of a tree, with values to try it, beside its
// ID.
bool is_entry_of(const BtcppTree* tree, std::string_view name) {
  const auto names_it = [&](const BtcppAttribute& each) {
    return each.value.find(name) != each.value.npos;
  };
  return tree != nullptr &&
         std::ranges::any_of(tree->nodes, [&](const BtcppNode& node) {
           return std::ranges::any_of(node.ports, names_it) ||
                  std::ranges::any_of(node.conditions, names_it);
         });
}

}  // namespace

void note_unread_attributes(const SourceFile& file,
                            const BtcppDocument& document,
                            FileFindings& findings) {
  UnreadAttributes unread(document.release);
  const auto add_all = [&](const XmlElement& element, const BtcppTree* tree) {
    for (const XmlAttribute& each : element.attributes) {
      if (is_entry_of(tree, each.name)) continue;
      unread.add(each.name, file.place(each.name_span));
    }
  };
  add_all(file.root(), nullptr);
  for (const std::size_t child : file.root().children) {
    const XmlElement& element = file.elements()[child];
    if (element.name != "BehaviorTree") continue;
    const std::string* id = element.value("ID");
    add_all(element, id == nullptr ? nullptr : document.tree(*id));
  }
  for (const BtcppTree& tree : document.trees) {
    if (tree.place.file != file.number) continue;
    for (const BtcppNode& node : tree.nodes) unread.add(node);
  }
  unread.note(findings);
}

}  // namespace btcheck::btcpp
