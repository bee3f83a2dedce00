// SPDX-License-Identifier: MIT
//
// Parallel and ParallelAll of the engine (src/controls/parallel_node.cpp and
// parallel_all_node.cpp of 4.10; parallel_node.cpp of 3.8.8). Children are
// ticked from left to right, except those that have ended. Whether one has
// ended, its status says, since only the Parallel resets it.
#include "model/mapping/btcpp/builder.hpp"

namespace btcheck::mapping {
namespace {

Expression sum(VariableId one, std::optional<VariableId> other) {
  return other ? Expression::binary(Operation::Add, read(one), read(*other))
               : read(one);
}

void draw_engine_parallel(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const Node& node = draw.node();
  // Older releases start counting anew in every tick, and compare a count only
  // when it has just grown; whether all children were skipped they note from
  // idle to idle.
  const bool counts_anew = releases::parallel_counts_anew(build.release());
  const int children = static_cast<int>(draw.child_count());
  const int enough = threshold_of(node.threshold, children);
  const int too_many = threshold_of(node.failure_threshold, children);
  const VariableId succeeded = draw.local("succeeded", 0, children, 0);
  const VariableId failed = draw.local("failed", 0, children, 0);
  std::optional<VariableId> skipped;
  if (build.some_child_may_skip() && !counts_anew)
    skipped = draw.local("skipped", 0, children, 0);
  std::optional<VariableId> all_skipped;
  if (build.every_child_may_skip() && counts_anew)
    all_skipped = draw.local("all_skipped", 0, 1, 1);
  const std::vector<Assignment> clear = {set(succeeded, 0), set(failed, 0)};

  const Expression is_enough = Expression::binary(
      Operation::GreaterEqual,
      sum(succeeded, node.counts_skipped ? skipped : std::nullopt),
      Expression::constant(enough));
  const Expression fails =
      either(at_least(failed, children - enough + 1), equals(failed, too_many));
  const LocationId passes = build.resetting("enough", build.success(), clear);
  const LocationId gives_up =
      build.resetting("too_many", build.failure(), clear);
  const auto not_skipped = set_if_there(all_skipped, 0);
  if (all_skipped) {
    build.start_anew(build.at("begin"), {set(*all_skipped, 1)});
  }
  draw.edge(all_skipped ? build.at("begin") : build.body(), build.turn(0), {},
            counts_anew ? clear : set_if_there(skipped, 0));
  for (std::size_t i = 0; i < draw.child_count(); ++i) {
    const std::string number = std::to_string(i + 1);
    const LocationId here = build.turn(i);
    const LocationId look = build.at("after_" + number);
    // 4.10 compares both counts, whatever the child has answered.
    const LocationId passed = counts_anew ? build.at("passed_" + number) : look;
    const LocationId erred = counts_anew ? build.at("failed_" + number) : look;
    Reactions reactions{
        .success = {{passed, joined(not_skipped, {count(succeeded)})}},
        .failure = {{erred, joined(not_skipped, {count(failed)})}},
        .running = {{counts_anew ? build.turn(i + 1) : look, not_skipped}},
        .skipped = {{build.turn(i + 1)}}};
    if (skipped) reactions.skipped = {{look, {count(*skipped)}}};
    const Expression passed_before = build.has(i, NodeStatus::Success);
    const Expression failed_before = build.has(i, NodeStatus::Failure);
    const Expression ended = either(passed_before, failed_before);
    draw.edge(here, build.tick(i, reactions), negated(ended));
    if (!counts_anew) {
      draw.edge(here, look, ended);
      draw.edge(look, passes, is_enough);
      draw.edge(look, gives_up, both(negated(is_enough), fails));
      draw.edge(look, build.turn(i + 1),
                both(negated(is_enough), negated(fails)));
      continue;
    }
    draw.edge(here, passed, passed_before,
              joined(not_skipped, {count(succeeded)}));
    draw.edge(here, erred, failed_before, joined(not_skipped, {count(failed)}));
    draw.edge(passed, passes, equals(succeeded, enough));
    draw.edge(passed, build.turn(i + 1), differs(succeeded, enough));
    draw.edge(erred, gives_up, fails);
    draw.edge(erred, build.turn(i + 1), negated(fails));
  }
  const LocationId end = build.at("end");
  if (all_skipped) {
    draw.edge(end, build.skipped(), equals(*all_skipped, 1));
    draw.edge(end, build.running(), equals(*all_skipped, 0));
  } else if (build.every_child_may_skip()) {
    draw.edge(end, build.skipped(), equals(*skipped, children));
    draw.edge(end, build.running(), differs(*skipped, children));
  } else {
    draw.edge(end, build.running());
  }
  build.on_halt(clear);
}

// All children are ticked in every tick until each has ended or been skipped.
void draw_engine_parallel_all(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const int children = static_cast<int>(draw.child_count());
  const int too_many = threshold_of(draw.node().failure_threshold, children);
  const VariableId failed = draw.local("failed", 0, children, 0);
  const VariableId open = draw.local("open", 0, children, 0);
  std::optional<VariableId> skipped;
  if (build.every_child_may_skip()) {
    skipped = draw.local("skipped", 0, children, 0);
  }
  draw.edge(build.body(), build.turn(0), {},
            joined({set(open, 0)}, set_if_there(skipped, 0)));
  for (std::size_t i = 0; i < draw.child_count(); ++i) {
    const LocationId here = build.turn(i);
    const LocationId next = build.turn(i + 1);
    Reactions reactions{.success = {{next}},
                        .failure = {{next, {count(failed)}}},
                        .running = {{next, {count(open)}}},
                        .skipped = {{next}}};
    if (skipped) reactions.skipped[0].updates = {count(*skipped)};
    const Expression has_ended = either(build.has(i, NodeStatus::Success),
                                        build.has(i, NodeStatus::Failure));
    draw.edge(here, build.tick(i, reactions), negated(has_ended));
    draw.edge(here, next, has_ended);
  }
  const LocationId end = build.at("end");
  Expression not_skipped;
  if (skipped) {
    draw.edge(end, build.skipped(), equals(*skipped, children));
    not_skipped = differs(*skipped, children);
  }
  draw.edge(end, build.running(), both(not_skipped, differs(open, 0)));
  const Expression over = both(not_skipped, equals(open, 0));
  const Expression fails =
      too_many > 0 ? at_least(failed, too_many) : Expression{};
  build.reset(end, build.failure(), build.all_children(), {set(failed, 0)},
              both(over, fails));
  if (too_many > 0) {
    build.reset(end, build.success(), build.all_children(), {set(failed, 0)},
                both(over, negated(fails)));
  }
  build.on_halt({set(failed, 0)});
}

constexpr Drawing kEngineParallelRows[] = {
    {NodeType::Parallel, draw_engine_parallel},
    {NodeType::ParallelAll, draw_engine_parallel_all}};

}  // namespace

constinit const Family kEngineParallelDrawings = kEngineParallelRows;

}  // namespace btcheck::mapping
