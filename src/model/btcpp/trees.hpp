// SPDX-License-Identifier: MIT
//
// <BehaviorTree>: from elements to nodes, and the checks that need one node and
// its children only.
#pragma once

#include <set>
#include <string>

#include "model/btcpp/document.hpp"
#include "model/btcpp/findings.hpp"
#include "model/btcpp/source_files.hpp"

namespace btcheck::btcpp {

// What the reader of one tree needs to know of all files.
struct TreeContext {
  BtcppDocument& document;         // its models are complete
  std::set<std::string> tree_ids;  // of all files, also of those not yet read
  int unnamed = 0;                 // trees without an ID, so far
};

// Adds the trees of one file to the document. A tree takes the place of an
// earlier one of the same ID, with a warning.
void read_trees(const SourceFile& file, TreeContext& context,
                FileFindings& findings);

}  // namespace btcheck::btcpp
