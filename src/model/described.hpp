// SPDX-License-Identifier: MIT
//
// What the files say of each node of a tree, for somebody who points at one:
// its ports with what is written there, and what a model or the engine tells of
// them. Nothing is searched.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/tree/tree.hpp"
#include "model/tree_file.hpp"

namespace btcheck {

struct DescribedPort {
  std::string name;
  std::optional<BtcppDirection> direction;  // nothing where nobody tells it
  std::string type;                         // "int"; "" where nobody tells it
  std::optional<std::string> value;         // as written; nothing: it is not
  std::optional<std::string> preset;        // what it is without
  std::string about;                        // what it is for; may be ""
  std::string
      entry;         // the blackboard entry that the value points at; may be ""
  std::string file;  // where the value stands
  SourceSpan span;
};

struct DescribedNode {
  std::string type;   // as it is registered: "RetryUntilSuccessful", "Dock"
  std::string kind;   // "Tree", "Control", "Decorator", "Action", …
  std::string about;  // what a model says of the type; may be ""
  std::vector<DescribedPort> ports;  // those of the type first, as it has them
};

// By node. The tree is what was read of the text, by the same reading.
std::vector<DescribedNode> described_nodes(const BehaviorTree& tree,
                                           const FileText& text,
                                           TreeReading reading);

// An entry of the blackboard, or a state variable of a .btf tree.
struct DescribedEntry {
  std::string name;
  std::vector<std::string> values;  // that are told apart; of a number none
  std::vector<NodeId> writers;      // ascending
  std::vector<NodeId> readers;
};
std::vector<DescribedEntry> described_entries(const BehaviorTree& tree);

}  // namespace btcheck
