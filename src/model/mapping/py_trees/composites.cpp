// SPDX-License-Identifier: MIT
//
// Sequence, Selector, Parallel and EternalGuard of py_trees. Whether the node
// begins anew says its own status before the tick: it does unless it runs.
#include <string>
#include <utility>

#include "model/mapping/py_trees/drawings.hpp"

namespace btcheck::mapping {
namespace {

// Beginning anew it stops all children. A child that does not succeed ends the
// tick; without memory all children behind it are stopped then.
void draw_py_trees_sequence(NodeBuilder& draw) {
  PyTreesBuilder build(draw);
  const bool has_memory = draw.node().type == NodeType::Sequence;
  draw.edge(build.body(), build.turn(0), negated(build.was_running()),
            build.invalid(build.all_children()));
  if (!has_memory) draw.edge(build.body(), build.turn(0), build.was_running());
  for (std::size_t i = 0; i < draw.child_count(); ++i) {
    if (has_memory) {
      draw.edge(build.body(), build.turn(i),
                both(build.was_running(), build.is_running(i)));
    }
    const auto ends = [&](std::string_view name, LocationId answer) {
      if (has_memory || i + 1 == draw.child_count()) return answer;
      const LocationId stops =
          build.at(std::string(name) + "_" + std::to_string(i + 1));
      build.stop(stops, answer, build.behind(i));
      return stops;
    };
    draw.edge(build.turn(i),
              build.tick(i, {.success = {{build.turn(i + 1)}},
                             .failure = {{ends("fails", build.failure())}},
                             .running = {{ends("runs", build.running())}}}));
  }
  draw.edge(build.at("end"), build.success());
  build.on_stop();
}

// Beginning anew it stops nothing. A child that does not fail ends the tick,
// and all children behind it are stopped unless it is the `previous` one: the
// one that ran, or the first. With memory it goes on with the previous one, and
// those before it are stopped.
void draw_py_trees_selector(NodeBuilder& draw) {
  PyTreesBuilder build(draw);
  const bool has_memory = draw.node().type == NodeType::Fallback;
  const auto count = static_cast<int>(draw.child_count());
  std::optional<VariableId> previous;
  if (count > 1) previous = draw.local("previous", 0, count - 1, 0);
  const std::vector<Assignment> forgets = set_if_there(previous, 0);
  draw.edge(build.body(), build.turn(0), negated(build.was_running()));
  std::vector<std::size_t> before;
  for (std::size_t i = 0; i < draw.child_count(); ++i) {
    draw.edge(
        build.body(), build.turn(has_memory ? i : 0),
        both(build.was_running(), build.is_running(i)),
        joined(set_if_there(previous, static_cast<int>(i)),
               has_memory ? build.invalid(before) : std::vector<Assignment>{}));
    before.push_back(i);
    const auto ends = [&](std::string_view name, LocationId answer) {
      if (i + 1 == draw.child_count()) {
        return std::vector<Reaction>{{answer, forgets}};
      }
      const LocationId stops =
          build.at(std::string(name) + "_" + std::to_string(i + 1));
      build.stop(stops, answer, build.behind(i), forgets);
      const Expression is_previous = equals(*previous, static_cast<int>(i));
      return std::vector<Reaction>{{answer, forgets, is_previous},
                                   {stops, {}, negated(is_previous)}};
    };
    draw.edge(build.turn(i),
              build.tick(i, {.success = ends("succeeds", build.success()),
                             .failure = {{build.turn(i + 1)}},
                             .running = ends("runs", build.running())}));
  }
  draw.edge(build.at("end"), build.failure(), {}, forgets);
  build.on_stop();
}

// What its policy asks for.
Expression is_met(const PyTreesBuilder& build) {
  const Node& node = build.node();
  Expression met;
  for (const std::size_t i : node.selected) {
    met = both(std::move(met), build.has(i, NodeStatus::Success));
  }
  if (!node.option) return met;
  met = build.has(0, NodeStatus::Success);
  for (std::size_t i = 1; i < build.child_count(); ++i) {
    met = either(std::move(met), build.has(i, NodeStatus::Success));
  }
  return met;
}

// Beginning anew it stops all children. All are ticked, those that have
// succeeded only where it is not synchronised; then it decides, and when it
// ends it stops those that run.
void draw_py_trees_parallel(NodeBuilder& draw) {
  PyTreesBuilder build(draw);
  draw.edge(build.body(), build.turn(0), negated(build.was_running()),
            build.invalid(build.all_children()));
  draw.edge(build.body(), build.turn(0), build.was_running());
  Expression fails;
  for (std::size_t i = 0; i < draw.child_count(); ++i) {
    const LocationId next = build.turn(i + 1);
    const LocationId calling = build.tick(
        i, {.success = {{next}}, .failure = {{next}}, .running = {{next}}});
    const Expression has_passed = draw.node().is_synchronised
                                      ? build.has(i, NodeStatus::Success)
                                      : Expression::constant(0);
    if (draw.node().is_synchronised) {
      draw.edge(build.turn(i), next, has_passed, {}, "has succeeded already");
      draw.edge(build.turn(i), calling, negated(has_passed));
    } else {
      draw.edge(build.turn(i), calling);
    }
    const Expression failed = build.has(i, NodeStatus::Failure);
    fails = i == 0 ? failed : either(std::move(fails), failed);
  }
  const Expression met = both(negated(fails), is_met(build));
  const LocationId end = build.at("end");
  const LocationId failing = build.at("fails");
  const LocationId succeeding = build.at("succeeds");
  draw.edge(end, failing, fails);
  draw.edge(end, succeeding, met);
  draw.edge(end, build.running(), both(negated(fails), negated(met)));
  build.halt(failing, build.failure(), build.all_children());
  build.halt(succeeding, build.success(), build.all_children());
  build.on_stop();
}

// Its first child is the condition, asked before every tick. Where that fails,
// a second child that runs is stopped.
void draw_py_trees_guard(NodeBuilder& draw) {
  PyTreesBuilder build(draw);
  const LocationId refused = build.at("refused");
  const LocationId guarded = build.tick(
      1, {.success = {{build.success()}}, .failure = {{build.failure()}}});
  draw.edge(build.body(),
            build.tick(0, {.success = {{guarded}}, .failure = {{refused}}}));
  build.halt(refused, build.failure(), {1});
  build.on_stop();
}

constexpr Drawing kPyTreesCompositeRows[] = {
    {NodeType::Sequence, draw_py_trees_sequence},
    {NodeType::ReactiveSequence, draw_py_trees_sequence},
    {NodeType::Fallback, draw_py_trees_selector},
    {NodeType::ReactiveFallback, draw_py_trees_selector},
    {NodeType::PolicyParallel, draw_py_trees_parallel},
    {NodeType::EternalGuard, draw_py_trees_guard}};

}  // namespace

constinit const Family kPyTreesCompositeDrawings = kPyTreesCompositeRows;

}  // namespace btcheck::mapping
