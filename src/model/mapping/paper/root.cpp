// SPDX-License-Identifier: MIT
//
// The BehaviorTree node (paper, section 3.8.2): it makes the ticks. Each takes
// one unit of time; while the child answers running the next one follows, and
// success or failure is for ever unless :loop starts the tree again.
#include "model/mapping/paper/drawings.hpp"

namespace btcheck::mapping {

void draw_root(NodeBuilder& draw) {
  VariableId status = draw.context().status(draw.id());
  LocationId start = draw.at("start_");
  LocationId tick = draw.at("tick_node");
  draw.edge(start, tick, {}, {set(status, NodeStatus::NoRetStatus)});
  draw.timed_edge(tick, draw.call(0), {1, 1}, "tick");
  auto ends = [&](NodeStatus answer, bool again) {
    std::string_view word = kStatusNames[static_cast<int>(answer)];
    draw.on_answer(0, answer, draw.at(word), {set(status, answer)});
    if (again) draw.edge(draw.at(word), start);
  };
  ends(NodeStatus::Running, true);
  ends(NodeStatus::Success, draw.node().loop);
  ends(NodeStatus::Failure, draw.node().loop);
}

}  // namespace btcheck::mapping
