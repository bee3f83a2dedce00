// SPDX-License-Identifier: MIT
//
// A property that asks of single states (never, always, possible,
// deadlockfree) is a predicate to be met: the first state that meets it, in
// breadth-first order, ends the shortest run there is. Everything else asks of
// runs (run_search.hpp) or of branching time (branching.hpp). Assumptions can
// only leave runs out: what all runs satisfy needs no second search; where a
// run was found, one is searched that satisfies the assumptions as well.
#include "check/engine.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "check/branching.hpp"
#include "check/evidence.hpp"
#include "check/replay.hpp"
#include "check/run_search.hpp"
#include "check/shorten.hpp"
#include "check/vacuity.hpp"
#include "explore/breadth_first.hpp"
#include "explore/depth_first.hpp"

namespace btcheck {
namespace {

bool asks_of_states(PropertyForm form) {
  return form == PropertyForm::Never || form == PropertyForm::Invariant ||
         form == PropertyForm::Possible || form == PropertyForm::DeadlockFree;
}

StatePredicate negated(const StatePredicate& predicate) {
  const auto negation = [](const Expression& of) {
    return Expression::unary(Operation::Not, of);
  };
  StatePredicate result{negation(predicate.expression), {}};
  if (predicate.when_dead) result.when_dead = negation(*predicate.when_dead);
  return result;
}

// What a state must satisfy to end the search for it.
StatePredicate sought(const BoundProperty& bound) {
  return bound.form == PropertyForm::Invariant ? negated(bound.predicate)
                                               : bound.predicate;
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

class Verifier {
 public:
  Verifier(const CompiledNetwork& system, const BoundFile& file,
           SearchOrder order, const Limits& limits)
      : system_(system),
        file_(file),
        order_(order),
        limits_(limits),
        verdicts_(file.properties.size()) {
    for (std::size_t i = 0; i < verdicts_.size(); ++i) {
      verdicts_[i].property = file.properties[i].property;
      verdicts_[i].subjects = file.properties[i].subjects;
    }
  }

  Verification run();

 private:
  void verify_states();
  template <class Search>
  void answer_states(const std::vector<std::size_t>& asked,
                     const std::vector<StatePredicate>& predicates,
                     Search&& search);
  void verify_formula(const BoundProperty& bound, PropertyVerdict& verdict);
  void verify_pattern(const BoundProperty& bound, PropertyVerdict& verdict);
  void search_assumed_pattern(const BoundProperty& bound,
                              PropertyVerdict& verdict);
  void take(const RunSearch& search, PropertyVerdict& verdict) const;
  void show(const Lasso& found, PropertyVerdict& verdict,
            const std::function<bool(const Run&)>& shows) const;
  void show_occurrence(const Lasso& found, const BoundProperty& bound,
                       PropertyVerdict& verdict) const;
  void judge_assumptions();

  const Network& network() const { return system_.network(); }
  bool has_assumptions() const { return !file_.assumptions.empty(); }
  const std::vector<FairnessPair>& strong() const {
    return file_.assumptions.strong;
  }

  const CompiledNetwork& system_;
  const BoundFile& file_;
  SearchOrder order_;
  const Limits& limits_;
  std::vector<PropertyVerdict> verdicts_;
};

// The run of a verdict: replayed, found to show what it should, made simpler.
void Verifier::show(const Lasso& found, PropertyVerdict& verdict,
                    const std::function<bool(const Run&)>& shows) const {
  verdict.run = replay(system_, found, verdict.error);
  if (!verdict.run) return;
  if (!shows(*verdict.run)) {
    verdict.error = "the run does not show what it should when replayed";
    return;
  }
  verdict.run = shortened(network(), std::move(*verdict.run), shows);
}

// The answers to the state questions that `asked` lists, from one search.
template <class Search>
void Verifier::answer_states(const std::vector<std::size_t>& asked,
                             const std::vector<StatePredicate>& predicates,
                             Search&& search) {
  StateQuestions questions(system_, predicates);
  const ReachabilityResult result = search.run(questions);
  for (std::size_t q = 0; q < asked.size(); ++q) {
    PropertyVerdict& verdict = verdicts_[asked[q]];
    const BoundProperty& bound = file_.properties[asked[q]];
    const bool wants_it = bound.form == PropertyForm::Possible;
    verdict.progress = result.progress;
    if (!questions.first(q)) {
      verdict.stopped = result.stopped;
      if (!result.is_complete) continue;
      verdict.verdict = wants_it ? Verdict::Violated : Verdict::Holds;
    } else if (has_assumptions()) {
      verify_formula(bound, verdict);
    } else {
      verdict.verdict = wants_it ? Verdict::Holds : Verdict::Violated;
      show({search.path_to(*questions.first(q)), {}, {}}, verdict,
           [&](const Run& run) {
             return ends_with(network(), run, predicates[q]);
           });
    }
  }
}

void Verifier::verify_states() {
  std::vector<std::size_t> asked;
  std::vector<StatePredicate> predicates;
  for (std::size_t i = 0; i < verdicts_.size(); ++i) {
    if (!asks_of_states(file_.properties[i].form)) continue;
    asked.push_back(i);
    predicates.push_back(sought(file_.properties[i]));
  }
  if (asked.empty()) return;
  if (order_ == SearchOrder::DepthFirst) {
    answer_states(asked, predicates, DepthFirst(system_, limits_));
  } else {
    answer_states(asked, predicates, BreadthFirst(system_, limits_));
  }
}

void Verifier::take(const RunSearch& search, PropertyVerdict& verdict) const {
  verdict.progress = search.progress;
  verdict.stopped = search.stopped;
  if (search.outcome == SearchOutcome::Empty) verdict.verdict = Verdict::Holds;
  if (search.outcome == SearchOutcome::Found) {
    verdict.verdict = Verdict::Violated;
  }
}

// Among the runs that satisfy the assumptions, if there are any. A `possible`
// holds where one is found.
void Verifier::verify_formula(const BoundProperty& bound,
                              PropertyVerdict& verdict) {
  const BoundFormula& formula =
      bound.assumed ? bound.assumed->formula : bound.formula;
  const RunSearch search =
      find_run_against(system_, formula, strong(), limits_);
  take(search, verdict);
  const bool wants_it = bound.form == PropertyForm::Possible;
  if (wants_it && search.outcome != SearchOutcome::GaveUp) {
    verdict.verdict = search.outcome == SearchOutcome::Found
                          ? Verdict::Holds
                          : Verdict::Violated;
  }
  if (!search.lasso) return;
  show(*search.lasso, verdict, [&](const Run& run) {
    return violates(network(), run, formula) &&
           is_fair(network(), run, strong());
  });
  if (verdict.run && asks_of_states(bound.form)) {
    verdict.shown_at = first_state(network(), *verdict.run, sought(bound));
  }
}

// What never happens, so that a pattern that holds was never asked.
std::string idle_part(const BoundPattern& bound, const PatternRun& search) {
  if (!search.opens) return bound.opening;
  if (!bound.closing.empty() && !search.closes) return bound.closing;
  if (bound.trigger.empty() || search.triggers > 0) return {};
  std::string part = bound.trigger;
  if (!bound.opening.empty()) part += " after " + bound.opening;
  if (!bound.closing.empty()) part += " before " + bound.closing;
  return part;
}

void Verifier::verify_pattern(const BoundProperty& bound,
                              PropertyVerdict& verdict) {
  const PatternRun search = find_run_against(system_, bound.timed, limits_);
  take(search, verdict);
  if (verdict.verdict == Verdict::Holds) {
    verdict.longest_answer = search.longest_answer;
    verdict.idle = idle_part(bound.timed, search);
    if (!bound.timed.trigger.empty()) verdict.triggers = search.triggers;
  }
  if (!search.lasso) return;
  if (has_assumptions()) return search_assumed_pattern(bound, verdict);
  show_occurrence(*search.lasso, bound, verdict);
}

// The run, fair under the conditions in force, and what on it is violated.
void Verifier::show_occurrence(const Lasso& found, const BoundProperty& bound,
                               PropertyVerdict& verdict) const {
  show(found, verdict, [&](const Run& run) {
    return violated_occurrence(network(), run, bound.timed).has_value() &&
           is_fair(network(), run, strong());
  });
  if (!verdict.run) return;
  verdict.trigger_state =
      violated_occurrence(network(), *verdict.run, bound.timed).value_or(0);
}

void Verifier::search_assumed_pattern(const BoundProperty& bound,
                                      PropertyVerdict& verdict) {
  verdict.verdict = Verdict::Undecided;
  const RunSearch search =
      find_run_against(system_, bound.timed, *bound.assumed, strong(), limits_);
  take(search, verdict);
  const auto& without = bound.assumed->without;
  if (search.outcome == SearchOutcome::Empty && without &&
      exists_run_against(system_, *without, strong(), limits_) ==
          SearchOutcome::Empty) {
    verdict.idle =
        bound.timed.trigger.empty() ? bound.timed.opening : bound.timed.trigger;
  }
  if (search.lasso) show_occurrence(*search.lasso, bound, verdict);
}

// What holds because no run is left is told as such.
void Verifier::judge_assumptions() {
  const BoundAssumptions& assumptions = file_.assumptions;
  const bool is_in_doubt =
      has_assumptions() &&
      std::any_of(verdicts_.begin(), verdicts_.end(),
                  [](const PropertyVerdict& verdict) {
                    return verdict.verdict != Verdict::Undecided &&
                           !verdict.run;
                  });
  if (!is_in_doubt) return;
  BoundFormula no_run = assumptions.formula;
  no_run.formula = no_run.pool.unary(FormulaKind::Not, no_run.formula);
  if (exists_run_against(system_, no_run, strong(), limits_) !=
      SearchOutcome::Empty) {
    return;
  }
  for (PropertyVerdict& verdict : verdicts_) verdict.no_run = true;
}

Verification Verifier::run() {
  verify_states();
  for (std::size_t i = 0; i < verdicts_.size(); ++i) {
    const BoundProperty& bound = file_.properties[i];
    if (bound.form == PropertyForm::Timed) verify_pattern(bound, verdicts_[i]);
    if (bound.form == PropertyForm::Ltl) verify_formula(bound, verdicts_[i]);
  }
  verify_branching(system_, file_, limits_, verdicts_);
  judge_assumptions();
  judge_vacuity(system_, file_, limits_, verdicts_);
  const bool has_faults = take_census(system_, file_, limits_, verdicts_);
  return {std::move(verdicts_), has_faults};
}

}  // namespace

Verification verify(const CompiledNetwork& system, const BoundFile& file,
                    SearchOrder order, const Limits& limits) {
  return Verifier(system, file, order, limits).run();
}

}  // namespace btcheck
