// SPDX-License-Identifier: MIT
//
// What a file of tests says of its tree besides the tests.
#pragma once

#include <string>
#include <vector>

#include "check/check.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

struct SuiteLeafPort {
  std::string name;
  char direction = 'i';  // or 'o', or 'b' for both
  std::string type;      // int, unsigned, bool, double, string; else ""
};

// A type of leaf that the program registers.
struct SuiteLeaf {
  std::string id;
  bool is_condition = false;
  std::vector<SuiteLeafPort> ports;
};

struct DescribedSuite {
  std::string name;   // an identifier
  std::string file;   // the tree's, as the user names it
  std::string title;  // the ID of the tree that runs
  int release = 4;    // of BehaviorTree.CPP; 0 for trees of other engines
  std::string xml;    // the tree with all that it includes, in one text
  std::vector<SuiteLeaf> leaves;
  std::vector<std::string> keys;  // by NodeId, as `btcheck simulate` has them
  // Types of nodes with children, or of the engine's kind, that a program has
  // to register: those of Nav2.
  std::vector<std::string> linked;
  // Why no engine can run it with fakes alone: types of the program's own.
  std::vector<std::string> unknown;
};

DescribedSuite described_suite(const TreeInput& input,
                               const BehaviorTree& tree);

}  // namespace btcheck
