// SPDX-License-Identifier: MIT
//
// What both directions of a conversion share: what is said of it, and which
// trees are written.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/export/conversion.hpp"

namespace btcheck::conversion {

class Told {
 public:
  Told(const BehaviorTree& tree, const SourceText& source)
      : tree_(tree), source_(source) {}

  void error(const Node& node, std::string message, std::string help);
  void left_out(const Node& node, std::string message, std::string help = {});
  // Once for each type that differs.
  void differs(const Node& node);

  std::vector<Diagnostic> take() { return std::move(found_); }

 private:
  void add(Severity severity, std::string_view code, const Node& node,
           std::string message, std::string help);

  const BehaviorTree& tree_;
  const SourceText& source_;
  std::set<NodeType> told_types_;
  std::vector<Diagnostic> found_;
};

// The roots, and the first SubTree node of each name.
std::vector<NodeId> subtrees_of(const BehaviorTree& tree);

// What a root or a SubTree calls its tree.
std::string tree_name(const Node& node);

}  // namespace btcheck::conversion
