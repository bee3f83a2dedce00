// SPDX-License-Identifier: MIT
//
// The control nodes that Nav2 adds: Recovery, RoundRobin, PipelineSequence, as
// the paper gives them (sections 5.2.1 and 5.2.2).
#include "model/mapping/paper/drawings.hpp"

namespace btcheck::mapping {

// Child 1 is the work, child 2 the recovery. The local `retry` counts the
// recoveries done, `next` is the child to be ticked.
void draw_recovery(NodeBuilder& draw) {
  const int retries = draw.node().repetitions;
  constexpr std::size_t kWork = 0;
  constexpr std::size_t kRecovery = 1;

  draw.frame();
  VariableId retry = draw.local("retry", 0, retries, 0);
  VariableId next = draw.local("next", 1, 2, 1);
  std::vector<Assignment> reset = {set(retry, 0), set(next, 1)};
  LocationId from = draw.decide();
  draw.edge(from, draw.call(kWork), equals(next, 1));
  draw.edge(from, draw.call(kRecovery), equals(next, 2));
  draw.on_answer(kWork, NodeStatus::Success, draw.at("success"), reset);
  draw.on_answer(kWork, NodeStatus::Failure, draw.call(kRecovery),
                 {set(next, 2)}, differs(retry, retries));
  draw.on_answer(kWork, NodeStatus::Failure, draw.at("failure"), reset,
                 equals(retry, retries));
  draw.on_answer(kWork, NodeStatus::Running, draw.at("running"));
  for (int done = 0; done < retries; ++done) {
    draw.on_answer(kRecovery, NodeStatus::Success, draw.call(kWork),
                   {set(retry, done + 1), set(next, 1)}, equals(retry, done));
  }
  draw.on_answer(kRecovery, NodeStatus::Failure, draw.at("failure"), reset);
  draw.on_answer(kRecovery, NodeStatus::Running, draw.at("running"));
  draw.on_halt(reset);
}

// Ticks its children in turn. `next` is the child whose turn it is, `failed`
// how many failed in a row before it.
void draw_round_robin(NodeBuilder& draw) {
  const int count = static_cast<int>(draw.child_count());

  draw.frame();
  VariableId next = draw.local("next", 1, count, 1);
  VariableId failed = draw.local("failed", 0, count - 1, 0);
  LocationId from = draw.decide();
  for (int i = 1; i <= count; ++i) {
    const std::size_t child = static_cast<std::size_t>(i - 1);
    const int following = i == count ? 1 : i + 1;
    draw.edge(from, draw.call(child), equals(next, i));
    draw.on_answer(child, NodeStatus::Success, draw.at("success"),
                   {set(next, following), set(failed, 0)});
    for (int before = 0; before + 1 < count; ++before) {
      draw.on_answer(child, NodeStatus::Failure,
                     draw.call(static_cast<std::size_t>(following - 1)),
                     {set(next, following), set(failed, before + 1)},
                     equals(failed, before));
    }
    draw.on_answer(child, NodeStatus::Failure, draw.at("failure"),
                   {set(next, following), set(failed, 0)},
                   equals(failed, count - 1));
    draw.on_answer(child, NodeStatus::Running, draw.at("running"));
  }
  draw.on_halt({set(next, 1), set(failed, 0)});
}

// Every tick goes from child 1 up to the furthest that has been reached: a
// running child before that one lets the next be ticked.
void draw_pipeline_sequence(NodeBuilder& draw) {
  const int count = static_cast<int>(draw.child_count());

  draw.frame();
  VariableId furthest = draw.local("furthest", 1, count, 1);
  LocationId failing = draw.at("halt_then_failure");
  LocationId passing = draw.at("halt_then_success");
  draw.halt_children(failing, draw.at("failure"), {set(furthest, 1)});
  draw.halt_children(passing, draw.at("success"), {set(furthest, 1)});
  draw.edge(draw.decide(), draw.call(0));
  for (int i = 1; i <= count; ++i) {
    const std::size_t child = static_cast<std::size_t>(i - 1);
    draw.on_answer(child, NodeStatus::Success,
                   i < count ? draw.call(child + 1) : passing);
    draw.on_answer(child, NodeStatus::Failure, failing);
    Expression is_furthest = Expression::binary(
        Operation::LessEqual, read(furthest), Expression::constant(i));
    draw.on_answer(child, NodeStatus::Running, draw.at("running"),
                   {set(furthest, i)}, i < count ? is_furthest : Expression{});
    if (i < count) {
      draw.on_answer(child, NodeStatus::Running, draw.call(child + 1), {},
                     negated(is_furthest));
    }
  }
  draw.on_halt({set(furthest, 1)});
}

}  // namespace btcheck::mapping
