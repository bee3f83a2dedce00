// SPDX-License-Identifier: MIT
//
// What the tests of the reader of BehaviorTree.CPP's XML share.
#pragma once

#include <doctest/doctest.h>

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/expand/expansion.hpp"

namespace btcheck {

using NamedTexts = std::map<std::string, std::string>;

// A document and its expansion, which points into it.
struct ReadTree {
  std::unique_ptr<BtcppDocument> document;
  BtcppExpansion expansion;
  std::vector<Diagnostic> diagnostics;
  bool is_read = false;
};

// Includes are found among `others`, by the path as written.
inline ReadTree read_tree(std::string_view text, const NamedTexts& others = {},
                          const BtcppOptions& options = {}) {
  const auto loader = [&](const IncludeRequest& request) {
    const auto found = others.find(std::string(request.path));
    if (found == others.end()) {
      return IncludedFile{std::string(request.path), {}, "no such file"};
    }
    return IncludedFile{found->first, found->second, {}};
  };
  ReadTree tree;
  BtcppOptions of_newest = options;
  if (!options.release) of_newest.version = 41000;
  auto document = read_btcpp("t.xml", text, loader, of_newest);
  tree.diagnostics = std::move(document.diagnostics);
  if (!document.value) return tree;
  tree.document = std::make_unique<BtcppDocument>(std::move(*document.value));
  auto expansion = expand_btcpp(*tree.document);
  for (auto& found : expansion.diagnostics) {
    tree.diagnostics.push_back(std::move(found));
  }
  if (!expansion.value) return tree;
  tree.is_read = true;
  tree.expansion = std::move(*expansion.value);
  return tree;
}

// Text inside <root BTCPP_format="4">.
inline std::string version4(std::string_view inside) {
  return "<root BTCPP_format=\"4\">" + std::string(inside) + "</root>";
}

// A tree M of version 4, alone.
inline std::string tree4(std::string_view inside) {
  return version4("<BehaviorTree ID=\"M\">" + std::string(inside) +
                  "</BehaviorTree>");
}

// "BT1607 1:42 BT1620 1:50", in the order in which they are said.
inline std::string codes_of(const std::vector<Diagnostic>& diagnostics) {
  std::string codes;
  for (const Diagnostic& found : diagnostics) {
    if (!codes.empty()) codes += ' ';
    codes += found.code + ' ' + std::to_string(found.span.line) + ':' +
             std::to_string(found.span.column);
  }
  return codes;
}

// The codes alone, without the note that a leaf is in no model.
inline std::string codes_in(std::string_view text,
                            const NamedTexts& others = {}) {
  std::string codes;
  for (const Diagnostic& found : read_tree(text, others).diagnostics) {
    if (found.code == "BT1620") continue;
    if (!codes.empty()) codes += ' ';
    codes += found.code;
  }
  return codes;
}

// A tree that must be readable.
inline ReadTree good_tree(std::string_view text,
                          const NamedTexts& others = {}) {
  ReadTree tree = read_tree(text, others);
  std::string said;
  for (const Diagnostic& found : tree.diagnostics) said += render(found);
  INFO(said);
  REQUIRE(tree.is_read);
  return tree;
}

inline std::vector<std::string> paths_of(const ReadTree& tree) {
  std::vector<std::string> paths;
  for (const auto& node : tree.expansion.nodes) paths.push_back(node.path);
  return paths;
}

}  // namespace btcheck
