// SPDX-License-Identifier: MIT
//
// Leaves of XML trees and the root that ticks them (BehaviorTree.CPP 4.10,
// src/action_node.cpp, src/bt_factory.cpp). The world is an adversary: what a
// leaf's contract allows can happen each time it is run. A leaf with a duration
// has a companion timer.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/mapping/btcpp/builder.hpp"

namespace btcheck::mapping {
namespace {

// The answers that a leaf's contract allows: where, and with which effects.
struct Answers {
  Expression required;                // to succeed or run; empty: always
  std::optional<Expression> failing;  // nothing: it cannot fail
  std::vector<Assignment> on_success;
  std::vector<Assignment> on_failure;
  std::vector<Assignment> on_running;  // or skipped, or halted
};

Answers answers_of(NodeBuilder& draw) {
  const LeafContract& contract = draw.node().contract;
  const Context& context = draw.context();
  Answers answers;
  answers.required = context.over_network(contract.requirement);
  if (contract.may_fail) {
    answers.failing = Expression{};
  } else if (!contract.requirement.is_true()) {
    answers.failing = context.over_network(contract.unmet);
  }
  answers.on_success = context.over_network(contract.on_success);
  answers.on_failure = context.over_network(contract.on_failure);
  answers.on_running = context.over_network(contract.on_running);
  return answers;
}

void draw_ends(EngineBuilder& build, LocationId from, const Answers& answers,
               const Expression& guard, const std::vector<Assignment>& also) {
  NodeBuilder& draw = build.draw();
  const LeafContract& contract = draw.node().contract;
  if (contract.may_succeed) {
    draw.edge(from, build.success(), both(guard, answers.required),
              joined(answers.on_success, also));
    draw.executes(contract.requirement_program, ScriptOutcomeKind::Holds);
    draw.executes(contract.success_program, ScriptOutcomeKind::Ends);
  }
  if (answers.failing) {
    draw.edge(from, build.failure(), both(guard, *answers.failing),
              joined(answers.on_failure, also));
    // One that may fail anyhow does so whatever it requires.
    if (!contract.may_fail) {
      draw.executes(contract.requirement_program, ScriptOutcomeKind::Fails);
    }
    draw.executes(contract.failure_program, ScriptOutcomeKind::Ends);
  }
}

void draw_runs(EngineBuilder& build, LocationId from, const Answers& answers,
               const Expression& guard) {
  NodeBuilder& draw = build.draw();
  const LeafContract& contract = draw.node().contract;
  draw.edge(from, build.running(), both(guard, answers.required),
            answers.on_running);
  draw.executes(contract.requirement_program, ScriptOutcomeKind::Holds);
  draw.executes(contract.running_program, ScriptOutcomeKind::Ends);
}

void draw_skips(EngineBuilder& build, LocationId from, const Answers& answers,
                const std::vector<Assignment>& also) {
  NodeBuilder& draw = build.draw();
  const LeafContract& contract = draw.node().contract;
  if (!contract.may_skip) return;
  draw.edge(from, build.skipped(), build.was_idle(),
            joined(answers.on_running, also));
  draw.executes(contract.running_program, ScriptOutcomeKind::Ends);
}

void draw_choice(EngineBuilder& build, LocationId from,
                 const Answers& answers) {
  NodeBuilder& draw = build.draw();
  const LeafContract& contract = draw.node().contract;
  draw_ends(build, from, answers, {}, {});
  // A duration of no ticks leaves none on which to answer running.
  if (contract.may_run && !draw.node().duration) {
    draw_runs(build, from, answers, {});
  }
  draw_skips(build, from, answers, {});
}

// An action with a duration: it answers running until the timer is due, and
// fails before that where its requirement may not hold.
void draw_course(EngineBuilder& build, LocationId from, const Timer& timer,
                 const Answers& answers) {
  NodeBuilder& draw = build.draw();
  const LeafContract& contract = draw.node().contract;
  const Assignment stop = timer.stop();
  const LocationId look = build.at("look");
  draw.edge(from, look, timer.is_idle(), {timer.start()}, "starts its timer");
  draw.edge(from, look, differs(timer.location, Timer::kIdle));
  const Expression counting = timer.is_counting();
  draw_runs(build, look, answers, counting);
  if (!answers.required.is_true()) {
    draw.edge(look, build.failure(),
              both(counting, draw.context().over_network(contract.unmet)),
              joined(answers.on_failure, {stop}));
    draw.executes(contract.requirement_program, ScriptOutcomeKind::Fails);
    draw.executes(contract.failure_program, ScriptOutcomeKind::Ends);
  }
  draw_ends(build, look, answers, timer.is_due(), {stop});
  draw_skips(build, look, answers, {stop});
}

}  // namespace

void draw_engine_leaf(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Silently);
  const LeafContract& contract = draw.node().contract;
  const LocationId body = build.body();
  const Answers answers = answers_of(draw);
  std::optional<Timer> timer;
  if (draw.takes_time()) timer = draw.add_timer();
  const auto draw_run = [&](LocationId from) {
    if (timer) {
      draw_course(build, from, *timer, answers);
    } else {
      draw_choice(build, from, answers);
    }
  };
  // An answer of the leaf's memory, with what its contract says it does.
  const auto answer = [&](bool succeeds, const Expression& guard,
                          const std::vector<Assignment>& also,
                          std::string label = {}) {
    draw.edge(body, succeeds ? build.success() : build.failure(), guard,
              joined(succeeds ? answers.on_success : answers.on_failure, also),
              std::move(label));
    draw.executes(
        succeeds ? contract.success_program : contract.failure_program,
        ScriptOutcomeKind::Ends);
  };
  const std::string first_look = "looks for the first time";
  switch (contract.memory) {
    case LeafMemory::None:
      draw_run(body);
      break;
    case LeafMemory::Latched:
    case LeafMemory::Unknown: {
      const VariableId status = build.status();
      const Expression passed = equals(status, NodeStatus::Success);
      const Expression failed = equals(status, NodeStatus::Failure);
      const LocationId run = build.at("run");
      draw.edge(body, build.success(), passed, {}, "has ended already");
      draw.edge(body, build.failure(), failed, {}, "has ended already");
      const bool is_known = contract.memory == LeafMemory::Latched;
      draw.edge(
          body, run,
          is_known ? both(negated(passed), negated(failed)) : Expression{});
      draw_run(run);
      break;
    }
    case LeafMemory::FirstTickFails: {
      const LocationId look = build.at("look");
      answer(false, build.was_idle(), {}, first_look);
      draw.edge(body, look, negated(build.was_idle()));
      draw_choice(build, look, answers);
      break;
    }
    case LeafMemory::FirstTickOfLifeFails:
    case LeafMemory::FirstTickOfLifeSucceeds: {
      const VariableId first = draw.local("first", 0, 1, 1);
      const LocationId look = build.at("look");
      answer(contract.memory == LeafMemory::FirstTickOfLifeSucceeds,
             equals(first, 1), {set(first, 0)}, first_look);
      draw.edge(body, look, equals(first, 0));
      draw_choice(build, look, answers);
      break;
    }
    case LeafMemory::SuccessStays: {
      const VariableId found = draw.local("found", 0, 1, 0);
      answer(true,
             answers.required.is_true()
                 ? Expression{}
                 : either(equals(found, 1), answers.required),
             {set(found, 1)});
      answer(false, equals(found, 0), {});
      break;
    }
  }
  std::vector<Assignment> on_halt = answers.on_running;
  if (timer) on_halt.push_back(timer->stop());
  build.on_halt(on_halt);
  draw.executes(contract.running_program, ScriptOutcomeKind::Ends);
}

// Script, ScriptCondition, SetBlackboard, UnsetBlackboard.
void draw_script(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Silently);
  const Script& script = draw.node().own_scripts.at(0);
  if (draw.node().answers_value) {
    build.evaluate(build.body(), script, build.success(), build.failure());
  } else {
    // It has no effects where it fails, as SetBlackboard with nothing to copy.
    const Context& context = draw.context();
    draw.edge(build.body(), build.success(),
              context.over_network(script.may_hold),
              context.over_network(script.assignments));
    draw.executes(script.program, ScriptOutcomeKind::Ends);
    draw.edge(build.body(), build.failure(),
              context.over_network(script.may_fail));
    draw.executes(script.program, ScriptOutcomeKind::Fails);
    build.throws_where_undecided(build.body(), script, {});
  }
  build.on_halt();
}

// One tickExactlyOnce after another, each one unit of time, while the answer
// is running; then, also after skipped, the tree is idle again and the run
// over, unless it is ticked for ever. With tickOnce, a running tree that has
// asked for it is ticked again within the same unit.
void draw_engine_root(NodeBuilder& draw) {
  const VariableId status = draw.context().status(draw.id());
  const VariableId child = draw.status(0);
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
  if (!draw.context().answers[index(draw.child(0))].skipped) return;
  ends(NodeStatus::Skipped, "skipped", loops);
  ends(NodeStatus::SkippedRunning, "skipped", loops);
}

}  // namespace btcheck::mapping
