// SPDX-License-Identifier: MIT
//
// What must hold of everything the reader of BehaviorTree.CPP's XML returns,
// whatever the text was. The mutation tests and the fuzzer ask the same.
#pragma once

#include <string>
#include <string_view>

#include "model/btcpp/document.hpp"
#include "model/btcpp/expand/expansion.hpp"

namespace btcheck {

// True when the span lies in a line that the file has, or is the whole file.
inline bool is_place_in(const BtcppDocument& document,
                        const BtcppPlace& place) {
  if (place.file >= document.files.size()) return false;
  const InputFile& file = document.files[place.file];
  const SourceText source(file.name, file.text);
  const int width = static_cast<int>(source.line(place.span.line).size());
  return place.span.line >= 1 && place.span.column >= 1 &&
         place.span.column <= width + 1;
}

inline std::string flaw_of(const BtcppDocument& document,
                           const BtcppTree& tree) {
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const BtcppNode& node = tree.nodes[i];
    if (node.id.empty()) return "a node without a type";
    if (i > 0 && node.parent >= i) return "a parent after its child";
    for (const std::uint32_t child : node.children) {
      if (child >= tree.nodes.size() || tree.nodes[child].parent != i) {
        return "a child of another node";
      }
    }
    if (!is_place_in(document, node.place)) return "a node out of the text";
    for (const BtcppAttribute& port : node.ports) {
      if (!is_place_in(document, port.place)) return "a port out of the text";
    }
  }
  return "";
}

inline std::string flaw_of(const BtcppExpansion& expansion) {
  for (std::size_t i = 0; i < expansion.nodes.size(); ++i) {
    const BtcppInstance& instance = expansion.nodes[i];
    if (instance.node == nullptr) return "an instance of nothing";
    if (instance.subtree >= expansion.subtrees.size()) return "no subtree";
    const bool is_subtree = instance.node->kind == BtcppKind::SubTree;
    const std::size_t count = is_subtree ? 1 : instance.node->children.size();
    if (instance.children.size() != count) return "children are missing";
    for (const std::uint32_t child : instance.children) {
      if (child <= i || expansion.nodes.at(child).parent != i) {
        return "a child that is another's";
      }
    }
  }
  for (const BtcppSubtree& subtree : expansion.subtrees) {
    const auto& root = expansion.nodes.at(subtree.first_node);
    if (root.node != &subtree.tree->nodes.front()) return "another's root";
  }
  return "";
}

// a.xml is a small tree, self.xml the text itself; there are no others.
inline IncludedFile included_beside(const IncludeRequest& request,
                                    std::string_view text) {
  IncludedFile file{std::string(request.path), std::nullopt, "no such file"};
  if (request.path == "self.xml") file.text = text;
  if (request.path == "a.xml") {
    file.text =
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Included\"><A/>"
        "</BehaviorTree></root>";
  }
  return file;
}

// What is wrong with what a text gives, or "". `expanded` counts the texts that
// were read to the end.
inline std::string flaw_of_reading(std::string_view text, int& expanded) {
  const auto loader = [&](const IncludeRequest& request) {
    return included_beside(request, text);
  };
  const auto document = read_btcpp("t.xml", text, loader);
  if (document.value.has_value() == has_error(document.diagnostics)) {
    return "a document and an error, or neither";
  }
  if (!document.value) return "";
  for (const BtcppTree& tree : document.value->trees) {
    std::string flaw = flaw_of(*document.value, tree);
    if (!flaw.empty()) return flaw;
  }
  const auto expansion = expand_btcpp(*document.value);
  if (expansion.value.has_value() == has_error(expansion.diagnostics)) {
    return "an expansion and an error, or neither";
  }
  if (!expansion.value) return "";
  ++expanded;
  return flaw_of(*expansion.value);
}

}  // namespace btcheck
