// SPDX-License-Identifier: MIT
//
// Leaves: Action, Condition, SetSV, Eval, Wait (paper, sections 3.2, 3.3 and
// 3.8.3, figures 6 and 8). The world is an adversary: whatever a leaf's
// contract allows can happen each time it is ticked. A leaf with a :duration
// has a companion timer; until it is due the leaf answers running.
#include <algorithm>
#include "model/automata/faults.hpp"
#include "model/mapping/paper/drawings.hpp"

namespace btcheck::mapping {
namespace {

// One way a node can end: the guard under which it is possible, and what it
// assigns.
struct Outcome {
  std::string_view location;
  Expression guard;
  std::vector<StateAssignment> effects;
  std::vector<Assignment> also;
};

// The values that all assignments stay within, on their steps, and no division
// by zero, in the order in which the assignments are executed.
Expression stays_in_range(const Context& context,
                          const std::vector<StateAssignment>& effects) {
  Expression inside;
  std::vector<std::pair<StateVariableId, Expression>> assigned;
  for (const StateAssignment& effect : effects) {
    // What an earlier effect assigned is what a later one reads.
    const auto later = [&](const Term& term) {
      for (auto last = assigned.rbegin(); last != assigned.rend(); ++last) {
        if (term.operation == Operation::Variable &&
            static_cast<std::uint32_t>(term.operand) == index(last->first)) {
          return last->second;
        }
      }
      return term.operation == Operation::Status
                 ? Expression::status(term.operand)
                 : Expression::variable(term.operand);
    };
    Expression value = effect.value.replaced(later);
    Expression over = context.over_network(value);
    inside = both(std::move(inside), is_defined(over));
    inside = both(std::move(inside),
                  context.over_network(effect.fits.replaced(later)));
    assigned.emplace_back(effect.variable, std::move(value));
    const StateVariable& variable = context.tree.variable(effect.variable);
    const auto known = over.only(Operation::Constant);
    if (known && *known >= variable.min && *known <= variable.max) continue;
    inside = both(std::move(inside),
                  both(Expression::binary(Operation::GreaterEqual, over,
                                          Expression::constant(variable.min)),
                       Expression::binary(Operation::LessEqual, over,
                                          Expression::constant(variable.max))));
  }
  return inside;
}

// What can go wrong with them.
std::string fault_of(const std::vector<StateAssignment>& effects) {
  const auto divides = [](const StateAssignment& effect) {
    return !effect.value.divisors().empty();
  };
  const auto may_lie_between = [](const StateAssignment& effect) {
    return !effect.fits.is_true();
  };
  const bool has_steps = std::ranges::any_of(effects, may_lie_between);
  if (std::ranges::any_of(effects, divides)) {
    return has_steps ? "divides by zero, leaves a range or its steps"
                     : "divides by zero or leaves a range";
  }
  return has_steps ? "leaves the range of a variable or its steps"
                   : "leaves the range of a variable";
}

// An outcome as edges: one where the effects stay in range, and one to
// `error`, which ends the run, where they do not.
void draw_outcome(NodeBuilder& draw, LocationId from, Outcome outcome) {
  Context& context = draw.context();
  Expression inside = stays_in_range(context, outcome.effects);
  std::vector<Assignment> updates = context.over_network(outcome.effects);
  updates.insert(updates.end(), outcome.also.begin(), outcome.also.end());
  draw.edge(from, draw.at(outcome.location), both(outcome.guard, inside),
            std::move(updates));
  if (inside.is_true()) return;
  draw.edge(from, draw.at("error"), both(outcome.guard, negated(inside)),
            {set(context.fault(), 1)}, fault_of(outcome.effects));
}

// From `from`, the edge to `error` of an expression with a divisor that may be
// zero.
void draw_division_by_zero(NodeBuilder& draw, LocationId from,
                           const Expression& over_network) {
  Expression defined = is_defined(over_network);
  if (defined.is_true()) return;
  draw.edge(from, draw.at("error"), negated(std::move(defined)),
            {set(draw.context().fault(), 1)}, "divides by zero");
}

// Success with all that it does. One whose fault is that it does something else
// does that behind the answer.
Outcome succeeding(NodeBuilder& draw, Expression guard,
                   std::vector<Assignment> also) {
  const LeafContract& contract = draw.node().contract;
  if (!spoils_writes(draw.node())) {
    return {"success", std::move(guard), contract.on_success, std::move(also)};
  }
  also.push_back(set(draw.fault_phase(), static_cast<int>(FaultPhase::There)));
  if (draw.node().fault->kind == FaultKind::WritesNothing) {
    return {"success", std::move(guard), {}, std::move(also)};
  }
  if (!draw.knows("writes")) {
    draw_other_values(draw, draw.at("writes"), draw.at("success"),
                      draw.context().over_network(contract.on_success));
  }
  return {"writes", std::move(guard), {}, std::move(also)};
}

// Success and failure as the contract allows them. Where the requirement is
// false the leaf can only fail; a decision leaves no choice.
void draw_results(NodeBuilder& draw, LocationId from, Expression guard,
                  std::vector<Assignment> also) {
  const LeafContract& contract = draw.node().contract;
  const Expression succeeds = draw.context().over_network(contract.needed());
  if (contract.may_succeed) {
    draw_outcome(draw, from, succeeding(draw, both(guard, succeeds), also));
  }
  const bool fails_freely = contract.may_fail && contract.decision.is_true();
  if (fails_freely || !succeeds.is_true()) {
    Expression fails = fails_freely ? guard : both(guard, negated(succeeds));
    draw_outcome(draw, from,
                 {"failure", std::move(fails), contract.on_failure, also});
  }
}

// What a leaf does whose fault is there; where it goes on as if nothing were
// wrong, if it does.
std::optional<LocationId> draw_fault(NodeBuilder& draw, LocationId asked,
                                     const std::optional<Timer>& timer = {}) {
  const auto& fault = draw.node().fault;
  using enum FaultKind;
  if (!fault || spoils_writes(draw.node())) return asked;
  Expression where;
  std::vector<Assignment> stop;
  if (timer) stop.push_back(timer->stop());
  if (timer && fault->kind == Halted) where = differs(timer->location, 0);
  const Asked then = draw_strike(draw, asked, std::move(where));
  const LocationId struck = *then.struck;
  const LeafContract& contract = draw.node().contract;
  const Expression needed = draw.context().over_network(contract.needed());
  switch (fault->kind) {
    case Fails:
    case FailsOnce:
    case FailsOn:
      draw_outcome(draw, struck, {"failure", {}, contract.on_failure, stop});
      break;
    case Succeeds:
      draw_outcome(draw, struck, {"success", {}, contract.on_success, stop});
      break;
    case NeverEnds:
      draw.edge(struck, draw.at("running"), {}, stop);
      break;
    case EndsLate: {
      const VariableId late = draw.local("late", 0, fault->late, 0);
      draw.edge(struck, draw.at("running"), differs(late, fault->late),
                {{late, Expression::binary(Operation::Add, read(late),
                                           Expression::constant(1))}});
      draw_results(draw, struck, equals(late, fault->late), {set(late, 0)});
      draw.edge(draw.at("halt"), draw.at("halted"), {}, {set(late, 0)});
      break;
    }
    case Inverted:
    case FlipsOnce:
      draw_outcome(draw, struck,
                   {"success", negated(needed), contract.on_success, stop});
      draw_outcome(draw, struck,
                   {"failure", needed, contract.on_failure, stop});
      break;
    case Halted:
      draw.edge(struck, *then.well, {}, stop, "has been halted");
      break;
    case Throws:
      draw.edge(struck, draw.at("error"), {}, {set(draw.context().fault(), 1)},
                "throws an exception");
      break;
    case WritesNothing:
    case WritesOther:
      break;
  }
  return then.well;
}

// Success, failure and running, chosen anew on every tick. Without guards the
// node's unit of time is spent on the choice itself, as in the figures.
void draw_free_choice(NodeBuilder& draw, bool may_run) {
  const LeafContract& contract = draw.node().contract;
  const bool needs_guards =
      !contract.needed().is_true() || !contract.on_success.empty() ||
      !contract.on_failure.empty() || draw.node().fault.has_value();
  if (draw.is_timed() && !needs_guards) {
    LocationId from = draw.at("tick_node");
    Interval unit{1, 1};
    if (contract.may_succeed) draw.timed_edge(from, draw.at("success"), unit);
    if (contract.may_fail) draw.timed_edge(from, draw.at("failure"), unit);
    if (may_run) draw.timed_edge(from, draw.at("running"), unit);
    return;
  }
  const auto well = draw_fault(draw, draw.decide());
  if (!well) return;
  const LocationId from = *well;
  const Expression asked = draw.context().over_network(contract.needed());
  Expression required = draw.context().over_network(contract.requirement);
  Expression defined = is_defined(asked);
  draw_division_by_zero(draw, from, asked);
  draw_results(draw, from, defined, {});
  if (!may_run) return;
  draw.edge(from, draw.at("running"), both(defined, required));
}

// Starts the timer on the first tick, answers running until it is due; where
// the contract's requirement is false it fails at once. `results` draws what
// may happen when the time is up.
template <class Results>
void draw_with_timer(NodeBuilder& draw, Results results) {
  Timer timer = draw.add_timer();
  const auto draw_halt = [&] {
    draw.edge(draw.at("halt"), draw.at("halted"), {}, {timer.stop()});
  };
  const auto from = draw_fault(draw, draw.decide(), timer);
  if (!from) return draw_halt();
  LocationId look = draw.at("look");
  draw.edge(*from, look, timer.is_idle(), {timer.start()}, "starts its timer");
  draw.edge(*from, look, differs(timer.location, Timer::kIdle));
  const LeafContract& contract = draw.node().contract;
  const Expression asked = draw.context().over_network(contract.needed());
  Expression required = draw.context().over_network(contract.requirement);
  Expression defined = is_defined(asked);
  draw_division_by_zero(draw, look, asked);
  Expression counting = both(timer.is_counting(), defined);
  draw.edge(look, draw.at("running"), both(counting, required));
  if (!required.is_true()) {
    draw_outcome(draw, look,
                 {"failure",
                  both(counting, negated(required)),
                  contract.on_failure,
                  {timer.stop()}});
  }
  results(look, both(timer.is_due(), defined),
          std::vector<Assignment>{timer.stop()});
  draw_halt();
}

void draw_action(NodeBuilder& draw) {
  const auto& fault = draw.node().fault;
  const bool is_late = fault && fault->kind == FaultKind::EndsLate;
  const bool never_ends = fault && fault->kind == FaultKind::NeverEnds;
  if (draw.takes_time() && !is_late) {
    draw.frame();
    draw_with_timer(draw, [&](LocationId look, Expression due,
                              std::vector<Assignment> reset) {
      draw_results(draw, look, std::move(due), std::move(reset));
    });
    return;
  }
  // A :duration of no ticks leaves no tick on which to answer running.
  const bool may_run = draw.node().contract.may_run && !draw.node().duration;
  if (may_run || is_late || never_ends) {
    draw.frame();
    if (!is_late) draw.edge(draw.at("halt"), draw.at("halted"));
  } else {
    draw.frame_without_running();
  }
  draw_free_choice(draw, may_run);
}

void draw_condition(NodeBuilder& draw) {
  draw.frame_without_running();
  draw_free_choice(draw, false);
}

void draw_set_state_variable(NodeBuilder& draw) {
  draw.frame_without_running();
  LocationId from = draw.decide();
  const StateVariable& variable =
      draw.context().tree.variable(draw.node().variable);
  VariableId written =
      draw.context().network.state_variable[index(draw.node().variable)];
  if (const auto& fault = draw.node().fault) {
    if (fault->kind == FaultKind::WritesNothing) {
      return draw.edge(
          from, draw.at("success"), {},
          {set(draw.fault_phase(), static_cast<int>(FaultPhase::There))},
          "the fault: " + variable.name + " stays as it is");
    }
    from = *draw_fault(draw, from);
  }
  for (const int next : draw.context().sampled(draw.node().variable)) {
    Expression allowed = equals(written, next);
    int allowing = 1;
    for (auto [present, target] : variable.transitions) {
      if (target != next) continue;
      allowed = either(allowed, equals(written, present));
      ++allowing;
    }
    const bool always =
        !variable.is_enumeration() || allowing > variable.max - variable.min;
    draw.edge(from, draw.at("success"), always ? Expression{} : allowed,
              {set(written, next)},
              variable.name + " := " + variable.value_name(next));
  }
}

void draw_eval(NodeBuilder& draw) {
  draw.frame_without_running();
  const Node& node = draw.node();
  LocationId from = draw.decide();
  if (node.assignment) {
    draw_outcome(draw, from, {"success", {}, {*node.assignment}, {}});
    return;
  }
  Expression value = draw.context().over_network(node.expression);
  Expression defined = is_defined(value);
  draw.edge(from, draw.at("success"), both(defined, value));
  draw.edge(from, draw.at("failure"), both(defined, negated(value)));
  draw_division_by_zero(draw, from, value);
}

void draw_wait(NodeBuilder& draw) {
  if (!draw.takes_time()) {
    draw.frame_without_running();
    draw.edge(draw.decide(), draw.at("success"));
    return;
  }
  draw.frame();
  draw_with_timer(draw, [&](LocationId look, Expression due,
                            std::vector<Assignment> reset) {
    draw.edge(look, draw.at("success"), std::move(due), std::move(reset));
  });
}

constexpr Drawing kLeafRows[] = {{NodeType::Action, draw_action},
                                 {NodeType::Condition, draw_condition},
                                 {NodeType::SetSV, draw_set_state_variable},
                                 {NodeType::Eval, draw_eval},
                                 {NodeType::Wait, draw_wait}};

}  // namespace

constinit const Family kLeafDrawings = kLeafRows;

}  // namespace btcheck::mapping
