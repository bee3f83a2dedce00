// SPDX-License-Identifier: MIT
//
// Parallel and ParallelAll (paper, section 3.6, figure 19). All children that
// have not finished in this activation are called in one step and then run
// interleaved. When all have given control back their answers are counted: at
// least m successes decide for success, more than n - m failures for failure.
// The answers of finished children are kept in their rstatus until the node
// has decided; the local `active` is 1 from the first tick to the decision.
#include "model/mapping/paper/drawings.hpp"

namespace btcheck::mapping {
namespace {

Expression count_of(NodeBuilder& draw, NodeStatus status) {
  Expression sum = Expression::constant(0);
  for (std::size_t i = 0; i < draw.child_count(); ++i) {
    Expression one = equals(draw.context().status(draw.child(i)), status);
    sum = i == 0 ? one
                 : Expression::binary(Operation::Add, std::move(sum),
                                      std::move(one));
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
    VariableId caller = draw.context().caller(draw.child(i));
    first.push_back(set(caller, 1));
    again.push_back({caller, equals(draw.context().status(draw.child(i)),
                                    NodeStatus::Running)});
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
  const bool none_runs =
      word == "success" &&
      draw.node().threshold == static_cast<int>(draw.child_count());
  if (none_runs) {
    draw.edge(counting, result, std::move(decided), {set(active, 0)});
  } else if (draw.node().halt) {
    LocationId halting = draw.at("halt_then_" + std::string(word));
    draw.edge(counting, halting, std::move(decided), {set(active, 0)});
    draw.halt_children(halting, result);
  } else if (draw.node().wait) {
    draw.edge(counting, draw.at("running"),
              both(decided, draw.some_child_runs()), {},
              "waits for the children that still run");
    draw.edge(counting, result, both(decided, negated(draw.some_child_runs())),
              {set(active, 0)});
  } else {
    draw.edge(counting, result, std::move(decided), {set(active, 0)});
  }
}

}  // namespace

void draw_parallel(NodeBuilder& draw) {
  const int count = static_cast<int>(draw.child_count());
  const int needed = draw.node().threshold;

  draw.frame();
  VariableId active = draw.local("active", 0, 1, 0);
  LocationId called = draw.at("children_done");
  LocationId counting = draw.at("counting");
  draw_calls(draw, draw.decide(), called, active);

  Expression all_back;
  for (std::size_t i = 0; i < draw.child_count(); ++i) {
    all_back = both(all_back, equals(draw.context().caller(draw.child(i)), 0));
  }
  draw.edge(called, counting, all_back);

  Expression succeeds = at_least(count_of(draw, NodeStatus::Success), needed);
  Expression fails =
      at_least(count_of(draw, NodeStatus::Failure), count - needed + 1);
  draw_decision(draw, counting, succeeds, "success", active);
  draw_decision(draw, counting, fails, "failure", active);
  draw.edge(counting, draw.at("running"),
            both(negated(succeeds), negated(fails)));
  draw.on_halt({set(active, 0)});
}

}  // namespace btcheck::mapping
