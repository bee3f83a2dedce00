// SPDX-License-Identifier: MIT
//
// The searches behind the answers of a file: for states, for runs, and those
// for all properties of a kind at once.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "check/search/engine.hpp"
#include "explore/reduce/reduced_network.hpp"
#include "explore/state/proposition.hpp"
#include "ltl/product/fair_system.hpp"
#include "ltl/timed/pattern_search.hpp"

namespace btcheck {

// Takes the run to the first state found that meets a predicate: breadth first,
// to one of the nearest. It is made where it is asked for, so that the runs of
// many predicates need not stand side by side.
using TakeRun = std::function<void(std::size_t predicate,
                                   const std::function<Lasso()>& run)>;

struct StateAnswers {
  ReachabilityResult result;
  std::vector<bool> met;  // by predicate: some state found meets it
};

// With `asked` not empty, only the predicates that it names are asked. The
// system must observe all that is read. `take` may be empty; it is called once
// for each predicate that is met.
StateAnswers search_states(const ReducedNetwork& system,
                           const std::vector<StatePredicate>& predicates,
                           const std::vector<bool>& asked,
                           const SearchChoices& how, const Limits& limits,
                           const TakeRun& take = {});

// A fair run that violates the formula and satisfies every condition; without
// conditions also a finite one that violates it however it goes on. With
// StopReason::FormulaTooLarge nothing was searched.
RunSearch find_run_against(const ReducedNetwork& system,
                           const BoundFormula& formula,
                           const std::vector<FairnessPair>& conditions,
                           const Limits& limits);

// Whether there is one: quicker, as no run is told.
SearchOutcome exists_run_against(const ReducedNetwork& system,
                                 const BoundFormula& formula,
                                 const std::vector<FairnessPair>& conditions,
                                 const Limits& limits);

// A run that violates the pattern, and the longest answer on all of them.
PatternRun find_run_against(const ReducedNetwork& system,
                            const BoundPattern& pattern, const Limits& limits);

// Of a timed property under assumptions: an infinite run that satisfies them.
RunSearch find_run_against(const ReducedNetwork& system,
                           const BoundProperty& assumed,
                           const std::vector<FairnessPair>& conditions,
                           const Limits& limits);

// What is searched for the properties of a file, and what comes of it.
struct FileSearch {
  const CompiledNetwork& system;
  const BoundFile& file;
  Reduction reduction;
  ComponentStore* in_parts;  // null where the whole is searched
  const Limits& limits;
  std::vector<PropertyVerdict>& verdicts;
};

// Sets the verdicts of the Branching properties of a file, all on one stored
// graph. Their runs are the fair ones. A run is told where one path can show
// something.
void verify_branching(const FileSearch& all);

// Names the conditions of each LTL property that holds which could be replaced
// by false where they stand positively, by true where negatively, without
// changing the verdict (Kupferman and Vardi, "Vacuity detection in temporal
// model checking", STTT 2003). At most kMostVacuityChecks for a property.
inline constexpr std::size_t kMostVacuityChecks = 8;
void judge_vacuity(const FileSearch& all);

// One breadth-first search over everything: counts the states with the trigger
// of each property that holds, as many as the reduction leaves. Returns whether
// some run ends in a fault; no search where nothing is to be counted and
// nothing can fail.
bool take_census(const FileSearch& all);

}  // namespace btcheck
