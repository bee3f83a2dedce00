// SPDX-License-Identifier: MIT
//
// A node's rstatus is the status that the engine keeps: it is not cleared when
// the node is ticked, because the node, and its parent, look at it.
#include "model/mapping/btcpp/builder.hpp"
#include "model/tree/node_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <utility>

namespace btcheck::mapping {
namespace {

constexpr int value_of(NodeStatus status) { return static_cast<int>(status); }

Expression is_running_status(VariableId status) {
  return either(equals(status, NodeStatus::Running),
                equals(status, NodeStatus::SkippedRunning));
}

}  // namespace

Assignment count(VariableId counter) {
  return {counter, Expression::binary(Operation::Add, read(counter),
                                      Expression::constant(1))};
}

Expression at_least(VariableId variable, int value) {
  return Expression::binary(Operation::GreaterEqual, read(variable),
                            Expression::constant(value));
}

std::vector<Assignment> set_if_there(std::optional<VariableId> variable,
                                     int value) {
  if (!variable) return {};
  return {set(*variable, value)};
}

std::vector<Assignment> joined(std::vector<Assignment> one,
                               const std::vector<Assignment>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

EngineBuilder::EngineBuilder(NodeBuilder& draw, Begins begins)
    : draw_(draw), begins_(begins) {
  for (std::string_view location :
       {"start_", "tick_node", "success", "failure", "running", "skipped",
        "halt", "halted", "done"}) {
    at(location);
  }
  const VariableId caller = draw_.context().caller(draw_.id());
  draw_.edge(at("start_"), at("halt"),
             both(differs(caller, 0), equals(status(), NodeStatus::HaltMe)), {},
             "is asked to halt");
  const auto& fault = node().fault;
  const bool may_be_cut_off = fault && fault->kind == FaultKind::Halted;
  draw_.edge(
      at("start_"), at(may_be_cut_off ? "called" : "tick_node"),
      both(differs(caller, 0), differs(status(), value_of(NodeStatus::HaltMe))),
      {}, "is called");
  body_ = at("tick_node");
  draw_preconditions();
  draw_reading();
  draw_answers();
}

// Repeat, RetryUntilSuccessful, Delay and Timeout read their number in each
// tick; a Sleep where it begins (StatefulActionNode::onStart).
void EngineBuilder::draw_reading() {
  const Context& context = draw_.context();
  const bool is_at_start = node().type == NodeType::Wait;
  const Expression when = is_at_start ? was_idle() : Expression{};
  for (const Script& reading : node().readings) {
    const LocationId read = at("reads");
    draw_.edge(body_, read, both(when, context.over_network(reading.may_hold)));
    draw_.executes(reading.program, ScriptOutcomeKind::Ends);
    throws_where_undecided(body_, reading, when);
    if (is_at_start) draw_.edge(body_, read, negated(was_idle()));
    body_ = read;
  }
}

namespace {

struct Condition {
  ScriptTime time;
  std::string_view location;
  std::string_view where_true;
};
constexpr std::array<Condition, 3> kConditions = {
    {{ScriptTime::FailureIf, "failureIf", "failure"},
     {ScriptTime::SuccessIf, "successIf", "success"},
     {ScriptTime::SkipIf, "skipIf", "skipped"}}};

}  // namespace

// Before tick(): an idle node looks at all four, a running one at _while, and
// one that has ended and was not reset at none.
void EngineBuilder::draw_preconditions() {
  const auto& scripts = node().scripts;
  if (scripts.empty() || scripts.begin()->first > ScriptTime::While) return;
  body_ = at("tick");
  if (is_in(releases::kSkippedStays)) return draw_preconditions_of_each_tick();
  LocationId here = at("conditions");
  draw_.edge(at("tick_node"), here, was_idle());
  const bool has_while = node().script(ScriptTime::While) != nullptr;
  draw_.edge(at("tick_node"), body_,
             both(negated(was_idle()),
                  has_while ? negated(was_running()) : Expression{}));
  if (has_while) {
    draw_.edge(at("tick_node"), at("still"), was_running());
    evaluate(at("still"), *node().script(ScriptTime::While), body_, at("halt"));
  }
  for (const Condition& condition : kConditions) {
    const auto& script = node().script(condition.time);
    if (!script) continue;
    const LocationId next = at(std::string(condition.location) + "_no");
    evaluate(here, *script, at(condition.where_true), next);
    here = next;
  }
  if (has_while) {
    evaluate(here, *node().script(ScriptTime::While), body_, at("skipped"));
  } else {
    draw_.edge(here, body_);
  }
}

// Before 4.3.4 all are executed in each tick; of one that is not idle only
// _while counts.
void EngineBuilder::draw_preconditions_of_each_tick() {
  LocationId here = at("conditions");
  draw_.edge(at("tick_node"), here);
  for (const Condition& condition : kConditions) {
    const auto& script = node().script(condition.time);
    if (!script) continue;
    const std::string name(condition.location);
    const LocationId holds = at(name + "_yes");
    const LocationId next = at(name + "_no");
    evaluate(here, *script, holds, next);
    draw_.edge(holds, at(condition.where_true), was_idle());
    draw_.edge(holds, next, negated(was_idle()));
    here = next;
  }
  const auto& stays = node().script(ScriptTime::While);
  if (!stays) return draw_.edge(here, body_);
  const LocationId leaves = at("while_no");
  evaluate(here, *stays, body_, leaves);
  draw_.edge(leaves, at("halt"), was_running());
  draw_.edge(leaves, at("skipped"), negated(was_running()));
}

// After tick(): postconditions, and the status.
void EngineBuilder::draw_answers() {
  const auto ends = [&](std::string_view location, NodeStatus word,
                        const std::vector<ScriptTime>& times) {
    Afterwards after = run_afterwards(location, times);
    after.updates.push_back(set(status(), word));
    leave(after, at("done"), {},
          "returns " + std::string(kEngineStatusNames[value_of(word)]));
  };
  ends("success", NodeStatus::Success,
       {ScriptTime::OnSuccess, ScriptTime::Post});
  ends("failure", NodeStatus::Failure,
       {ScriptTime::OnFailure, ScriptTime::Post});
  std::vector<ScriptTime> otherwise;
  if (is_in(releases::kPostIsAlways)) otherwise = {ScriptTime::Post};
  ends("running", NodeStatus::Running, otherwise);
  draw_skipped(otherwise);
  draw_halted();
  draw_.edge(at("done"), at("start_"), {},
             {set(draw_.context().caller(draw_.id()), 0)},
             "gives control back");
}

// A status is never SKIPPED, but in older releases: one that ran, or began to,
// runs on, and one that has ended and was not reset has ended.
void EngineBuilder::draw_skipped(const std::vector<ScriptTime>& otherwise) {
  const Afterwards skipped = run_afterwards("skipped", otherwise);
  const auto skips = [&](const Expression& guard, NodeStatus word) {
    Afterwards after = skipped;
    after.updates.push_back(set(status(), word));
    leave(after, at("done"), guard, "returns skipped");
  };
  if (is_in(releases::kSkippedStays)) return skips({}, NodeStatus::Skipped);
  skips(was_running(), NodeStatus::SkippedRunning);
  if (may_stay()) {
    skips(was_idle(), NodeStatus::Skipped);
    skips(both(negated(was_running()), negated(was_idle())),
          NodeStatus::SkippedEnded);
  } else {
    skips(negated(was_running()), NodeStatus::Skipped);
  }
}

// A node that halts itself, its _while having become false, answers SKIPPED.
void EngineBuilder::draw_halted() {
  Afterwards halted = run_afterwards("halted", {ScriptTime::OnHalted});
  const Afterwards itself = halted;
  halted.updates.push_back(set(status(), NodeStatus::NoRetStatus));
  const bool may_halt_itself = node().script(ScriptTime::While) != nullptr;
  leave(halted, at("done"),
        may_halt_itself ? equals(status(), NodeStatus::HaltMe) : Expression{},
        "has been halted");
  if (!may_halt_itself) return;
  const bool runs_on = is_in(releases::kWhileLeavesRunning);
  leave(runs_on ? itself : halted, runs_on ? at("itself") : at("skipped"),
        differs(status(), value_of(NodeStatus::HaltMe)), "halts itself");
  if (runs_on) draw_own_halt(at("itself"));
}

// Its status is RUNNING still, but for a leaf of the program that sets it.
void EngineBuilder::draw_own_halt(LocationId from) {
  const bool is_leaf = child_count() == 0 && node().type != NodeType::Wait;
  const LeafMemory memory = node().contract.memory;
  const std::vector<Assignment> idle = {set(status(), NodeStatus::NoRetStatus)};
  if (is_leaf && memory == LeafMemory::Unknown) {
    draw_.choice(from, at("skipped"), {}, idle, "is idle then");
    draw_.choice(from, at("skipped"), {}, {}, "runs on");
    return;
  }
  const bool is_reset = is_leaf && memory != LeafMemory::Latched;
  draw_.edge(from, at("skipped"), {},
             is_reset ? idle : std::vector<Assignment>{});
}

void EngineBuilder::halt_from_outside(std::string_view location,
                                      LocationId then,
                                      std::vector<Assignment> updates) {
  Afterwards after = run_afterwards(location, {ScriptTime::OnHalted});
  after.updates = joined(std::move(after.updates), updates);
  after.updates.push_back(set(status(), NodeStatus::NoRetStatus));
  leave(after, then, {}, "has been halted");
}

LocationId EngineBuilder::answering(NodeStatus answer) {
  return answer == NodeStatus::Success   ? success()
         : answer == NodeStatus::Running ? running()
         : answer == NodeStatus::Skipped ? at("skipped")
                                         : failure();
}

LocationId EngineBuilder::yielding() {
  const bool is_heard =
      draw_.context().tree.node(draw_.context().tree.roots[0]).wakes;
  if (!is_heard || is_in(releases::kTicksOnce)) {
    return running();
  }
  return once("yield", [&](LocationId location) {
    draw_.edge(location, running(), {}, {set(draw_.context().wake(), 1)},
               "asks to be ticked again");
  });
}

EngineBuilder::Afterwards EngineBuilder::run_afterwards(
    std::string_view location, const std::vector<ScriptTime>& times) {
  Afterwards after{at(location), {}, {}};
  int steps = 0;
  // What is done so far, and where to go on.
  const auto step = [&](Expression guard) {
    const LocationId next =
        at(std::string(location) + "_" + std::to_string(++steps));
    leave(after, next, std::move(guard), {});
    after = {next, {}, {}};
  };
  for (const ScriptTime time : times) {
    const auto& script = node().script(time);
    if (!script) continue;
    if (!is_always(script->may_hold) || script->may_lack || script->may_leave ||
        script->may_throw) {
      if (!after.updates.empty() || !after.programs.empty()) step({});
      throws_where_undecided(after.last, *script, {});
      step(draw_.context().over_network(script->may_hold));
    }
    after.updates = joined(std::move(after.updates),
                           draw_.context().over_network(script->assignments));
    after.programs.push_back(script->program);
  }
  return after;
}

void EngineBuilder::leave(const Afterwards& after, LocationId to,
                          Expression guard, std::string label) {
  draw_.edge(after.last, to, std::move(guard), after.updates, std::move(label));
  for (const std::int32_t program : after.programs) {
    draw_.executes(program, ScriptOutcomeKind::Ends);
  }
}

LocationId EngineBuilder::skipped() {
  if (begins_ == Begins::Silently || is_in(releases::kSkippedStays)) {
    return at("skipped");
  }
  return once("skip", [&](LocationId location) {
    Expression begins;
    if (begins_ == Begins::RunningIfIdle && may_stay()) {
      begins = either(was_idle(), was_running());
      draw_.edge(location, at("skipped"), negated(begins));
    }
    draw_.edge(location, at("skipped"), begins,
               {set(status(), NodeStatus::SkippedRunning)});
  });
}

void EngineBuilder::throws(LocationId from, Expression guard,
                           std::string_view why) {
  draw_.edge(from, at("error"), std::move(guard),
             {set(draw_.context().fault(), 1)}, "throws: " + std::string(why));
}

Expression EngineBuilder::is_idle_status(VariableId status) const {
  Expression idle = equals(status, NodeStatus::NoRetStatus);
  if (is_in(releases::kSkippedStays)) return idle;
  return either(std::move(idle), equals(status, NodeStatus::Skipped));
}

Expression EngineBuilder::was_idle() const { return is_idle_status(status()); }

Expression EngineBuilder::was_running() const {
  return is_running_status(status());
}

Expression EngineBuilder::is_running(std::size_t child) const {
  return may_skip(child) ? is_running_status(status(child))
                         : has(child, NodeStatus::Running);
}

Expression EngineBuilder::is_idle(std::size_t child) const {
  return may_skip(child) ? is_idle_status(status(child))
                         : has(child, NodeStatus::NoRetStatus);
}

Expression EngineBuilder::has(std::size_t child, NodeStatus word) const {
  return equals(status(child), word);
}

bool EngineBuilder::may_skip(std::size_t child) const {
  return draw_.context().answers[index(draw_.child(child))].skipped;
}

bool EngineBuilder::own_may_skip() const {
  return draw_.context().answers[index(draw_.id())].skipped;
}

bool EngineBuilder::every_child_may_skip() const {
  return std::ranges::all_of(all_children(),
                             [&](std::size_t i) { return may_skip(i); });
}

bool EngineBuilder::some_child_may_skip() const {
  return std::ranges::any_of(all_children(),
                             [&](std::size_t i) { return may_skip(i); });
}

bool EngineBuilder::may_stay() const {
  return draw_.context().answers[index(draw_.id())].stays;
}

void EngineBuilder::start_anew(LocationId then,
                               std::vector<Assignment> updates) {
  draw_.edge(body_, then, was_idle(), std::move(updates));
  draw_.edge(body_, then, negated(was_idle()));
}

LocationId EngineBuilder::turn(std::size_t child) {
  return at(child < child_count() ? "turn_" + std::to_string(child + 1)
                                  : "end");
}

Reactions EngineBuilder::passing(const std::vector<Assignment>& when_ended) {
  Reactions reactions{.success = {{success(), when_ended}},
                      .failure = {{failure(), when_ended}},
                      .running = {{running()}}};
  if (may_skip(0)) reactions.skipped = {{skipped()}};
  return reactions;
}

void EngineBuilder::resets_skipped(Reactions& reactions) const {
  for (Reaction& reaction : reactions.skipped) {
    reaction.updates.push_back(set(status(0), NodeStatus::NoRetStatus));
  }
}

LocationId EngineBuilder::tick(std::size_t child, Reactions reactions,
                               std::string_view occasion) {
  const bool is_new = !draw_.calls(child, occasion);
  const LocationId calling = draw_.calling(child, occasion);
  if (!is_new) return calling;
  if (reactions.running.empty()) reactions.running = {{running()}};
  const LocationId waiting = draw_.called(child, occasion);
  draw_.edge(calling, waiting, {}, {set(caller(child), 1)},
             "calls " + unique_name(draw_.context().tree, draw_.child(child)) +
                 std::string(occasion));
  const auto on = [&](const Expression& answer,
                      std::vector<Reaction>& reacting) {
    for (Reaction& reaction : reacting) {
      draw_.edge(waiting, reaction.to,
                 both(both(equals(caller(child), 0), answer),
                      std::move(reaction.guard)),
                 std::move(reaction.updates));
    }
  };
  on(has(child, NodeStatus::Success), reactions.success);
  on(has(child, NodeStatus::Failure), reactions.failure);
  on(has(child, NodeStatus::Running), reactions.running);
  if (may_skip(child)) {
    Expression skipped = either(has(child, NodeStatus::Skipped),
                                has(child, NodeStatus::SkippedRunning));
    if (draw_.context().answers[index(draw_.child(child))].stays) {
      skipped =
          either(std::move(skipped), has(child, NodeStatus::SkippedEnded));
    }
    on(skipped, reactions.skipped);
  }
  return calling;
}

LocationId EngineBuilder::tick_only_child(Reactions reactions,
                                          std::string_view occasion,
                                          std::optional<LocationId> kept) {
  const Assignment idle = set(status(0), NodeStatus::NoRetStatus);
  for (auto* completed : {&reactions.success, &reactions.failure}) {
    for (Reaction& reaction : *completed) {
      if (reaction.to != kept) reaction.updates.push_back(idle);
    }
  }
  return tick(0, std::move(reactions), occasion);
}

void EngineBuilder::halt(LocationId from, LocationId then,
                         const std::vector<std::size_t>& children,
                         std::vector<Assignment> updates, Expression guard) {
  Expression none_runs;
  Expression all_back;
  // One that is skipped while it runs runs on beside the next.
  const bool several_run = draw_.several_children_may_run() ||
                           std::ranges::any_of(children, [&](std::size_t i) {
                             const Answers& answers =
                                 draw_.context().answers[index(draw_.child(i))];
                             return answers.runs && answers.skipped;
                           });
  const LocationId waiting = draw_.waiting_beside(from);
  bool may_halt = false;
  for (std::size_t i : children) {
    if (!draw_.context().answers[index(draw_.child(i))].runs) continue;
    may_halt = true;
    draw_.edge(
        from, waiting,
        both(several_run ? both(guard, none_runs) : guard, is_running(i)),
        {set(status(i), NodeStatus::HaltMe), set(caller(i), 1)},
        "halts " + unique_name(draw_.context().tree, draw_.child(i)));
    none_runs = both(std::move(none_runs), negated(is_running(i)));
    all_back = both(std::move(all_back), equals(caller(i), 0));
  }
  // Drawn once where one location resets under several guards.
  if (may_halt && !draw_.has_edge(waiting, from)) {
    draw_.edge(waiting, from, all_back);
  }
  draw_.edge(from, then, both(guard, none_runs), std::move(updates));
}

void EngineBuilder::reset(LocationId from, LocationId then,
                          const std::vector<std::size_t>& children,
                          std::vector<Assignment> updates, Expression guard) {
  for (std::size_t i : children) {
    updates.push_back(set(status(i), NodeStatus::NoRetStatus));
  }
  halt(from, then, children, std::move(updates), std::move(guard));
}

void EngineBuilder::reset_all(LocationId from, LocationId then,
                              std::vector<Assignment> updates) {
  reset(from, then, all_children(), std::move(updates));
}

LocationId EngineBuilder::resetting(std::string_view name, LocationId then,
                                    std::vector<Assignment> updates) {
  return once(name, [&](LocationId location) {
    reset_all(location, then, std::move(updates));
  });
}

std::vector<std::size_t> EngineBuilder::all_children() const {
  std::vector<std::size_t> all(child_count());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

void EngineBuilder::end(LocationId from, LocationId answer,
                        const std::vector<Assignment>& updates,
                        Expression otherwise, Expression are_all_skipped) {
  reset(from, answer, all_children(), updates, std::move(otherwise));
  reset(from, skipped(), all_children(), updates, std::move(are_all_skipped));
}

void EngineBuilder::on_halt(std::vector<Assignment> updates) {
  reset_all(at("halt"), at("halted"), std::move(updates));
}

void EngineBuilder::choose(LocationId from, const Script& script,
                           LocationId where_true, LocationId where_false,
                           const Expression& guard) {
  const Context& context = draw_.context();
  const auto draw_way = [&](LocationId to, const Expression& where,
                            const char* value, ScriptOutcomeKind outcome) {
    draw_.choice(from, to, both(guard, context.over_network(where)),
                 context.over_network(script.assignments),
                 "`" + script.text + "` is " + value);
    draw_.executes(script.program, outcome);
  };
  draw_way(where_true, script.may_hold, "true", ScriptOutcomeKind::Holds);
  draw_way(where_false, script.may_fail, "false", ScriptOutcomeKind::Fails);
}

void EngineBuilder::evaluate(LocationId from, const Script& script,
                             LocationId where_true, LocationId where_false,
                             Expression guard) {
  choose(from, script, where_true, where_false, guard);
  throws_where_undecided(from, script, std::move(guard));
}

void EngineBuilder::throws_where_undecided(LocationId from,
                                           const Script& script,
                                           Expression guard) {
  const Context& context = draw_.context();
  const auto may_throw = [&](const Expression& where, std::string_view why) {
    draw_.choice(from, at("error"), both(guard, where),
                 {set(context.fault(), 1)},
                 fmt::format("throws: `{}` {}", script.text, why));
    draw_.executes(script.program, ScriptOutcomeKind::Throws);
  };
  // What is told by itself is not told once more.
  Expression untold;
  const auto tell = [&](const std::optional<Expression>& where,
                        std::string_view why) {
    if (!where) return;
    const Expression here = context.over_network(*where);
    may_throw(both(here, untold), why);
    untold = both(std::move(untold), negated(here));
  };
  tell(script.may_lack, "reads an entry that nothing has written yet");
  tell(script.may_leave, "leaves the range of an entry");
  const std::string_view why = "cannot be executed";
  if (script.may_throw) {
    may_throw(both(context.over_network(*script.may_throw), untold), why);
    return;
  }
  if (is_always(script.may_hold) || is_always(script.may_fail)) return;
  throws(from,
         both(both(guard, untold),
              both(negated(context.over_network(script.may_hold)),
                   negated(context.over_network(script.may_fail)))),
         fmt::format("`{}` {}", script.text, why));
  draw_.executes(script.program, ScriptOutcomeKind::Throws);
}

}  // namespace btcheck::mapping
