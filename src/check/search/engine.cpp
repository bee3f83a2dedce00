// SPDX-License-Identifier: MIT
//
// A property that asks of single states is a predicate to be met: the first
// state that meets it, in breadth-first order, ends the shortest run there is.
// Assumptions only leave runs out: what all runs satisfy needs no second
// search; where a run was found, one is searched that satisfies the assumptions
// as well.
#include "check/search/engine.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "check/replay/evidence.hpp"
#include "check/replay/replay.hpp"
#include "check/replay/shorten.hpp"
#include "check/search/searched_network.hpp"
#include "check/search/searches.hpp"
#include "explore/search/reachability.hpp"
#include "explore/state/spent.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

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

// What never happens, so that a pattern that holds was never asked.
std::string idle_part(const BoundPattern& bound, const PatternRun& search) {
  const TimedPattern& pattern = bound.pattern;
  if (!search.opens) return bound.text(pattern.opening);
  if (!search.closes && pattern.closing) return bound.text(pattern.closing);
  if (!pattern.trigger || search.triggers > 0) return {};
  std::string part = bound.text(pattern.trigger);
  if (pattern.opening) part += " after " + bound.text(pattern.opening);
  if (pattern.closing) part += " before " + bound.text(pattern.closing);
  return part;
}

class Verifier {
 public:
  Verifier(const CompiledNetwork& system, const BoundFile& file,
           SearchChoices choices, const Limits& limits)
      : system_(system),
        file_(file),
        choices_(choices),
        limits_(limits),
        short_run_limits_(limits),
        verdicts_(file.properties.size()) {
    for (std::size_t i = 0; i < verdicts_.size(); ++i) {
      verdicts_[i].property = file.properties[i].property;
      verdicts_[i].subjects = file.properties[i].subjects;
      verdicts_[i].comparisons = file.properties[i].comparisons;
    }
    short_run_limits_.max_states = std::min(limits.max_states, kShortRunStates);
  }

  Verification run() {
    within_limits([&] { verify_states(); });
    for (std::size_t i = 0; i < verdicts_.size(); ++i) {
      const BoundProperty& bound = file_.properties[i];
      PropertyVerdict& verdict = verdicts_[i];
      if (bound.form == PropertyForm::Timed) {
        within_limits([&] { verify_pattern(bound, verdict); });
      }
      if (bound.form == PropertyForm::Ltl) {
        within_limits([&] { verify_formula(bound, verdict); });
      }
    }
    const FileSearch all{system_,    file_,   choices_.reduction,
                         in_parts(), limits_, verdicts_};
    within_limits([&] { verify_branching(all); });
    within_limits([&] { judge_assumptions(); });
    within_limits([&] { judge_comparisons(); });
    bool has_faults = false;
    if (choices_.tells_more) {
      within_limits([&] { judge_vacuity(all); });
      within_limits([&] { has_faults = take_census(all); });
    }
    note_limits();
    if (!choices_.tells_more) return {std::move(verdicts_), has_faults};
    for (std::size_t i = 0; i < verdicts_.size(); ++i) {
      const auto& run = verdicts_[i].run;
      if (!run) continue;
      verdicts_[i].watched =
          watched_parts(network(), *run, file_.properties[i]);
    }
    return {std::move(verdicts_), has_faults};
  }

 private:
  // Whether a run shows what it was searched for.
  using Shows = std::function<bool(const Run&)>;

  // Does something that takes a search, or as much of it as the limits allow:
  // what is not known by then stays open.
  template <class Work>
  void within_limits(const Work& work) {
    if (limits_.reached({}) != StopReason::None) return;
    try {
      const Stage stage("the rules were checked");
      work();
    } catch (const BudgetSpent& spent) {
      spent_ = stop_reason(spent.spent());
    }
  }

  // Why verdicts that no search has come to are open.
  void note_limits() {
    StopReason reason = limits_.reached({});
    if (reason == StopReason::None) reason = spent_;
    for (PropertyVerdict& verdict : verdicts_) {
      if (verdict.verdict == Verdict::Undecided && verdict.error.empty() &&
          verdict.stopped == StopReason::None) {
        verdict.stopped = reason;
      }
    }
  }

  void verify_states() {
    std::vector<std::size_t> asked;
    std::vector<StatePredicate> predicates;
    for (std::size_t i = 0; i < verdicts_.size(); ++i) {
      if (!asks_of_states(file_.properties[i].form)) continue;
      asked.push_back(i);
      predicates.push_back(sought(file_.properties[i]));
    }
    if (asked.empty()) return;
    // With assumptions a run of its own is searched that satisfies them.
    const bool wants_runs = choices_.keeps_runs && !has_assumptions();
    const auto take_runs = [&](const SearchedNetwork& in) -> TakeRun {
      if (!wants_runs) return {};
      return [&](std::size_t question, const std::function<Lasso()>& run) {
        // Runs of many rules are what fills the memory.
        const bool has_room = limits_.reached({}) != StopReason::Memory;
        if (!has_room || !limits_.may_tell()) return;
        const StatePredicate& predicate = predicates[question];
        show(in, run(), verdicts_[asked[question]], [&](const Run& shown) {
          return ends_with(network(), shown, predicate);
        });
      };
    };
    std::vector<bool> met(asked.size(), false);
    bool is_reduced = false;
    for (const std::vector<bool>& together : together_of(asked.size())) {
      const SearchedNetwork searched(
          system_, observed_alone(network(), those_of(predicates, together)),
          choices_.reduction, in_parts());
      is_reduced = is_reduced || searched.is_reduced();
      const StateAnswers answers =
          search_states(searched.system(), predicates, together, choices_,
                        limits_, take_runs(searched));
      for (std::size_t q = 0; q < asked.size(); ++q) {
        if (!together[q]) continue;
        judge_states(asked[q], answers.result, answers.met[q]);
        met[q] = answers.met[q];
      }
    }
    if (!wants_runs || !is_reduced) return;
    const SearchedNetwork whole(system_);
    search_states(whole.system(), predicates, met, choices_, short_run_limits_,
                  take_runs(whole));
  }

  // Of so many questions, those that are asked in one search. In parts each is
  // by itself: what is seen of all would have to stand at the same time.
  std::vector<std::vector<bool>> together_of(std::size_t count) const {
    if (in_parts() == nullptr) return {std::vector<bool>(count, true)};
    std::vector<std::vector<bool>> each(count, std::vector<bool>(count, false));
    for (std::size_t q = 0; q < count; ++q) each[q][q] = true;
    return each;
  }
  static std::vector<StatePredicate> those_of(
      const std::vector<StatePredicate>& all, const std::vector<bool>& asked) {
    std::vector<StatePredicate> those;
    for (std::size_t q = 0; q < all.size(); ++q) {
      if (asked[q]) those.push_back(all[q]);
    }
    return those;
  }
  // Where what is known of them is kept; null where the whole is searched.
  ComponentStore* in_parts() const {
    return choices_.parts == PartsUse::Always ? choices_.components.get()
                                              : nullptr;
  }

  void judge_states(std::size_t property, const ReachabilityResult& result,
                    bool is_met) {
    PropertyVerdict& verdict = verdicts_[property];
    const BoundProperty& bound = file_.properties[property];
    const bool wants_it = bound.form == PropertyForm::Possible;
    verdict.progress = result.progress;
    if (is_met && has_assumptions()) {
      verify_formula(bound, verdict);
      return;
    }
    if (!is_met) verdict.stopped = result.stopped;
    // Without its run nothing is told of a state.
    const bool is_known =
        is_met ? !choices_.keeps_runs || verdict.run || !verdict.error.empty()
               : result.is_complete;
    if (!is_known) return;
    verdict.verdict = wants_it == is_met ? Verdict::Holds : Verdict::Violated;
  }

  // Searches the network reduced as far as what is observed allows, and shows
  // the run that it finds unless `shows` is empty.
  template <class SearchIn>
  auto answer(const Observed& observed, PropertyVerdict& verdict,
              const Shows& shows, SearchIn&& search_in) const {
    const SearchedNetwork searched(system_, observed, choices_.reduction,
                                   in_parts());
    auto search = search_in(searched.system(), limits_);
    verdict.progress = search.progress;
    verdict.stopped = search.stopped;
    if (search.lasso && shows && choices_.keeps_runs) {
      show(searched, *search.lasso, verdict, shows);
      if (verdict.run && searched.is_reduced()) {
        show_shorter(search_in, verdict, shows);
      }
    }
    verdict.verdict = search.outcome == SearchOutcome::Empty ? Verdict::Holds
                      : search.outcome == SearchOutcome::Found
                          ? Verdict::Violated
                          : Verdict::Undecided;
    return search;
  }

  template <class SearchIn>
  void show_shorter(SearchIn&& search_in, PropertyVerdict& verdict,
                    const Shows& shows) const {
    try {
      const auto other = search_in(system_, short_run_limits_).lasso;
      if (other) show(SearchedNetwork(system_), *other, verdict, shows);
    } catch (const BudgetSpent&) {
      // Then the longer run is told.
    }
  }

  // Among the runs that satisfy the assumptions, if there are any. A `possible`
  // holds where one is found.
  void verify_formula(const BoundProperty& bound, PropertyVerdict& verdict) {
    const RunSearch search = answer(
        observed_by(network(), bound.formula, strong()), verdict,
        [&](const Run& run) {
          return violates(network(), run, bound.formula) &&
                 is_fair(network(), run, strong());
        },
        [&](const ReducedNetwork& system, const Limits& limits) {
          return find_run_against(system, bound.formula, strong(), limits);
        });
    const bool wants_it = bound.form == PropertyForm::Possible;
    if (wants_it && search.outcome != SearchOutcome::GaveUp) {
      verdict.verdict = search.outcome == SearchOutcome::Found
                            ? Verdict::Holds
                            : Verdict::Violated;
    }
    if (!verdict.run || !has_assumptions()) return;
    verdict.shown_at =
        asks_of_states(bound.form)
            ? first_state(network(), *verdict.run, sought(bound))
            : broken_at(network(), *verdict.run, bound.formula, claim(bound));
  }

  // What the formula says without the assumptions in front of it.
  FormulaId claim(const BoundProperty& bound) const {
    const FormulaNode& whole = bound.formula.pool[bound.formula.formula];
    const bool has_front =
        file_.assumptions.has_formula && whole.kind == FormulaKind::Implies;
    return has_front ? whole.right : bound.formula.formula;
  }

  void verify_pattern(const BoundProperty& bound, PropertyVerdict& verdict) {
    const Shows shows = [&](const Run& run) {
      return violated_occurrence(network(), run, bound.timed).has_value() &&
             is_fair(network(), run, strong());
    };
    const PatternRun search =
        answer(observed_by(network(), bound.timed.predicates), verdict,
               has_assumptions() ? Shows() : shows,
               [&](const ReducedNetwork& system, const Limits& limits) {
                 return find_run_against(system, bound.timed, limits);
               });
    if (verdict.verdict == Verdict::Holds) {
      verdict.longest_answer = search.longest_answer;
      verdict.idle = idle_part(bound.timed, search);
      if (bound.timed.pattern.trigger) verdict.triggers = search.triggers;
    }
    if (search.lasso && has_assumptions()) {
      verify_assumed_pattern(bound, shows, verdict);
    }
    if (!verdict.run) return;
    if (has_assumptions()) {
      verdict.shown_at = broken_at(network(), *verdict.run, bound.timed);
    }
    const Run shown = verdict.shown_at ? up_to(*verdict.run, *verdict.shown_at)
                                       : *verdict.run;
    verdict.trigger_state =
        violated_occurrence(network(), shown, bound.timed).value_or(0);
  }

  void verify_assumed_pattern(const BoundProperty& bound, const Shows& shows,
                              PropertyVerdict& verdict) {
    Observed observed = observed_by(network(), bound.formula, strong());
    for (const StatePredicate& each : bound.timed.predicates)
      observed.add(each);
    const RunSearch search =
        answer(observed, verdict, shows,
               [&](const ReducedNetwork& system, const Limits& limits) {
                 return find_run_against(system, bound, strong(), limits);
               });
    if (search.outcome == SearchOutcome::Empty && bound.without &&
        exists_run(*bound.without) == SearchOutcome::Empty) {
      const TimedPattern& pattern = bound.timed.pattern;
      verdict.idle =
          bound.timed.text(pattern.trigger ? pattern.trigger : pattern.opening);
    }
  }

  std::optional<Run> replayed(const SearchedNetwork& searched,
                              const Lasso& found, const Shows& shows,
                              std::string& error) const {
    auto run = searched.replayed(found, error);
    if (!run) return std::nullopt;
    if (!shows(*run)) {
      error = "the run does not show what it should when replayed";
      return std::nullopt;
    }
    return shortened(network(), std::move(*run), shows);
  }

  // The run of a verdict: replayed, found to show what it should, made simpler.
  // One that was found in a reduced network gives way to one that is found
  // without reductions and is no longer.
  void show(const SearchedNetwork& searched, const Lasso& found,
            PropertyVerdict& verdict, const Shows& shows) const {
    auto run = replayed(searched, found, shows, verdict.error);
    const bool is_better =
        run && (!verdict.run || run->steps.size() <= verdict.run->steps.size());
    if (is_better) verdict.run = std::move(run);
  }

  // Whether some fair run violates the formula.
  SearchOutcome exists_run(const BoundFormula& formula) const {
    const SearchedNetwork searched(system_,
                                   observed_by(network(), formula, strong()),
                                   choices_.reduction, in_parts());
    return exists_run_against(searched.system(), formula, strong(), limits_);
  }

  // Drops what is not known in states that no run reaches.
  void judge_comparisons() {
    std::vector<StatePredicate> where;
    for (const PropertyVerdict& verdict : verdicts_) {
      if (verdict.run || verdict.verdict == Verdict::Undecided) continue;
      for (const OpenComparison& comparison : verdict.comparisons) {
        where.push_back({comparison.where, {}});
      }
    }
    if (where.empty()) return;
    std::vector<bool> unreached(where.size(), false);
    for (const std::vector<bool>& together : together_of(where.size())) {
      const SearchedNetwork searched(
          system_, observed_alone(network(), those_of(where, together)),
          choices_.reduction, in_parts());
      const StateAnswers answers =
          search_states(searched.system(), where, together, choices_, limits_);
      for (std::size_t q = 0; q < where.size(); ++q) {
        if (!together[q]) continue;
        unreached[q] = answers.result.is_complete && !answers.met[q];
      }
    }
    const auto is_unreached = [&](const OpenComparison& comparison) -> bool {
      for (std::size_t q = 0; q < where.size(); ++q) {
        if (where[q].expression == comparison.where) return unreached[q];
      }
      return false;
    };
    for (PropertyVerdict& verdict : verdicts_) {
      if (!verdict.run) std::erase_if(verdict.comparisons, is_unreached);
    }
  }

  // What holds because no run is left is told as such.
  void judge_assumptions() {
    const BoundAssumptions& assumptions = file_.assumptions;
    const bool is_in_doubt =
        has_assumptions() &&
        std::ranges::any_of(verdicts_, [](const PropertyVerdict& verdict) {
          return verdict.verdict != Verdict::Undecided && !verdict.run;
        });
    if (!is_in_doubt) return;
    BoundFormula no_run = assumptions.formula;
    no_run.formula = no_run.pool.unary(FormulaKind::Not, no_run.formula);
    if (exists_run(no_run) != SearchOutcome::Empty) return;
    for (PropertyVerdict& verdict : verdicts_) verdict.no_run = true;
  }

  const Network& network() const { return system_.network(); }
  bool has_assumptions() const { return !file_.assumptions.empty(); }
  const std::vector<FairnessPair>& strong() const {
    return file_.assumptions.strong;
  }

  const CompiledNetwork& system_;
  const BoundFile& file_;
  SearchChoices choices_;
  const Limits& limits_;
  Limits short_run_limits_;  // of the search for a shorter run
  StopReason spent_ = StopReason::None;
  std::vector<PropertyVerdict> verdicts_;
};

}  // namespace

namespace {

constexpr std::size_t kFewAutomata = 30;

// A sample tells: how much is left where nothing is looked at.
bool is_large(const CompiledNetwork& system, const Limits& limits) {
  if (system.network().automata.size() < kFewAutomata) return false;
  const SearchedNetwork searched(system, Observed(system.network()),
                                 Reduction::Full);
  Limits few = limits;
  few.max_states = std::min(limits.max_states, kLargeStates);
  ReachabilityVisitor nothing;
  return BreadthFirst(searched.system(), few).run(nothing).stopped ==
         StopReason::MaxStates;
}

}  // namespace

Verification verify(const CompiledNetwork& system, const BoundFile& file,
                    SearchChoices choices, const Limits& limits) {
  if (choices.reduction != Reduction::Full) choices.parts = PartsUse::Never;
  if (choices.parts == PartsUse::WhereLarge && !file.properties.empty()) {
    choices.parts =
        is_large(system, limits) ? PartsUse::Always : PartsUse::Never;
  }
  if (choices.components == nullptr) {
    choices.components = std::make_shared<ComponentStore>();
  }
  return Verifier(system, file, choices, limits).run();
}

std::optional<Run> run_to_fault(const CompiledNetwork& system,
                                SearchChoices choices, const Limits& limits) {
  const Network& network = system.network();
  const std::vector<StatePredicate> is_fault = {
      negated({equals(*network.fault, 0), {}})};
  const SearchedNetwork searched(system, observed_alone(network, is_fault),
                                 choices.reduction);
  choices.order = SearchOrder::BreadthFirst;
  std::optional<Run> run;
  search_states(searched.system(), is_fault, {}, choices, limits,
                [&](std::size_t, const std::function<Lasso()>& found) {
                  std::string error;
                  run = searched.replayed(found(), error);
                });
  return run;
}

}  // namespace btcheck
