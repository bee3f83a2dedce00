// SPDX-License-Identifier: MIT
//
// Subtrees take rows that follow one another, so nodes of one depth cannot
// meet, and every column is as wide as its widest label.
#include "trace/pictures/tree_layout.hpp"

#include <algorithm>

#include "trace/pictures/phase_look.hpp"
#include "trace/run/run_walk.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kLongestLabel = 30;
constexpr double kRow = 26;
constexpr double kColumnGap = 26;
constexpr double kGlyphRoom = 22;  // left of the label
constexpr double kRightRoom = 8;

}  // namespace

TreeLayout laid_out(const RecordedRun& run) {
  const Children children = children_of(run);
  const std::size_t count = run.nodes.size();
  TreeLayout layout;
  layout.boxes.resize(count);
  std::vector<std::size_t> depth(count, 0);
  std::vector<double> column_width;
  double row = 0;
  for (std::size_t n = 0; n < count; ++n) {
    if (run.nodes[n].parent) depth[n] = depth[*run.nodes[n].parent] + 1;
    NodeBox& box = layout.boxes[n];
    box.is_leaf = children[n].empty();
    box.label =
        shortened(node_label(run.nodes[n], !box.is_leaf), kLongestLabel);
    if (column_width.size() <= depth[n]) column_width.resize(depth[n] + 1, 0);
    const double letters = static_cast<double>(letter_count(box.label));
    column_width[depth[n]] =
        std::max(column_width[depth[n]],
                 kGlyphRoom + letters * kLetterWidth + kRightRoom);
    if (box.is_leaf) box.y = kRow * row++;
  }
  std::vector<double> column_begin;
  for (const double width : column_width) {
    column_begin.push_back(layout.width);
    layout.width += width + kColumnGap;
  }
  layout.width = std::max(0.0, layout.width - kColumnGap);
  layout.height = std::max(0.0, row * kRow - (kRow - TreeLayout::kBoxHeight));
  for (std::size_t n = count; n-- > 0;) {  // children before parents
    NodeBox& box = layout.boxes[n];
    box.x = column_begin[depth[n]];
    box.width = column_width[depth[n]];
    if (box.is_leaf) continue;
    box.y = (layout.boxes[children[n].front()].y +
             layout.boxes[children[n].back()].y) /
            2;
  }
  return layout;
}

}  // namespace btcheck
