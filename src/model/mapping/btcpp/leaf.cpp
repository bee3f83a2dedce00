// SPDX-License-Identifier: MIT
//
// Leaves of XML trees and the root that ticks them (BehaviorTree.CPP 4.10,
// src/action_node.cpp, src/bt_factory.cpp). The world is an adversary: what a
// leaf's contract allows can happen each time it is run. A leaf with a duration
// has a companion timer.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/automata/faults.hpp"
#include "model/mapping/btcpp/builder.hpp"

namespace btcheck::mapping {
namespace {

// One way in which a leaf answers.
struct Way {
  LocationId to{};
  std::vector<Assignment> effects;
  // Where the effects are none of the values that entries are declared to have.
  Expression leaves = Expression::constant(0);
  std::int32_t program = kNoProgram;
};

// The answers that a leaf's contract allows: where, and with which effects.
struct Answers {
  Expression required;         // to succeed or run; empty: always
  Expression unmet;            // where it may not be so
  Expression decided;          // to succeed; empty: it may fail as well
  Expression decided_against;  // where it may not be so
  Expression has_written;      // to succeed: ports have given values
  Way success;
  Way failure;
  std::vector<Assignment> on_running;  // or skipped, or halted
};

// --- Ports that write declared entries --------------------------------------

// The entry is in one of the states where this is so.
template <class IsSo>
Expression is_where(const Context& context, StateVariableId entry, IsSo is_so) {
  const VariableId held = context.network.state_variable[index(entry)];
  Expression among = Expression::constant(0);
  const auto count = context.tree.variable(entry).states.size();
  for (int state = 0; state < static_cast<int>(count); ++state) {
    if (!is_so(state)) continue;
    among = is_never(among) ? equals(held, state)
                            : either(std::move(among), equals(held, state));
  }
  return among;
}

// Where the entry may be measured to have this value.
Expression may_become(const Context& context, StateVariableId entry, int next) {
  const StateVariable& variable = context.tree.variable(entry);
  if (variable.is_declared_range) return {};
  std::set<int> before = {next};
  for (const auto& [present, target] : variable.transitions) {
    if (target == next) before.insert(present);
  }
  if (before.size() == variable.states.size()) return {};
  return is_where(context, entry,
                  [&](int state) { return before.contains(state); });
}

// From a location to another: the entry gets any value that may follow its
// present one, which it may keep.
void draw_measurement(NodeBuilder& draw, LocationId from, LocationId to,
                      StateVariableId entry) {
  const Context& context = draw.context();
  const StateVariable& variable = context.tree.variable(entry);
  const VariableId held = context.network.state_variable[index(entry)];
  for (const int next : variable.measured) {
    draw.choice(from, to, may_become(context, entry, next), {set(held, next)},
                variable.name + " := " + variable.value_name(next));
    draw.executes(variable.programs[static_cast<std::size_t>(next)],
                  ScriptOutcomeKind::Ends);
  }
  const Expression is_other = is_where(context, entry, [&](int state) {
    return !std::ranges::binary_search(variable.measured, state);
  });
  draw.choice(from, to, is_other, {}, variable.name + " stays as it is");
}

// Where a leaf stands when its ports have written what they write before it
// answers. On success they have written for certain (`has_written`).
LocationId measured(EngineBuilder& build, LocationId from,
                    std::string_view occasion) {
  NodeBuilder& draw = build.draw();
  for (const StateVariableId entry : draw.node().contract.measures) {
    const std::string& name = draw.context().tree.variable(entry).name;
    const LocationId next = build.at(fmt::format("{}_{}", occasion, name));
    draw_measurement(draw, from, next, entry);
    from = next;
  }
  return from;
}

Expression has_written(const NodeBuilder& draw, const Context& context) {
  Expression has_values;
  for (const StateVariableId entry : draw.node().contract.measures) {
    const StateVariable& variable = context.tree.variable(entry);
    has_values =
        both(std::move(has_values), is_where(context, entry, [&](int state) {
               const EntryValue& value =
                   variable.values[static_cast<std::size_t>(state)];
               return value.numbers || value.text || value.is_any_text;
             }));
  }
  return has_values;
}

// --- Answers -----------------------------------------------------------------

Answers answers_of(EngineBuilder& build) {
  const LeafContract& contract = build.node().contract;
  const Context& context = build.draw().context();
  Answers answers;
  answers.required = context.over_network(contract.requirement);
  answers.unmet = context.over_network(contract.unmet);
  answers.decided = context.over_network(contract.decision);
  answers.decided_against = context.over_network(contract.decided_against);
  answers.has_written = has_written(build.draw(), context);
  answers.success = {build.success(), context.over_network(contract.on_success),
                     context.over_network(contract.success_leaves),
                     contract.success_program};
  answers.failure = {build.failure(), context.over_network(contract.on_failure),
                     context.over_network(contract.failure_leaves),
                     contract.failure_program};
  answers.on_running = context.over_network(contract.on_running);
  return answers;
}

// Answers so, after what is asked of entries has come out so; where that is
// more than they are declared to hold, the run ends.
void draw_way(EngineBuilder& build, LocationId from, const Way& way,
              const Expression& guard, const std::vector<Assignment>& also,
              const std::vector<ScriptStep>& asked, std::string label = {}) {
  NodeBuilder& draw = build.draw();
  const auto executes = [&](ScriptOutcomeKind outcome) {
    for (const ScriptStep& step : asked) {
      draw.executes(step.program, step.outcome);
    }
    draw.executes(way.program, outcome);
  };
  const bool may_leave = !is_never(way.leaves);
  draw.edge(from, way.to, may_leave ? both(guard, negated(way.leaves)) : guard,
            joined(way.effects, also), std::move(label));
  executes(ScriptOutcomeKind::Ends);
  if (!may_leave) return;
  build.throws(from, both(guard, way.leaves),
               "what it writes leaves the range of an entry");
  executes(ScriptOutcomeKind::Throws);
}

void draw_ends(EngineBuilder& build, LocationId from, const Answers& answers,
               const Expression& guard, const std::vector<Assignment>& also) {
  const LeafContract& contract = build.node().contract;
  using enum ScriptOutcomeKind;
  const ScriptStep met{contract.requirement_program, Holds};
  const ScriptStep unmet{contract.requirement_program, Fails};
  const ScriptStep decided{contract.decision_program, Holds};
  const ScriptStep decided_against{contract.decision_program, Fails};
  if (contract.may_succeed) {
    draw_way(build, from, answers.success,
             both(both(both(guard, answers.has_written), answers.required),
                  answers.decided),
             also, {met, decided});
  }
  if (contract.may_fail && answers.decided.is_true()) {
    // One that may fail anyhow does so whatever it requires.
    draw_way(build, from, answers.failure, guard, also, {});
    return;
  }
  if (!answers.required.is_true()) {
    draw_way(build, from, answers.failure, both(guard, answers.unmet), also,
             {unmet});
  }
  if (!answers.decided.is_true()) {
    draw_way(build, from, answers.failure,
             both(both(guard, answers.required), answers.decided_against), also,
             {met, decided_against});
  }
}

void draw_runs(EngineBuilder& build, LocationId from, const Answers& answers,
               const Expression& guard) {
  const LeafContract& contract = build.node().contract;
  draw_way(build, from,
           {build.running(), answers.on_running, Expression::constant(0),
            contract.running_program},
           both(guard, answers.required), {},
           {{contract.requirement_program, ScriptOutcomeKind::Holds}});
}

void draw_skips(EngineBuilder& build, LocationId from, const Answers& answers,
                const std::vector<Assignment>& also) {
  const LeafContract& contract = build.node().contract;
  if (!contract.may_skip) return;
  Expression rests = build.was_idle();
  if (build.is_in(releases::kSkippedStays)) {
    rests =
        either(std::move(rests), equals(build.status(), NodeStatus::Skipped));
  }
  draw_way(build, from,
           {build.skipped(), answers.on_running, Expression::constant(0),
            contract.running_program},
           rests, also, {});
}

void draw_choice(EngineBuilder& build, LocationId from,
                 const Answers& answers) {
  const Node& node = build.node();
  draw_ends(build, from, answers, {}, {});
  // A duration of no ticks leaves none on which to answer running.
  if (node.contract.may_run && !node.duration) {
    draw_runs(build, from, answers, {});
  }
  draw_skips(build, from, answers, {});
}

// An action with a duration: it answers running until the timer is due, and
// fails before that where its requirement may not hold.
void draw_course(EngineBuilder& build, LocationId from, const Timer& timer,
                 const Answers& answers) {
  NodeBuilder& draw = build.draw();
  const Assignment stop = timer.stop();
  const LocationId look = build.at("look");
  draw.edge(from, look, timer.is_idle(), {timer.start()}, "starts its timer");
  draw.edge(from, look, differs(timer.location, Timer::kIdle));
  const Expression counting = timer.is_counting();
  draw_runs(build, look, answers, counting);
  if (!answers.required.is_true()) {
    draw_way(
        build, look, answers.failure, both(counting, answers.unmet), {stop},
        {{draw.node().contract.requirement_program, ScriptOutcomeKind::Fails}});
  }
  draw_ends(build, look, answers, timer.is_due(), {stop});
  draw_skips(build, look, answers, {stop});
}

// --- Faults ------------------------------------------------------------------

// Between two ticks somebody has halted it, and nobody has told its parent.
void draw_cut_off(EngineBuilder& build, const Answers& answers,
                  const std::vector<Assignment>& stop) {
  NodeBuilder& draw = build.draw();
  const Asked called = draw_strike(
      draw, build.at("called"),
      both(build.was_running(),
           differs(build.status(), static_cast<int>(NodeStatus::HaltMe))));
  draw.edge(*called.well, build.at("tick_node"));
  build.halt_from_outside("struck", *called.well,
                          joined(answers.on_running, stop));
}

// An answer the wrong way round: it succeeds where it would fail.
void draw_inverted(EngineBuilder& build, LocationId from,
                   const Answers& answers) {
  const Expression would_fail =
      answers.required.is_true() ? answers.decided_against
      : answers.decided.is_true()
          ? answers.unmet
          : either(answers.unmet, answers.decided_against);
  draw_way(build, from, answers.success, would_fail, {}, {});
  draw_way(build, from, answers.failure,
           both(answers.required, answers.decided), {}, {});
}

// It runs for so many ticks, and only then may it end.
void draw_late(EngineBuilder& build, LocationId from, const Answers& answers,
               int ticks, std::vector<Assignment>& on_halt) {
  NodeBuilder& draw = build.draw();
  const VariableId late = draw.local("late", 0, ticks, 0);
  const Assignment anew = set(late, 0);
  draw_way(build, from,
           {build.running(), answers.on_running, Expression::constant(0),
            draw.node().contract.running_program},
           differs(late, ticks), {count(late)}, {});
  draw_ends(build, from, answers, equals(late, ticks), {anew});
  on_halt.push_back(anew);
}

// It succeeds as ever, and writes something else, or nothing.
void spoil_writes(EngineBuilder& build, Answers& answers) {
  const VariableId phase = build.draw().fault_phase();
  std::vector<Assignment> effects = std::move(answers.success.effects);
  answers.has_written = {};
  answers.success.effects = {set(phase, static_cast<int>(FaultPhase::There))};
  answers.success.leaves = Expression::constant(0);
  answers.success.program = kNoProgram;
  if (build.node().fault->kind == FaultKind::WritesNothing) return;
  answers.success.to = build.at("writes");
  draw_other_values(build.draw(), answers.success.to, build.success(), effects);
}

// What a leaf does while its fault is there; with what its answers then stop,
// and what else is to be done when it is halted.
void draw_fault(EngineBuilder& build, LocationId struck, const Answers& answers,
                const std::vector<Assignment>& stop,
                std::vector<Assignment>& on_halt) {
  NodeBuilder& draw = build.draw();
  const LeafFault fault = *draw.node().fault;
  switch (fault.kind) {
    case FaultKind::Fails:
    case FaultKind::FailsOnce:
    case FaultKind::FailsOn:
      return draw_way(build, struck, answers.failure, {}, stop, {});
    case FaultKind::Succeeds:
      return draw_way(build, struck, answers.success, {}, stop, {});
    case FaultKind::NeverEnds:
      return draw_way(
          build, struck,
          {build.running(), answers.on_running, Expression::constant(0),
           draw.node().contract.running_program},
          {}, stop, {});
    case FaultKind::EndsLate:
      return draw_late(build, struck, answers, fault.late, on_halt);
    case FaultKind::Inverted:
    case FaultKind::FlipsOnce:
      return draw_inverted(build, struck, answers);
    case FaultKind::Throws:
      return build.throws(struck, {}, "an exception of the leaf");
    case FaultKind::WritesNothing:
    case FaultKind::WritesOther:
    case FaultKind::Halted:
      return;  // spoil_writes, draw_cut_off
  }
}

}  // namespace

void draw_engine_leaf(NodeBuilder& draw) {
  EngineBuilder build(draw, Begins::Silently);
  const LeafContract& contract = draw.node().contract;
  const LocationId body = build.body();
  Answers answers = answers_of(build);
  const bool is_spoilt = spoils_writes(draw.node());
  if (is_spoilt) spoil_writes(build, answers);
  std::optional<Timer> timer;
  const auto& fault = draw.node().fault;
  const bool is_late = fault && fault->kind == FaultKind::EndsLate;
  if (draw.takes_time() && !is_late) timer = draw.add_timer();
  std::vector<Assignment> stop;
  if (timer) stop.push_back(timer->stop());
  std::vector<Assignment> on_halt = joined(answers.on_running, stop);
  const auto draw_run = [&](LocationId from) {
    if (timer) {
      draw_course(build, from, *timer, answers);
    } else {
      draw_choice(build, from, answers);
    }
  };
  // Draws what it does that is asked for an answer, with its fault and without.
  const auto draw_asked = [&](LocationId asked, const auto& draw_well) {
    Asked then = {asked, std::nullopt};
    if (!is_spoilt && (!fault || fault->kind != FaultKind::Halted)) {
      then = draw_strike(draw, asked);
    }
    if (then.struck) draw_fault(build, *then.struck, answers, stop, on_halt);
    if (!then.well) return;
    draw_well(is_spoilt && fault->kind == FaultKind::WritesNothing
                  ? *then.well
                  : measured(build, *then.well, "measures"));
  };
  // An answer of the leaf's memory, with what its contract says it does.
  const auto answer =
      [&](LocationId from, bool succeeds, const Expression& guard,
          const std::vector<Assignment>& also, std::string label = {}) {
        draw_way(build, from, succeeds ? answers.success : answers.failure,
                 succeeds ? both(guard, answers.has_written) : guard, also, {},
                 std::move(label));
      };
  const std::string first_look = "looks for the first time";
  switch (contract.memory) {
    case LeafMemory::None:
      draw_asked(body, draw_run);
      break;
    case LeafMemory::Latched:
    case LeafMemory::Unknown: {
      const VariableId status = build.status();
      const Expression passed = equals(status, NodeStatus::Success);
      const Expression failed = equals(status, NodeStatus::Failure);
      const LocationId looks = build.at("run");
      draw.edge(body, build.success(), passed, {}, "has ended already");
      draw.edge(body, build.failure(), failed, {}, "has ended already");
      Expression kept = either(passed, failed);
      if (build.is_in(releases::kSkippedStays) && build.own_may_skip()) {
        const Expression skipped = equals(status, NodeStatus::Skipped);
        draw.edge(body, build.skipped(), skipped, {}, "was skipped already");
        kept = either(std::move(kept), skipped);
      }
      const bool is_known = contract.memory == LeafMemory::Latched;
      draw.edge(body, looks, is_known ? negated(kept) : Expression{});
      draw_asked(looks, draw_run);
      break;
    }
    case LeafMemory::FirstTickFails:
      draw_asked(body, [&](LocationId from) {
        const LocationId look = build.at("look");
        answer(from, false, build.was_idle(), {}, first_look);
        draw.edge(from, look, negated(build.was_idle()));
        draw_choice(build, look, answers);
      });
      break;
    case LeafMemory::FirstTickOfLifeFails:
    case LeafMemory::FirstTickOfLifeSucceeds:
      draw_asked(body, [&](LocationId from) {
        const VariableId first = draw.local("first", 0, 1, 1);
        const LocationId look = build.at("look");
        answer(from, contract.memory == LeafMemory::FirstTickOfLifeSucceeds,
               equals(first, 1), {set(first, 0)}, first_look);
        draw.edge(from, look, equals(first, 0));
        draw_choice(build, look, answers);
      });
      break;
    case LeafMemory::SuccessStays:
      draw_asked(body, [&](LocationId from) {
        const VariableId found = draw.local("found", 0, 1, 0);
        answer(from, true,
               answers.required.is_true()
                   ? Expression{}
                   : either(equals(found, 1), answers.required),
               {set(found, 1)});
        answer(from, false, equals(found, 0), {});
      });
      break;
  }
  if (fault && fault->kind == FaultKind::Halted) {
    draw_cut_off(build, answers, stop);
  }
  const LocationId halt = measured(build, build.at("halt"), "halts");
  build.reset_all(halt, build.at("halted"), std::move(on_halt));
  draw.executes(contract.running_program, ScriptOutcomeKind::Ends);
}

namespace {

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
  draw.halted_by_caller(start, {set(child, NodeStatus::NoRetStatus)});
  if (!draw.context().answers[index(draw.child(0))].skipped) return;
  ends(NodeStatus::Skipped, "skipped", loops);
  ends(NodeStatus::SkippedRunning, "skipped", loops);
}

constexpr Drawing kEngineLeafRows[] = {
    {NodeType::BehaviorTree, draw_engine_root},
    {NodeType::Action, draw_engine_leaf},
    {NodeType::Condition, draw_engine_leaf},
    {NodeType::Script, draw_script}};

}  // namespace

constinit const Family kEngineLeafDrawings = kEngineLeafRows;

}  // namespace btcheck::mapping
