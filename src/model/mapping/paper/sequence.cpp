// SPDX-License-Identifier: MIT
//
// Sequence, SequenceWithMemory and Fallback (paper, sections 3.4 and 3.5,
// figures 9 and 18; the listing of appendix B). The three are one automaton:
// a Fallback is a Sequence with success and failure exchanged, and memory is
// in what the local `next_seq` becomes when a child stops the row.
#include "model/mapping/paper/drawings.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::mapping {

void draw_sequence(NodeBuilder& draw) {
  const bool is_fallback = draw.node().type == NodeType::Fallback;
  const bool remembers = draw.node().type == NodeType::SequenceWithMemory;
  const NodeStatus goes_on =
      is_fallback ? NodeStatus::Failure : NodeStatus::Success;
  const NodeStatus stops =
      is_fallback ? NodeStatus::Success : NodeStatus::Failure;
  const int count = static_cast<int>(draw.child_count());

  draw.frame();
  VariableId next =
      draw.local(is_fallback ? "next_fb" : "next_seq", 1, count, 1);
  LocationId all_passed = draw.at(is_fallback ? "failure" : "success");
  LocationId stopped = draw.at(is_fallback ? "success" : "failure");
  LocationId from = draw.decide();
  for (int i = 1; i <= count; ++i) {
    const std::size_t child = static_cast<std::size_t>(i - 1);
    draw.edge(from, draw.call(child), equals(next, i));
    if (i < count) {
      draw.on_answer(child, goes_on, draw.call(child + 1));
    } else {
      draw.on_answer(child, goes_on, all_passed, {set(next, 1)});
    }
    draw.on_answer(child, stops, stopped, {set(next, remembers ? i : 1)});
    draw.on_answer(child, NodeStatus::Running, draw.at("running"),
                   {set(next, i)});
  }
  if (remembers) {
    draw.on_halt();
  } else {
    draw.on_halt({set(next, 1)});
  }
}

}  // namespace btcheck::mapping
