// SPDX-License-Identifier: MIT
//
// The tree of a run as BehaviorTree.CPP would have loaded it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/btcpp/document.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

struct LoggedNode {
  BtcppKind kind = BtcppKind::Action;
  std::string id;    // of its type, as it is registered; a SubTree's: its tree
  std::string name;  // of the instance
  std::string path;  // of the tree below a SubTree, "outer::3/inner::7"
  std::optional<std::uint32_t> recorded;  // its number in the run
  std::optional<std::size_t> parent;      // its place in `nodes`
  std::vector<std::size_t> children;      // theirs
};

// Nodes in pre-order. The _uid of a node is its place and one. The root of a
// .btf tree is the <BehaviorTree> of the XML and no node; where several trees
// run in parallel, they are SubTrees of a ParallelAll that no run has recorded.
struct LoggedTree {
  std::string id;  // of the main tree
  std::vector<LoggedNode> nodes;
  // Types that BehaviorTree.CPP does not bring along, by their id.
  std::map<std::string, BtcppKind> own_models;
};

LoggedTree btcpp_tree(const RecordedRun& run);

// As `WriteTreeToXML(tree, true, true)` writes it: nodes with _uid, trees with
// _fullpath, a TreeNodesModel of all types. Ends in a newline. Ports are absent
// from nodes: a run has not recorded them.
std::string btcpp_xml(const LoggedTree& tree);

}  // namespace btcheck
