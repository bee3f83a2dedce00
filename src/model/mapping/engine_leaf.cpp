// SPDX-License-Identifier: MIT
//
// Leaves of XML trees and the root that ticks them (BehaviorTree.CPP 4.10,
// src/action_node.cpp, src/bt_factory.cpp). The world is an adversary: what a
// leaf's contract allows can happen each time it is run.
#include "model/mapping/engine_builder.hpp"

namespace btcheck::mapping {
namespace {

void draw_choice(EngineBuilder& build, LocationId from) {
  NodeBuilder& draw = build.draw();
  const LeafContract& contract = draw.node().contract;
  if (contract.may_succeed) draw.edge(from, build.success());
  if (contract.may_fail) draw.edge(from, build.failure());
  if (contract.may_run) draw.edge(from, build.running());
  if (contract.may_skip) draw.edge(from, build.skipped(), build.was_idle());
}

}  // namespace

void draw_engine_leaf(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Silently);
  const VariableId status = draw.context().status(draw.id());
  const LocationId body = build.body();
  switch (draw.node().contract.memory) {
    case LeafMemory::None:
      draw_choice(build, body);
      break;
    case LeafMemory::Latched:
    case LeafMemory::Unknown: {
      const Expression passed = equals(status, NodeStatus::Success);
      const Expression failed = equals(status, NodeStatus::Failure);
      const LocationId run = build.at("run");
      draw.edge(body, build.success(), passed, {}, "has ended already");
      draw.edge(body, build.failure(), failed, {}, "has ended already");
      const bool is_known = draw.node().contract.memory == LeafMemory::Latched;
      draw.edge(
          body, run,
          is_known ? both(negated(passed), negated(failed)) : Expression{});
      draw_choice(build, run);
      break;
    }
    case LeafMemory::FirstTickFails: {
      const LocationId look = build.at("look");
      draw.edge(body, build.failure(), build.was_idle(), {},
                "looks for the first time");
      draw.edge(body, look, negated(build.was_idle()));
      draw_choice(build, look);
      break;
    }
    case LeafMemory::FirstTickOfLifeFails:
    case LeafMemory::FirstTickOfLifeSucceeds: {
      const VariableId first = draw.local("first", 0, 1, 1);
      const LocationId look = build.at("look");
      const bool fails =
          draw.node().contract.memory == LeafMemory::FirstTickOfLifeFails;
      draw.edge(body, fails ? build.failure() : build.success(),
                equals(first, 1), {set(first, 0)}, "looks for the first time");
      draw.edge(body, look, equals(first, 0));
      draw_choice(build, look);
      break;
    }
    case LeafMemory::SuccessStays: {
      const VariableId found = draw.local("found", 0, 1, 0);
      draw.edge(body, build.success(), {}, {set(found, 1)});
      draw.edge(body, build.failure(), equals(found, 0));
      break;
    }
  }
  build.on_halt();
}

// Script, ScriptCondition, SetBlackboard, UnsetBlackboard.
void draw_script(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Silently);
  const Script& script = draw.node().own_scripts.at(0);
  if (draw.node().answers_value) {
    build.evaluate(build.body(), script, build.success(), build.failure());
  } else {
    // Without its effects where it fails: a SetBlackboard of nothing.
    const Context& context = draw.context();
    draw.edge(build.body(), build.success(),
              context.over_network(script.may_hold), build.assignments(script));
    draw.edge(build.body(), build.failure(),
              context.over_network(script.may_fail));
    build.throws_where_undecided(build.body(), script, {});
  }
  build.on_halt();
}

// One tickExactlyOnce after another, each one unit of time, while the answer
// is running; then the tree is idle again and the run over, unless it is
// ticked for ever. An answer of skipped ends it as well. By tickOnce, a tree
// that runs and has been asked to is ticked again within the same unit.
void draw_engine_root(NodeBuilder& draw) {
  const VariableId status = draw.context().status(draw.id());
  const VariableId child = draw.context().status(draw.child(0));
  const LocationId start = draw.at("start_");
  const LocationId tick = draw.at("tick_node");
  draw.edge(start, tick, {}, {set(status, NodeStatus::NoRetStatus)});
  draw.timed_edge(tick, draw.call(0), {1, 1}, "tick");
  const auto ends = [&](NodeStatus answer, std::string_view location,
                        bool again, Expression guard = {}) {
    std::vector<Assignment> updates = {set(status, answer)};
    if (answer != NodeStatus::Running && answer != NodeStatus::Skipped &&
        answer != NodeStatus::SkippedRunning) {
      updates.push_back(set(child, NodeStatus::NoRetStatus));
    }
    draw.on_answer(0, answer, draw.at(location), std::move(updates),
                   std::move(guard));
    if (again && !draw.has_edge(draw.at(location), start)) {
      draw.edge(draw.at(location), start);
    }
  };
  const bool loops = draw.node().loop;
  Context& context = draw.context();
  if (context.wake_up) {
    const VariableId wake = *context.wake_up;
    draw.own(wake);
    draw.on_answer(0, NodeStatus::Running, draw.call(0), {set(wake, 0)},
                   equals(wake, 1));
    ends(NodeStatus::Running, "running", true, equals(wake, 0));
  } else {
    ends(NodeStatus::Running, "running", true);
  }
  ends(NodeStatus::Success, "success", loops);
  ends(NodeStatus::Failure, "failure", loops);
  if (!draw.context().may_skip[index(draw.child(0))]) return;
  ends(NodeStatus::Skipped, "skipped", loops);
  ends(NodeStatus::SkippedRunning, "skipped", loops);
}

}  // namespace btcheck::mapping
