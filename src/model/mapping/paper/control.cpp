// SPDX-License-Identifier: MIT
//
// Control nodes: sequences and fallbacks, with memory and reactive (paper,
// sections 3.4, 3.5 and 3.8.1, figures 9 and 18; the listing of appendix B),
// parallels (section 3.6, figure 19), and those that Nav2 adds (sections 5.2.1
// and 5.2.2).
#include "model/mapping/paper/drawings.hpp"

namespace btcheck::mapping {
namespace {

// A row of children: after one answer the next child is ticked, the other
// decides. A Fallback is a Sequence with success and failure exchanged.
struct Row {
  NodeStatus goes_on;
  NodeStatus decides;
  std::string_view all_passed;  // the locations that return these two
  std::string_view decided;
};

Row row_of(bool is_fallback) {
  return is_fallback ? Row{NodeStatus::Failure, NodeStatus::Success, "failure",
                           "success"}
                     : Row{NodeStatus::Success, NodeStatus::Failure, "success",
                           "failure"};
}

// The number of a child as drawings count them, from 1.
int number_of(std::size_t child) { return static_cast<int>(child) + 1; }

// Sequence, SequenceWithMemory and Fallback are one automaton; memory is in
// what the local `next_seq` becomes when a child stops the row.
void draw_sequence(NodeBuilder& draw) {
  const bool is_fallback = draw.node().type == NodeType::Fallback;
  const bool remembers = draw.node().type == NodeType::SequenceWithMemory;
  const Row row = row_of(is_fallback);
  const std::size_t count = draw.child_count();

  draw.frame();
  VariableId next = draw.local(is_fallback ? "next_fb" : "next_seq", 1,
                               static_cast<int>(count), 1);
  LocationId all_passed = draw.at(row.all_passed);
  LocationId stopped = draw.at(row.decided);
  LocationId from = draw.decide();
  for (std::size_t i = 0; i < count; ++i) {
    const int number = number_of(i);
    draw.edge(from, draw.call(i), equals(next, number));
    if (i + 1 < count) {
      draw.on_answer(i, row.goes_on, draw.call(i + 1));
    } else {
      draw.on_answer(i, row.goes_on, all_passed, {set(next, 1)});
    }
    draw.on_answer(i, row.decides, stopped,
                   {set(next, remembers ? number : 1)});
    draw.on_answer(i, NodeStatus::Running, draw.at("running"),
                   {set(next, number)});
  }
  draw.on_halt(remembers ? std::vector<Assignment>{}
                         : std::vector{set(next, 1)});
}

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
    VariableId status = draw.status(i);
    VariableId caller = draw.caller(i);
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

// ReactiveSequence and ReactiveFallback: every tick starts at the first child.
// When a child decides, children to its right may still be running from an
// earlier tick: they are halted, or waited for, or, with neither :halt nor
// :wait, left behind.
void draw_reactive(NodeBuilder& draw) {
  const Row row = row_of(draw.node().type == NodeType::ReactiveFallback);
  const std::size_t count = draw.child_count();

  draw.frame();
  LocationId from = draw.decide();
  LocationId all_passed = draw.at(row.all_passed);
  LocationId decided = draw.at(row.decided);
  std::vector<Assignment> on_halt;
  Expression fresh;
  LocationId decision = decided;
  if (draw.node().halt) {
    decision = draw.at("halt_rest");
    draw.halt_children(decision, decided);
  } else if (draw.node().wait) {
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
    draw.on_answer(i, row.goes_on,
                   i + 1 < count ? draw.call(i + 1) : all_passed);
    draw.on_answer(i, row.decides, decision);
    draw.on_answer(i, NodeStatus::Running, draw.at("running"));
  }
  draw.on_halt(std::move(on_halt));
}

Expression count_of(NodeBuilder& draw, NodeStatus status) {
  Expression sum = equals(draw.status(0), status);
  for (std::size_t i = 1; i < draw.child_count(); ++i) {
    sum = Expression::binary(Operation::Add, std::move(sum),
                             equals(draw.status(i), status));
  }
  return sum;
}

Expression at_least(Expression sum, int number) {
  return Expression::binary(Operation::GreaterEqual, std::move(sum),
                            Expression::constant(number));
}

void draw_calls(NodeBuilder& draw, LocationId from, LocationId called,
                VariableId active) {
  std::vector<Assignment> first;
  std::vector<Assignment> again;
  for (std::size_t i = 0; i < draw.child_count(); ++i) {
    VariableId caller = draw.caller(i);
    first.push_back(set(caller, 1));
    again.push_back({caller, equals(draw.status(i), NodeStatus::Running)});
  }
  first.push_back(set(active, 1));
  draw.edge(from, called, equals(active, 0), std::move(first),
            "calls all children");
  draw.edge(from, called, equals(active, 1), std::move(again),
            "calls the children that still run");
}

// What becomes of a decision: `word` is the location that returns it.
void draw_decision(NodeBuilder& draw, LocationId counting, Expression decided,
                   std::string_view word, VariableId active) {
  LocationId result = draw.at(word);
  // When all children must succeed, none runs once they have.
  const bool some_may_run =
      word != "success" ||
      draw.node().threshold != static_cast<int>(draw.child_count());
  if (some_may_run && draw.node().halt) {
    LocationId halting = draw.at("halt_then_" + std::string(word));
    draw.edge(counting, halting, std::move(decided), {set(active, 0)});
    draw.halt_children(halting, result);
    return;
  }
  if (some_may_run && draw.node().wait) {
    draw.edge(counting, draw.at("running"),
              both(decided, draw.some_child_runs()), {},
              "waits for the children that still run");
    decided = both(decided, negated(draw.some_child_runs()));
  }
  draw.edge(counting, result, std::move(decided), {set(active, 0)});
}

// Parallel and ParallelAll: all children that have not finished in this
// activation are called in one step and then run interleaved. When all have
// given control back their answers are counted: at least m successes decide for
// success, more than n - m failures for failure. The answers of finished
// children are kept in their rstatus until the node has decided; the local
// `active` is 1 from the first tick to the decision.
void draw_parallel(NodeBuilder& draw) {
  const int count = static_cast<int>(draw.child_count());
  const int needed = draw.node().threshold;

  draw.frame();
  VariableId active = draw.local("active", 0, 1, 0);
  LocationId called = draw.at("children_done");
  LocationId counting = draw.at("counting");
  draw_calls(draw, draw.decide(), called, active);

  draw.edge(called, counting, draw.all_children_are_back());

  Expression succeeds = at_least(count_of(draw, NodeStatus::Success), needed);
  Expression fails =
      at_least(count_of(draw, NodeStatus::Failure), count - needed + 1);
  draw_decision(draw, counting, succeeds, "success", active);
  draw_decision(draw, counting, fails, "failure", active);
  draw.edge(counting, draw.at("running"),
            both(negated(succeeds), negated(fails)));
  draw.on_halt({set(active, 0)});
}

// Recovery: child 1 is the work, child 2 the recovery. The local `retry` counts
// the recoveries done, `next` is the child to be ticked.
void draw_recovery(NodeBuilder& draw) {
  const int retries = draw.node().repetitions;
  constexpr std::size_t kWork = 0;
  constexpr std::size_t kRecovery = 1;

  draw.frame();
  VariableId retry = draw.rounds("retry", retries);
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

// RoundRobin ticks its children in turn. `next` is the child whose turn it is,
// `failed` how many failed in a row before it.
void draw_round_robin(NodeBuilder& draw) {
  const int count = static_cast<int>(draw.child_count());

  draw.frame();
  VariableId next = draw.local("next", 1, count, 1);
  VariableId failed = draw.local("failed", 0, count - 1, 0);
  LocationId from = draw.decide();
  for (std::size_t child = 0; child < draw.child_count(); ++child) {
    const std::size_t after = (child + 1) % draw.child_count();
    const int following = number_of(after);
    draw.edge(from, draw.call(child), equals(next, number_of(child)));
    draw.on_answer(child, NodeStatus::Success, draw.at("success"),
                   {set(next, following), set(failed, 0)});
    for (int before = 0; before + 1 < count; ++before) {
      draw.on_answer(child, NodeStatus::Failure, draw.call(after),
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

// PipelineSequence: every tick goes from child 1 up to the furthest that has
// been reached; a running child before that one lets the next be ticked.
void draw_pipeline_sequence(NodeBuilder& draw) {
  const std::size_t count = draw.child_count();

  draw.frame();
  VariableId furthest = draw.local("furthest", 1, static_cast<int>(count), 1);
  LocationId failing = draw.at("halt_then_failure");
  LocationId passing = draw.at("halt_then_success");
  draw.halt_children(failing, draw.at("failure"), {set(furthest, 1)});
  draw.halt_children(passing, draw.at("success"), {set(furthest, 1)});
  draw.edge(draw.decide(), draw.call(0));
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_last = i + 1 == count;
    draw.on_answer(i, NodeStatus::Success,
                   is_last ? passing : draw.call(i + 1));
    draw.on_answer(i, NodeStatus::Failure, failing);
    Expression is_furthest =
        Expression::binary(Operation::LessEqual, read(furthest),
                           Expression::constant(number_of(i)));
    draw.on_answer(i, NodeStatus::Running, draw.at("running"),
                   {set(furthest, number_of(i))},
                   is_last ? Expression{} : is_furthest);
    if (is_last) continue;
    draw.on_answer(i, NodeStatus::Running, draw.call(i + 1), {},
                   negated(is_furthest));
  }
  draw.on_halt({set(furthest, 1)});
}

constexpr Drawing kControlRows[] = {
    {NodeType::Sequence, draw_sequence},
    {NodeType::Fallback, draw_sequence},
    {NodeType::SequenceWithMemory, draw_sequence},
    {NodeType::ReactiveSequence, draw_reactive},
    {NodeType::ReactiveFallback, draw_reactive},
    {NodeType::Parallel, draw_parallel},
    {NodeType::ParallelAll, draw_parallel},
    {NodeType::Recovery, draw_recovery},
    {NodeType::RoundRobin, draw_round_robin},
    {NodeType::PipelineSequence, draw_pipeline_sequence}};

}  // namespace

constinit const Family kControlDrawings = kControlRows;

}  // namespace btcheck::mapping
