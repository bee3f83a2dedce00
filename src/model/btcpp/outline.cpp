// SPDX-License-Identifier: MIT
#include "model/btcpp/outline.hpp"

#include <algorithm>

#include "model/btcpp/document.hpp"
#include "model/btcpp/xml_text.hpp"

namespace btcheck {

bool XmlOutline::has(std::string_view tree) const {
  return std::ranges::find(trees, tree) != trees.end();
}

std::optional<XmlOutline> outline_of(const FileText& file) {
  // Most XML of a robot is something else.
  const std::string& text = file.text();
  if (text.find("<root") == std::string_view::npos) return std::nullopt;
  if (SourceText("", text).refuse_binary()) return std::nullopt;
  const auto parsed = file.parsed<btcpp::ParsedXml>();
  const auto& elements = parsed->value;
  XmlOutline outline;
  if (!elements) {
    if (text.find("<BehaviorTree") == std::string_view::npos) {
      return std::nullopt;
    }
    outline.trees.emplace_back();
    return outline;
  }
  if (elements->front().name != "root") return std::nullopt;
  const btcpp::XmlElement& root = elements->front();
  if (const auto* main = root.value("main_tree_to_execute")) {
    outline.main = *main;
  }
  std::vector<bool> is_in_tree(elements->size(), false);
  for (std::size_t i = 1; i < elements->size(); ++i) {
    const btcpp::XmlElement& element = (*elements)[i];
    if (element.parent == 0) {
      is_in_tree[i] = element.name == "BehaviorTree";
      outline.has_models |= element.name == "TreeNodesModel";
      if (is_in_tree[i]) outline.trees.push_back(element.value_or_empty("ID"));
      if (element.name == "include") {
        outline.includes.push_back(element.value_or_empty("path"));
      }
      continue;
    }
    if ((*elements)[element.parent].name == "TreeNodesModel") {
      outline.has_node_models |= element.name != "SubTree";
    }
    is_in_tree[i] = is_in_tree[element.parent];
    if (!is_in_tree[i]) continue;
    const bool is_subtree = element.name.starts_with("SubTree");
    outline.uses.insert(is_subtree ? element.value_or_empty("ID")
                                   : element.name);
    if (is_subtree || !element.children.empty()) continue;
    outline.leaves.insert(
        kind_named(element.name) ? element.value_or_empty("ID") : element.name);
    if (const auto* name = element.value("name")) outline.leaves.insert(*name);
  }
  if (outline.trees.empty() && outline.includes.empty() &&
      !outline.has_models) {
    return std::nullopt;
  }
  return outline;
}

}  // namespace btcheck
