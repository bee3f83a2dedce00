// SPDX-License-Identifier: MIT
//
// Where the nodes of a tree stand in a picture.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// Of the letters on boxes, a monospaced font of 11 px.
inline constexpr double kLetterWidth = 6.7;

struct NodeBox {
  std::string label;  // no longer than the box
  double x = 0;       // of the upper left corner
  double y = 0;
  double width = 0;
  bool is_leaf = false;
};

struct TreeLayout {
  static constexpr double kBoxHeight = 20;
  std::vector<NodeBox> boxes;  // by number of the node
  double width = 0;
  double height = 0;
};

// From left to right, a column for each depth and a row for each leaf; a node
// stands at the middle of its children. No two boxes touch.
TreeLayout laid_out(const RecordedRun& run);

}  // namespace btcheck
