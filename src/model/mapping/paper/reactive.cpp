// SPDX-License-Identifier: MIT
//
// ReactiveSequence and ReactiveFallback with :halt and :wait (paper, sections
// 3.4, 3.5 and 3.8.1). Every tick starts at the first child. A child decides
// when it fails (Sequence) or succeeds (Fallback); children to its right may
// then still be running from an earlier tick: they are halted, or waited for,
// or, with neither option, left behind.
#include "model/mapping/paper/drawings.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::mapping {
namespace {

// With :wait the decision is kept in the local `deciding`; while it is 1 a
// tick only goes to the children that still run.
void draw_waiting(NodeBuilder& draw, LocationId from, VariableId deciding,
                  LocationId decided) {
  const std::size_t count = draw.child_count();
  draw.edge(from, draw.at("wait_1"), equals(deciding, 1));
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(i + 1);
    LocationId here = draw.at("wait_" + number);
    LocationId next = draw.at("wait_" + std::to_string(i + 2));
    LocationId back = draw.at("wait_" + number + "_done");
    VariableId status = draw.context().status(draw.child(i));
    VariableId caller = draw.context().caller(draw.child(i));
    draw.edge(here, next,
              differs(status, static_cast<int>(NodeStatus::Running)));
    draw.edge(here, back, equals(status, NodeStatus::Running), {set(caller, 1)},
              "waits for a child that still runs");
    draw.edge(back, next, equals(caller, 0));
  }
  LocationId end = draw.at("wait_" + std::to_string(count + 1));
  draw.edge(end, draw.at("running"), draw.some_child_runs());
  draw.edge(end, decided, negated(draw.some_child_runs()), {set(deciding, 0)});
}

}  // namespace

void draw_reactive(NodeBuilder& draw) {
  const bool is_fallback = draw.node().type == NodeType::ReactiveFallback;
  const NodeStatus goes_on =
      is_fallback ? NodeStatus::Failure : NodeStatus::Success;
  const NodeStatus decides =
      is_fallback ? NodeStatus::Success : NodeStatus::Failure;
  const bool halts = draw.node().halt;
  const bool waits = draw.node().wait && !halts;
  const std::size_t count = draw.child_count();

  draw.frame();
  LocationId from = draw.decide();
  LocationId all_passed = draw.at(is_fallback ? "failure" : "success");
  LocationId decided = draw.at(is_fallback ? "success" : "failure");
  std::vector<Assignment> on_halt;
  Expression fresh;
  LocationId decision = decided;
  if (halts) {
    decision = draw.at("halt_rest");
    draw.halt_children(decision, decided);
  } else if (waits) {
    VariableId deciding = draw.local("deciding", 0, 1, 0);
    fresh = equals(deciding, 0);
    on_halt.push_back(set(deciding, 0));
    draw_waiting(draw, from, deciding, decided);
    decision = draw.at("decision");
    draw.edge(decision, draw.at("running"), draw.some_child_runs(),
              {set(deciding, 1)}, "waits for the children that still run");
    draw.edge(decision, decided, negated(draw.some_child_runs()));
  }
  draw.edge(from, draw.call(0), fresh);
  for (std::size_t i = 0; i < count; ++i) {
    draw.on_answer(i, goes_on, i + 1 < count ? draw.call(i + 1) : all_passed);
    draw.on_answer(i, decides, decision);
    draw.on_answer(i, NodeStatus::Running, draw.at("running"));
  }
  draw.on_halt(std::move(on_halt));
}

}  // namespace btcheck::mapping
