// SPDX-License-Identifier: MIT
//
// Leaves of which nothing is known, by their types: what the trees show of
// them, and that as a file for a project to fill in.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/btcpp/document.hpp"

namespace btcheck {

// Whether one of the patterns, names and types of leaves that are described
// elsewhere, is about this leaf.
bool is_described(const BtcppNode& node, std::span<const std::string> patterns);

struct UnknownLeaf {
  BtcppKind kind = BtcppKind::Action;  // Action or Condition
  bool is_told = false;                // by a tag; else guessed from the name
  // In the order in which they are seen. A port that is given a literal
  // somewhere is an input; of another nothing can be told.
  std::vector<std::pair<std::string, bool>> ports;
  std::set<std::pair<std::string, int>> uses;  // file and line
};

class UnknownLeaves {
 public:
  // Adds those of all trees of a document. A file that was added before counts
  // once.
  void add(const BtcppDocument& document,
           std::span<const std::string> described = {});

  const std::map<std::string, UnknownLeaf>& types() const { return types_; }

  // As <TreeNodesModel>. A port of which the direction is not known is an
  // inout_port, which promises nothing.
  std::string xml() const;
  // As contracts that say what is taken for granted without them.
  std::string contracts() const;

 private:
  std::map<std::string, UnknownLeaf> types_;
  BtcppRelease release_ = BtcppRelease::V3;  // the newest of the files
};

}  // namespace btcheck
