// SPDX-License-Identifier: MIT
//
// Node ids are in pre-order, so the nodes as they come are the tree as it is
// written, and each depth follows from the parent's.
#include "model/export/tree_comment.hpp"
#include "model/tree/node_types.hpp"

#include <fmt/format.h>

#include <vector>

namespace btcheck {

std::string comment_text(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    const bool ends_comment = c == '/' && !safe.empty() && safe.back() == '*';
    const bool is_control = static_cast<unsigned char>(c) < ' ';
    if (ends_comment) safe += ' ';
    safe += is_control || c == '\\' ? ' ' : c;
  }
  return safe;
}

std::string tree_lines(const BehaviorTree& tree, std::string_view margin) {
  std::string text;
  std::vector<std::size_t> depth(tree.nodes.size(), 0);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    if (!node.is_root()) depth[n] = depth[index(node.parent)] + 1;
    text += fmt::format("{}line {:<4}{:{}}{} {}\n", margin, node.span.line, "",
                        1 + 2 * depth[n], type_name(node.type),
                        comment_text(unique_name(tree, NodeId{n})));
  }
  return text;
}

}  // namespace btcheck
