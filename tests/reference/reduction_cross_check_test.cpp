// SPDX-License-Identifier: MIT
//
// The reductions against all states written out, on random trees under every
// tick semantics and with random questions.
//
// Forgetting dead values must leave a bisimilar network, ample sets the same
// edges, dead states, answers and earliest times of these; every run of a
// reduction, told in single steps, must be one of the network. So that the
// comparison can be trusted, three reductions that are wrong on purpose must
// not pass it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>

#include "check/search/searched_network.hpp"
#include "reference/effort.hpp"
#include "reference/reduced_space.hpp"
#include "reference/reduction_cases.hpp"

namespace btcheck::reference::reduction_cross_check_test {
namespace {

constexpr int kQuestionsOfNetwork = 4;

using Case = ReductionCase;

struct Census : ReductionCensus {
  int sees_death = 0;
  int runs = 0;
  int grown = 0;              // more states than before, of live variables only
  std::uint64_t reduced = 0;  // states
};

// Random questions, the same for the same case and round.
Questions questions_of(const Case& each, int round) {
  SplitMix64 random(each.seed * 8 + static_cast<std::uint64_t>(round));
  return random_questions(each.network, random);
}

// The names of what is asked, for a report.
std::string shown(const Network& network, const Questions& questions) {
  std::string text;
  for (const StatePredicate& each : questions.predicates) {
    text += "\n  " + expression_text(network, each.expression);
    if (!each.when_dead) continue;
    text += "; when dead " + expression_text(network, *each.when_dead);
  }
  for (const VariableId each : questions.whole) {
    text += "\n  " + qualified_name(network, each);
  }
  return text;
}

// What goes wrong with one question on one network, "" for nothing.
using Flaw = std::function<std::string(const Case&, const Questions&, Census&)>;

std::string flaw_of_all(const Case& each, Census& census, const Flaw& flaw) {
  for (int round = 0; round < kQuestionsOfNetwork; ++round) {
    const Questions questions = questions_of(each, round);
    census.sees_death += questions.see_death();
    const std::string wrong = flaw(each, questions, census);
    if (!wrong.empty()) return wrong + shown(each.network, questions);
  }
  return {};
}

// The flaw on the smallest tree that has one.
std::string report(const Case& each, const Flaw& flaw) {
  std::string wrong;
  const auto fails = [&](const std::string& text) {
    for (std::uint64_t other = 0; other < 16; ++other) {
      Census census;
      const auto smaller = reduction_case(text, each.ticks, each.seed + other);
      wrong = smaller ? flaw_of_all(*smaller, census, flaw) : "";
      if (!wrong.empty() || !smaller) return smaller.has_value();
    }
    return false;
  };
  // What makes smaller trees knows .btf only.
  const bool is_xml = each.text.starts_with('<');
  const std::string small = is_xml ? each.text : shrink(each.text, fails);
  fails(small);
  return fmt::format("seed {}, tick {}\n{}after shrinking\n{}{}", each.seed,
                     tick_name(each.ticks), each.text, small, wrong);
}

void require_none(unsigned own_seed, int trees, Census& census,
                  const Flaw& flaw) {
  for_reduction_cases(own_seed, trees, [&](const Case& each) {
    census.count(each);
    if (flaw_of_all(each, census, flaw).empty()) return GoOn::Yes;
    FAIL(report(each, flaw));
    return GoOn::No;
  });
}

Findings expected(const Case& each, const Questions& questions) {
  return findings(each.network, questions, each.space, edges_of(each.space));
}

std::string flaw_with(const AmpleSets& ample, const Case& each,
                      const Questions& questions, Census& census) {
  const CompiledNetwork system(each.network);
  const ReducedNetwork network(system, ample);
  const auto reduced = reduced_space(network, kMostStatesOfCase);
  if (!reduced || reduced->vectors.size() > each.space.states.size()) {
    return "more states than without";
  }
  census.reduced += reduced->vectors.size();
  const std::string wrong = difference(
      expected(each, questions),
      findings(each.network, questions, reduced->space, reduced->edges));
  if (!wrong.empty()) return wrong;
  for (const Lasso& run : reduced->runs(4)) {
    ++census.runs;
    const std::string astray = run_flaw(system, in_single_steps(network, run));
    if (!astray.empty()) return astray;
  }
  return {};
}

std::string ample_flaw(const Case& each, const Questions& questions,
                       Census& census) {
  return flaw_with(AmpleSets(each.network, questions.observed(each.network)),
                   each, questions, census);
}

std::string live_flaw(const Case& each, const Questions& questions,
                      Census& census) {
  const LiveNetwork live =
      forget_dead_values(each.network, questions.observed(each.network));
  const Bisimulation walked =
      walk_both(each.network, live, questions, 4 * kMostStatesOfCase);
  if (!walked.flaw.empty()) return walked.flaw;
  if (walked.states != each.space.states.size()) return "not all walked";
  census.grown += walked.live_states > walked.states;
  census.reduced += walked.live_states;
  return {};
}

// Both reductions together, as a search has them.
std::string searched_flaw(const Case& each, const Questions& questions,
                          Census& census) {
  const CompiledNetwork system(each.network);
  const SearchedNetwork searched(system, questions.observed(each.network),
                                 Reduction::Full);
  const auto reduced = reduced_space(searched.system(), kMostStatesOfCase);
  if (!reduced) return "more states than without";
  census.reduced += reduced->vectors.size();
  Findings whole = expected(each, questions);
  Findings found =
      findings(each.network, questions, reduced->space, reduced->edges);
  whole.dead.clear();
  found.dead.clear();
  const std::string wrong = difference(whole, found);
  if (!wrong.empty()) return wrong;
  for (const Lasso& run : reduced->runs(4)) {
    ++census.runs;
    std::string error;
    if (!searched.replayed(run, error)) return error;
  }
  return {};
}

// How many of some cases a reduction that is wrong on purpose fails.
template <class Wrong>
int times_caught(unsigned own_seed, Wrong&& is_wrong) {
  int caught = 0;
  for_reduction_cases(own_seed, by_effort(250, 600), [&](const Case& each) {
    caught += is_wrong(each);
    return caught < 5 ? GoOn::Yes : GoOn::No;
  });
  return caught;
}

// The same network, as it would be if nothing moved by itself: what the free
// variables' automata change is nowhere read. Edges keep their numbers.
Network with_still_variables(Network network) {
  for (Automaton& automaton : network.automata) {
    if (automaton.kind != AutomatonKind::StateVariable) continue;
    network.variables.push_back(network.variable(automaton.location));
    automaton.location =
        VariableId{static_cast<std::uint32_t>(network.variables.size() - 1)};
  }
  return network;
}

}  // namespace

TEST_CASE("a network that forgets dead values is bisimilar to the whole") {
  Census census;
  require_none(81, by_effort(60, 900), census, live_flaw);
  MESSAGE(census.networks << " networks, " << census.states << " states, "
                          << census.reduced / kQuestionsOfNetwork
                          << " without dead values, more of them "
                             "than before in "
                          << census.grown << " cases");
  CHECK_COVERED(census.networks > 100);
  CHECK_COVERED(census.reduced < census.states * kQuestionsOfNetwork * 9 / 10);
  // Where one value is asked for, what stands for all others may be new.
  CHECK_COVERED(census.grown * 50 <= census.networks);
}

TEST_CASE("ample sets keep edges, dead states, answers and their times") {
  Census census;
  require_none(82, by_effort(100, 1500), census, ample_flaw);
  MESSAGE(census.networks << " networks, " << census.states << " states, "
                          << census.reduced / kQuestionsOfNetwork
                          << " with ample sets; " << census.runs << " runs");
  CHECK_COVERED(census.networks > 200);
  CHECK_COVERED(census.reduced < census.states * kQuestionsOfNetwork / 2);
  MESSAGE(census.xml_trees << " of XML, " << census.several_trees
                           << " of several trees, " << census.untimed
                           << " untimed, " << census.free_variables
                           << " with free variables, " << census.contracts
                           << " with contracts, " << census.fixed_timers
                           << " and " << census.ranged_timers
                           << " with fixed and ranged timers, " << census.faults
                           << " with faults");
  CHECK_COVERED(census.xml_trees > 10);
  CHECK_COVERED(census.several_trees > 0);
  CHECK_COVERED(census.untimed > 0);
  CHECK_COVERED(census.free_variables > 0);
  CHECK_COVERED(census.contracts > 0);
  CHECK_COVERED(census.fixed_timers > 0);
  CHECK_COVERED(census.ranged_timers > 0);
  CHECK_COVERED(census.faults > 0);
  CHECK_COVERED(census.sees_death > 0);
}

TEST_CASE("both reductions together find the same and can be replayed") {
  Census census;
  require_none(83, by_effort(60, 900), census, searched_flaw);
  MESSAGE(census.networks << " networks, " << census.states << " states, "
                          << census.reduced / kQuestionsOfNetwork
                          << " with both; " << census.runs << " runs");
  CHECK_COVERED(census.networks > 100);
  CHECK_COVERED(census.reduced < census.states * kQuestionsOfNetwork / 2);
}

// Two trees that each do one thing and end; the first has succeeded and the
// second has not: seen while something can still move, and by `dead` later.
// An invisible step put in front of a visible one may make that one the last.
TEST_CASE("what is seen just before death is kept") {
  const auto each = reduction_case(
      "((BehaviorTree :name t (Action :ID a :SF))"
      " (BehaviorTree :name u (Action :ID b :SF)) (Trees t u))",
      TickSemantics::Root, 0);
  REQUIRE(each);
  Questions questions;
  const Expression succeeded = Expression::binary(
      Operation::Equal,
      Expression::variable(
          static_cast<std::int32_t>(index(each->network.node_status[0]))),
      Expression::constant(static_cast<int>(NodeStatus::Success)));
  questions.predicates.push_back({succeeded, Expression::constant(0)});
  Census census;
  CHECK(ample_flaw(*each, questions, census) == "");
}

TEST_CASE("ample sets that do not know what is asked are caught") {
  CHECK_COVERED(
      times_caught(84, [](const Case& each) {
        Census census;
        const AmpleSets ample(each.network, Observed(each.network));
        return !flaw_with(ample, each, questions_of(each, 0), census).empty();
      }) == 5);
}

// Rare: a variable has to move between two looks at it.
TEST_CASE("ample sets that do not know what moves by itself are caught") {
  CHECK_COVERED(times_caught(85, [](const Case& each) {
                  Census census;
                  const Questions questions = questions_of(each, 0);
                  const Network still = with_still_variables(each.network);
                  const AmpleSets ample(still, questions.observed(still));
                  return !flaw_with(ample, each, questions, census).empty();
                }) > 0);
}

TEST_CASE("forgetting what is asked is caught") {
  CHECK_COVERED(times_caught(86, [](const Case& each) {
                  const Questions questions = questions_of(each, 0);
                  const LiveNetwork live =
                      forget_dead_values(each.network, Observed(each.network));
                  return !walk_both(each.network, live, questions,
                                    kMostStatesOfCase)
                              .flaw.empty();
                }) == 5);
}

}  // namespace btcheck::reference::reduction_cross_check_test
