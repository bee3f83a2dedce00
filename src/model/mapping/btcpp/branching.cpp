// SPDX-License-Identifier: MIT
//
// IfThenElse, WhileDoElse, Switch and TryCatch (BehaviorTree.CPP 4.10,
// src/controls/if_then_else_node.cpp, while_do_else_node.cpp,
// try_catch_node.cpp, include/…/controls/switch_node.h; 3.8.8).
#include <string>
#include <utility>

#include "model/mapping/btcpp/builder.hpp"

namespace btcheck::mapping {
namespace {

// A branch that ends resets all children; the node answers as it did.
Reactions ending(EngineBuilder& build,
                 const std::vector<Assignment>& updates = {}) {
  return {
      .success = {{build.resetting("end_success", build.success(), updates)}},
      .failure = {{build.resetting("end_failure", build.failure(), updates)}}};
}

// The same where the branch may be skipped.
LocationId tick_branch(EngineBuilder& build, std::size_t child,
                       const std::vector<Assignment>& updates = {}) {
  Reactions reactions = ending(build, updates);
  if (build.may_skip(child)) {
    reactions.skipped = {
        {build.resetting("end_skipped", build.skipped(), updates)}};
  }
  return build.tick(child, std::move(reactions));
}

// The condition is asked until it has answered; the branch then runs to its
// end. With two children a condition that fails is not reset: a stateful one
// answers the same for ever.
void draw_if_then_else(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const int count = static_cast<int>(draw.child_count());
  const VariableId next = draw.local("next", 1, count, 1);
  const auto branch = [&](std::size_t child) {
    return tick_branch(build, child, {set(next, 1)});
  };
  Reactions condition;
  const LocationId then = branch(1);
  condition.success = {{then, {set(next, 2)}}};
  if (count == 3) {
    condition.failure = {{branch(2), {set(next, 3)}}};
  } else {
    condition.failure = {{build.failure()}};
  }
  const LocationId confused = build.at("condition_skipped");
  condition.skipped = {{confused}};
  draw.edge(build.body(), build.tick(0, condition), equals(next, 1));
  draw.edge(build.body(), then, equals(next, 2));
  if (count == 3) draw.edge(build.body(), branch(2), equals(next, 3));
  if (build.may_skip(0)) build.throws(confused, {}, "its condition is skipped");
  build.on_halt({set(next, 1)});
}

// The condition is asked on every tick, and the other branch halted when it
// changes.
void draw_while_do_else(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const bool has_else = draw.child_count() == 3;
  const LocationId chosen = build.at("do");
  const LocationId otherwise = build.at("else");
  const LocationId confused = build.at("condition_skipped");
  draw.edge(build.body(), build.tick(0, {.success = {{chosen}},
                                         .failure = {{otherwise}},
                                         .skipped = {{confused}}}));
  if (has_else) {
    build.reset(chosen, tick_branch(build, 1), {2});
    build.reset(otherwise, tick_branch(build, 2), {1});
  } else {
    draw.edge(chosen, tick_branch(build, 1));
    build.reset_all(otherwise, build.failure());
  }
  // It answers IDLE then, which nothing may, but first resets its children.
  if (build.may_skip(0)) {
    const LocationId idle = build.at("answers_idle");
    build.reset_all(confused, idle);
    build.throws(idle, {}, "its condition is skipped");
  }
  build.on_halt();
}

// The cases are compared on every tick; the branch that ran is halted when
// another is chosen.
void draw_switch(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Silently);
  const std::size_t count = draw.child_count();
  // The branch that runs, 0 for none.
  const VariableId active = draw.local("active", 0, static_cast<int>(count), 0);
  const auto branch = [&](std::size_t child) {
    Reactions reactions = ending(build, {set(active, 0)});
    reactions.running = {
        {build.running(), {set(active, static_cast<int>(child) + 1)}}};
    reactions.skipped = {{build.skipped(), {set(active, 0)}}};
    return build.tick(child, reactions);
  };
  // From the choice of a branch: another one that runs is halted first.
  const auto choose = [&](std::size_t child) {
    const LocationId chosen = build.at("choose_" + std::to_string(child + 1));
    for (std::size_t other = 0; other < count; ++other) {
      if (other == child) continue;
      const LocationId leave = build.at("leave_" + std::to_string(other + 1) +
                                        "_for_" + std::to_string(child + 1));
      draw.edge(chosen, leave, equals(active, static_cast<int>(other) + 1));
      build.reset(leave, branch(child), {other});
    }
    draw.edge(
        chosen, branch(child),
        either(equals(active, 0), equals(active, static_cast<int>(child) + 1)));
    return chosen;
  };
  LocationId here = build.body();
  const std::vector<Script>& cases = draw.node().own_scripts;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const LocationId next = build.at("case_" + std::to_string(i + 2));
    build.choose(here, cases[i], choose(i), next);
    here = next;
  }
  draw.edge(here, choose(count - 1));
  build.on_halt({set(active, 0)});
}

// All children but the last as a Sequence; when one fails, the last cleans up
// and the answer is failure. Halted while trying, and asked to, it ticks the
// last child once.
void draw_try_catch(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Running);
  const int tries = static_cast<int>(draw.child_count()) - 1;
  const std::size_t last = draw.child_count() - 1;
  // tries + 1: the last child is cleaning up.
  const VariableId next = draw.local("next", 1, tries + 1, 1);
  bool all_may_skip = true;
  bool some_may_skip = false;
  for (std::size_t i = 0; i < last; ++i) {
    all_may_skip &= build.may_skip(i);
    some_may_skip |= build.may_skip(i);
  }
  // As in a Sequence; tries + 1: more than there are.
  std::optional<VariableId> skipped;
  if (all_may_skip || (some_may_skip && build.may_stay())) {
    skipped = draw.local("skipped", 0, tries + 1, 0);
  }

  LocationId begin = build.body();
  if (skipped) {
    begin = build.at("begin");
    build.start_anew(begin, {set(*skipped, 0), set(next, 1)});
  }
  const LocationId caught =
      build.resetting("caught", build.failure(), {set(next, 1)});
  const LocationId clean = build.tick(
      last,
      {.success = {{caught}}, .failure = {{caught}}, .skipped = {{caught}}});
  const LocationId enter =
      build.resetting("catch", clean, {set(next, tries + 1)});
  for (int i = 1; i <= tries; ++i) {
    const LocationId after =
        i == tries ? build.at("end") : build.turn(static_cast<std::size_t>(i));
    std::vector<Assignment> moves;
    if (i < tries) moves.push_back(set(next, i + 1));
    Reactions reactions{.success = {{after, moves}},
                        .failure = {{enter}},
                        .skipped = {{after, moves}}};
    if (skipped) {
      const Expression is_all = at_least(*skipped, tries + 1);
      reactions.skipped = {
          {after, joined(moves, {count(*skipped)}), negated(is_all)},
          {after, moves, is_all}};
    }
    const std::size_t child = static_cast<std::size_t>(i - 1);
    const LocationId calling = build.tick(child, reactions);
    draw.edge(begin, calling, equals(next, i));
    if (i > 1) draw.edge(build.turn(child), calling);
  }
  draw.edge(begin, clean, equals(next, tries + 1));
  const LocationId end = build.at("end");
  const std::vector<Assignment> fresh =
      joined({set(next, 1)}, set_if_there(skipped, 0));
  if (skipped) {
    build.end(end, build.success(), fresh, differs(*skipped, tries),
              equals(*skipped, tries));
  } else {
    build.reset_all(end, build.success(), fresh);
  }
  if (!draw.node().option) {
    build.on_halt(fresh);
    return;
  }
  // catch_on_halt: the tried children are reset, the last is ticked once and
  // halted if it runs.
  const LocationId over = build.at("halt_all");
  build.reset_all(over, build.at("halted"), fresh);
  Reactions once;
  once.success = once.failure = once.running = once.skipped = {{over}};
  std::vector<std::size_t> tried = build.all_children();
  tried.pop_back();
  const LocationId trying = build.at("halt_tried");
  draw.edge(build.at("halt"), trying, differs(next, tries + 1));
  draw.edge(build.at("halt"), over, equals(next, tries + 1));
  build.reset(trying, build.tick(last, once, "_once"), tried);
}

constexpr Drawing kBranchingRows[] = {
    {NodeType::IfThenElse, draw_if_then_else},
    {NodeType::WhileDoElse, draw_while_do_else},
    {NodeType::Switch, draw_switch},
    {NodeType::TryCatch, draw_try_catch}};

}  // namespace

constinit const Family kBranchingDrawings = kBranchingRows;

}  // namespace btcheck::mapping
