// SPDX-License-Identifier: MIT
//
// What an XML file is about, without reading it in full: which files of a
// folder have trees, and who uses whose.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "text/input_file.hpp"

namespace btcheck {

struct XmlOutline {
  std::vector<std::string> trees;  // IDs, "" for a tree without one
  std::set<std::string> uses;      // IDs of SubTrees, and tags
  std::set<std::string> leaves;    // types and names of nodes without children
  std::vector<std::string> includes;  // as written
  std::optional<std::string> main;    // main_tree_to_execute
  bool has_models = false;            // a <TreeNodesModel>
  bool has_node_models = false;       // and models that are none of SubTrees

  bool has(std::string_view tree) const;
};

// Nothing for what is no file of BehaviorTree.CPP: another root than <root>, or
// neither trees, models nor includes in it. XML with a fault in it has a tree
// without an ID when it has the word for one.
std::optional<XmlOutline> outline_of(const FileText& text);

}  // namespace btcheck
