// SPDX-License-Identifier: MIT
//
// A property that asks of single states (never, always, possible,
// deadlockfree) is a predicate to be met: the first state that meets it, in
// breadth-first order, ends the shortest run there is. A timed response is
// searched with an observer (ltl/bounded_response.hpp), everything else is
// LTL: the negation becomes a Büchi automaton and a run that it accepts is a
// counterexample (Vardi and Wolper 1986).
#include "check/engine.hpp"

#include <fmt/format.h>

#include "check/replay.hpp"
#include "explore/breadth_first.hpp"
#include "explore/depth_first.hpp"
#include "ltl/accepting_cycle.hpp"
#include "ltl/bounded_response.hpp"
#include "ltl/product.hpp"
#include "ltl/translate.hpp"

namespace btcheck {
namespace {

bool asks_of_states(PropertyForm form) {
  return form != PropertyForm::Ltl && form != PropertyForm::Response;
}

// What a state must satisfy to end the search for it.
StatePredicate sought(const BoundProperty& bound) {
  if (bound.form != PropertyForm::Invariant) return bound.predicate;
  StatePredicate negated = bound.predicate;
  negated.expression =
      Expression::unary(Operation::Not, std::move(negated.expression));
  if (negated.when_dead) {
    negated.when_dead =
        Expression::unary(Operation::Not, std::move(*negated.when_dead));
  }
  return negated;
}

// Notes the first state that meets each predicate.
class StateQuestions : public ReachabilityVisitor {
 public:
  StateQuestions(const CompiledNetwork& system,
                 const std::vector<StatePredicate>& predicates)
      : labels_(system, predicates), first_(predicates.size()) {
    for (std::size_t i = 0; i < predicates.size(); ++i) open_.push_back(i);
  }

  GoOn expanded(StateId id, StateView state, bool is_dead) {
    for (std::size_t i = 0; i < open_.size();) {
      if (!labels_.holds(open_[i], state, is_dead)) {
        ++i;
        continue;
      }
      first_[open_[i]] = id;
      open_[i] = open_.back();
      open_.pop_back();
    }
    return open_.empty() ? GoOn::No : GoOn::Yes;
  }

  const std::optional<StateId>& first(std::size_t i) const { return first_[i]; }

 private:
  LabelledNetwork labels_;
  std::vector<std::size_t> open_;  // not met so far
  std::vector<std::optional<StateId>> first_;
};

// Sets the run of a verdict, or says that it could not be replayed.
void show(const CompiledNetwork& system, const Lasso& found,
          PropertyVerdict& verdict) {
  verdict.run = replay(system, found, verdict.error);
}

void check_shown(PropertyVerdict& verdict, bool shows) {
  if (verdict.error.empty() && !shows) {
    verdict.error = "the run does not show what it should when replayed";
  }
}

// The answers to the state questions that `asked` lists, from one search.
template <class Search>
void answer_states(const CompiledNetwork& system,
                   const std::vector<std::size_t>& asked,
                   const std::vector<StatePredicate>& predicates,
                   Search&& search, std::vector<PropertyVerdict>& verdicts) {
  StateQuestions questions(system, predicates);
  const ReachabilityResult result = search.run(questions);
  for (std::size_t q = 0; q < asked.size(); ++q) {
    PropertyVerdict& verdict = verdicts[asked[q]];
    const bool wants_it = verdict.property->form == PropertyForm::Possible;
    verdict.progress = result.progress;
    if (questions.first(q)) {
      verdict.verdict = wants_it ? Verdict::Holds : Verdict::Violated;
      show(system, {search.path_to(*questions.first(q)), {}, {}}, verdict);
      if (!verdict.run) continue;
      check_shown(verdict,
                  ends_with(system.network(), *verdict.run, predicates[q]));
    } else if (result.is_complete) {
      verdict.verdict = wants_it ? Verdict::Violated : Verdict::Holds;
    } else {
      verdict.stopped = result.stopped;
    }
  }
}

void verify_states(const CompiledNetwork& system,
                   const std::vector<BoundProperty>& properties,
                   SearchOrder order, const Limits& limits,
                   std::vector<PropertyVerdict>& verdicts) {
  std::vector<std::size_t> asked;
  std::vector<StatePredicate> predicates;
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (!asks_of_states(properties[i].form)) continue;
    asked.push_back(i);
    predicates.push_back(sought(properties[i]));
  }
  if (asked.empty()) return;
  if (order == SearchOrder::DepthFirst) {
    answer_states(system, asked, predicates, DepthFirst(system, limits),
                  verdicts);
  } else {
    answer_states(system, asked, predicates, BreadthFirst(system, limits),
                  verdicts);
  }
}

void take_outcome(const RunSearch& search, PropertyVerdict& verdict) {
  verdict.progress = search.progress;
  verdict.stopped = search.stopped;
  if (search.outcome == SearchOutcome::Empty) verdict.verdict = Verdict::Holds;
  if (search.outcome == SearchOutcome::Found) {
    verdict.verdict = Verdict::Violated;
  }
}

void verify_response(const CompiledNetwork& system, const BoundProperty& bound,
                     const Limits& limits, PropertyVerdict& verdict) {
  const Property& property = *bound.property;
  const LabelledNetwork labelled(system, {bound.predicate, bound.answer});
  ResponseSearch search =
      find_late_response(labelled, {1, 2, property.from, property.to}, limits);
  take_outcome(search, verdict);
  verdict.trigger_state = search.trigger_index;
  verdict.longest_answer = search.longest_answer;
  if (!search.lasso) return;
  show(system, *search.lasso, verdict);
  if (!verdict.run) return;
  check_shown(verdict,
              leaves_unanswered(system.network(), *verdict.run, bound.predicate,
                                bound.answer, property.from, property.to,
                                search.trigger_index));
}

void verify_formula(const CompiledNetwork& system, const BoundProperty& bound,
                    const Limits& limits, PropertyVerdict& verdict) {
  FormulaPool pool = bound.formula.pool;
  const auto automaton =
      translate(pool, pool.unary(FormulaKind::Not, bound.formula.formula));
  if (!automaton) {
    verdict.stopped = StopReason::FormulaTooLarge;
    return;
  }
  const LabelledNetwork labelled(system, bound.formula.propositions);
  const Product product(labelled, *automaton,
                        system.has_free_moves() ? Justice::SomeStepsAreNot
                                                : Justice::EveryStepIsProgress);
  const RunSearch search = find_accepting_cycle(product, limits);
  take_outcome(search, verdict);
  if (!search.lasso) return;
  show(system, *search.lasso, verdict);
  if (!verdict.run) return;
  check_shown(verdict,
              violates(system.network(), *verdict.run, bound.formula.pool,
                       bound.formula.formula, bound.formula.propositions));
}

// Binds one property; nothing when it is wrong.
std::optional<BoundProperty> bind_property(
    const PropertyFile& file, const Property& property,
    const std::vector<StatePredicate>& atoms, const Network& network,
    const SourceText& source, std::vector<Diagnostic>& findings) {
  BoundProperty bound{&property, property.form, {}, {}, {}};
  auto refuse = [&](std::string_view code, std::string message,
                    std::string help) -> std::optional<BoundProperty> {
    findings.push_back(source.diagnostic(Severity::Error, code, property.span,
                                         std::move(message), "",
                                         std::move(help)));
    return std::nullopt;
  };
  std::optional<StatePredicate> predicate;
  if (property.form == PropertyForm::DeadlockFree) {
    bound.predicate = {Expression::constant(0), Expression::constant(1)};
    return bound;
  }
  const FormulaNode& whole = file.formulas[property.formula];
  if (property.form == PropertyForm::Ltl && whole.kind == FormulaKind::Always &&
      file.formulas.is_state_formula(whole.left)) {
    bound.form = PropertyForm::Invariant;
    predicate = predicate_of(file.formulas, whole.left, atoms);
  } else if (property.form == PropertyForm::Ltl) {
    auto formula = bind_formula(file.formulas, property.formula, atoms);
    if (formula) {
      bound.formula = std::move(*formula);
      return bound;
    }
  } else {
    predicate = predicate_of(file.formulas, property.formula, atoms);
  }
  if (!predicate) {
    return refuse("BT1109",
                  fmt::format("`{}` is too large to be checked", property.name),
                  "split it into several properties");
  }
  bound.predicate = std::move(*predicate);
  if (property.form != PropertyForm::Response) return bound;
  if (network.ticks == TickSemantics::None) {
    return refuse("BT1108",
                  fmt::format("`{}` speaks of time, but under `none` no time "
                              "passes",
                              property.name),
                  "choose --tick root, leaves or nodes");
  }
  auto answer = predicate_of(file.formulas, property.answer, atoms);
  if (!answer) {
    return refuse("BT1109",
                  fmt::format("`{}` is too large to be checked", property.name),
                  "split it into several properties");
  }
  bound.answer = std::move(*answer);
  return bound;
}

}  // namespace

Result<std::vector<BoundProperty>> bind_properties(
    const BehaviorTree& tree, const Network& network,
    const PropertyFile& properties, const SourceText& source) {
  Result<std::vector<BoundProperty>> result;
  const Binder binder(tree, network, source);
  std::vector<StatePredicate> atoms;
  for (const Atom& atom : properties.atoms) {
    atoms.push_back(
        binder.bind(atom, result.diagnostics).value_or(StatePredicate{}));
  }
  std::vector<BoundProperty> bound;
  for (const Property& property : properties.properties) {
    auto one = bind_property(properties, property, atoms, network, source,
                             result.diagnostics);
    if (one) bound.push_back(std::move(*one));
  }
  if (!has_error(result.diagnostics)) result.value = std::move(bound);
  return result;
}

std::vector<PropertyVerdict> verify(
    const CompiledNetwork& system, const std::vector<BoundProperty>& properties,
    SearchOrder order, const Limits& limits) {
  std::vector<PropertyVerdict> verdicts(properties.size());
  for (std::size_t i = 0; i < properties.size(); ++i) {
    verdicts[i].property = properties[i].property;
  }
  verify_states(system, properties, order, limits, verdicts);
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].form == PropertyForm::Response) {
      verify_response(system, properties[i], limits, verdicts[i]);
    } else if (properties[i].form == PropertyForm::Ltl) {
      verify_formula(system, properties[i], limits, verdicts[i]);
    }
  }
  return verdicts;
}

bool can_fault(const CompiledNetwork& system, const Limits& limits) {
  const std::optional<VariableId> fault = system.network().fault;
  if (!fault) return false;
  const StatePredicate faulty{
      Expression::variable(static_cast<std::int32_t>(index(*fault))), {}};
  StateQuestions questions(system, {faulty});
  BreadthFirst(system, limits).run(questions);
  return questions.first(0).has_value();
}

}  // namespace btcheck
