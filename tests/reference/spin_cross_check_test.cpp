// SPDX-License-Identifier: MIT
//
// The engine against SPIN, on random trees and random formulas.
//
// Every other reference engine here reads our tables with our eyes. SPIN knows
// nothing of us: it is given the exported model with some formulas, and has to
// count as many states and steps, and to come to the same verdicts. That tests
// the exporter and the engine at once; when they disagree, who is wrong is to
// be found out.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "check/space/space.hpp"
#include "explore/reduce/labels.hpp"
#include "explore/search/reachability.hpp"
#include "ltl/buchi/translate.hpp"
#include "ltl/product/accepting_cycle.hpp"
#include "ltl/product/product.hpp"
#include "model/export/promela/promela.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"
#include "reference/effort.hpp"
#include "reference/random_ltl.hpp"
#include "reference/random_tree.hpp"
#include "reference/random_xml_tree.hpp"
#include "reference/spin.hpp"

namespace btcheck::reference::spin_cross_check_test {
namespace {

constexpr std::uint64_t kMostStates = 3000;
constexpr std::uint32_t kAtoms = 3;
constexpr TickSemantics kAllTicks[] = {
    TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes,
    TickSemantics::None};

struct Census {
  int networks = 0;
  int with_free_moves = 0;
  int counted = 0;  // whose states SPIN was asked to count
  int formulas = 0;
  int violated = 0;
};

struct Claim {
  FormulaPool pool;
  FormulaId formula{};
  std::vector<Expression> atoms;
};

Expression random_comparison(const Network& network, SplitMix64& random) {
  const int number = random.below(static_cast<int>(network.variables.size()));
  const Variable& variable =
      network.variables[static_cast<std::size_t>(number)];
  const int size =
      static_cast<int>(std::min<std::int64_t>(variable.domain_size(), 50));
  constexpr Operation kRelations[] = {
      Operation::Equal, Operation::Equal,   Operation::NotEqual,
      Operation::Less,  Operation::Greater, Operation::LessEqual};
  return Expression::binary(
      kRelations[random.below(6)], Expression::variable(number),
      Expression::constant(variable.min + random.below(size)));
}

// x + y > z, x / y = z, …; divisors may be zero.
Expression random_sum(const Network& network, SplitMix64& random) {
  const auto any = [&] {
    return Expression::variable(
        random.below(static_cast<int>(network.variables.size())));
  };
  constexpr Operation kArithmetic[] = {Operation::Add, Operation::Subtract,
                                       Operation::Multiply, Operation::Divide,
                                       Operation::Modulo};
  Expression sum =
      Expression::binary(kArithmetic[random.below(5)], any(), any());
  if (random.percent(30)) {
    sum = Expression::unary(Operation::Negate, std::move(sum));
  }
  return Expression::binary(
      random.percent(50) ? Operation::Less : Operation::Equal, std::move(sum),
      any());
}

Expression random_predicate(const Network& network, SplitMix64& random) {
  if (random.percent(15)) return random_sum(network, random);
  Expression made = random_comparison(network, random);
  if (random.percent(40)) {
    made =
        Expression::binary(random.percent(50) ? Operation::And : Operation::Or,
                           std::move(made), random_comparison(network, random));
  }
  if (random.percent(25)) {
    made = Expression::unary(Operation::Not, std::move(made));
  }
  return made;
}

// It speaks of time, and SPIN can translate it: an equivalence of temporal
// formulas, below others, keeps its translation busy for minutes.
bool is_suitable(const FormulaPool& pool, FormulaId id) {
  if (pool.has_next(id) || pool.is_state_formula(id)) return false;
  int temporal = 0;
  for (const FormulaId part : pool.nodes(id)) {
    temporal += is_temporal(pool[part].kind) ? 1 : 0;
    if (pool[part].kind == FormulaKind::Equivalent &&
        !pool.is_state_formula(part)) {
      return false;
    }
  }
  return temporal <= 3;
}

Claim random_claim(const Network& network, SplitMix64& random) {
  Claim claim;
  for (std::uint32_t i = 0; i < kAtoms; ++i) {
    claim.atoms.push_back(random_predicate(network, random));
  }
  std::mt19937 stream(static_cast<unsigned>(random.next()));
  do {
    claim.formula =
        random_formula(claim.pool, stream, 3 + random.below(7), kAtoms);
  } while (!is_suitable(claim.pool, claim.formula));
  return claim;
}

bool holds_here(const CompiledNetwork& system, Claim& claim) {
  std::vector<StatePredicate> predicates;
  for (const Expression& atom : claim.atoms) predicates.push_back({atom, {}});
  const auto automaton =
      translate(claim.pool, claim.pool.unary(FormulaKind::Not, claim.formula));
  REQUIRE(automaton);
  const LabelledNetwork labelled(system, predicates);
  const Product product(labelled, *automaton,
                        system.has_free_moves() ? Justice::SomeStepsAreNot
                                                : Justice::EveryStepIsProgress);
  const Limits limits;
  return find_accepting_cycle(product, limits).outcome == SearchOutcome::Empty;
}

// Idle steps: SPIN counts them, and the initial state as a step as well.
struct StepCensus : ReachabilityVisitor {
  std::uint64_t idle = 0;
  void stepped(StateId from, Step, StateId to) { idle += from == to ? 1 : 0; }
};

void compare_counts(const CompiledNetwork& system, const SpinVerifier& spin) {
  StepCensus steps;
  const Limits limits;
  const SearchProgress ours = BreadthFirst(system, limits).run(steps).progress;
  const auto theirs = spin.space();
  REQUIRE(theirs.has_value());
  CHECK(theirs->states == ours.states);
  CHECK(theirs->transitions == ours.transitions + steps.idle + 1);
}

void compare(const BehaviorTree& tree, const Network& network,
             std::vector<Claim>& claims, Census& census) {
  std::vector<ExportClaim> exported;
  for (const Claim& claim : claims) {
    exported.push_back({fmt::format("claim{}", exported.size()),
                        spin_text(claim.pool, claim.formula),
                        claim.atoms,
                        {}});
  }
  const auto model = promela_text(tree, network, exported);
  REQUIRE(model.value);
  CAPTURE(*model.value);
  const SpinVerifier spin(*model.value);
  REQUIRE(spin.complaints() == "");
  const CompiledNetwork system(network);
  ++census.networks;
  if (system.has_free_moves()) {
    ++census.with_free_moves;  // their model has the variable `progress`
  } else {
    ++census.counted;
    compare_counts(system, spin);
  }
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const std::string& formula = exported[i].formula;
    CAPTURE(formula);
    const auto theirs = spin.holds(exported[i].name);
    REQUIRE(theirs.has_value());
    CHECK(holds_here(system, claims[i]) == *theirs);
    ++census.formulas;
    census.violated += *theirs ? 0 : 1;
  }
}

struct RandomModel {
  std::string text;
  BehaviorTree tree;
  Network network;
};

enum class Language : std::uint8_t { Btf, Xml };

Result<BehaviorTree> random_one(SplitMix64& random, Language language,
                                std::string& text) {
  if (language == Language::Xml) {
    TreeReading reading;
    reading.profile =
        random.percent(50) ? Profile::Nav2Humble : Profile::Nav2Main;
    text = random_xml_tree(random.next(), *reading.profile);
    return read_tree("random.xml", text, reading);
  }
  RandomTreeWeights weights;
  weights.duration = 40;
  weights.max_nodes = 7;
  weights.moving_number = 20;
  weights.decided = 30;
  weights.timed_moves = 50;
  text = random_tree(random.next(), weights);
  return read_btf("random.btf", text);
}

// A network that is small enough, and not too small.
RandomModel random_model(SplitMix64& random, TickSemantics ticks,
                         Language language) {
  while (true) {
    RandomModel model;
    auto tree = random_one(random, language, model.text);
    CAPTURE(model.text);
    REQUIRE(tree.value);
    model.tree = std::move(*tree.value);
    model.network = lower(model.tree, ticks);
    const Limits limits{kMostStates, UINT64_MAX, nullptr};
    const SpaceReport space = measure_space(model.network, {}, limits);
    const std::uint64_t states = space.result.progress.states;
    if (space.result.is_complete && states >= 30) return model;
  }
}

void compare_random(std::uint64_t seed, TickSemantics ticks, int claim_count,
                    Census& census) {
  SplitMix64 random(seed);
  const RandomModel model = random_model(random, ticks, Language::Btf);
  CAPTURE(model.text);
  std::vector<Claim> claims;
  for (int i = 0; i < claim_count; ++i) {
    claims.push_back(random_claim(model.network, random));
  }
  compare(model.tree, model.network, claims, census);
}

// Counts one, and returns how many states it has.
std::uint64_t count_random(SplitMix64& random, Language language) {
  while (true) {
    const RandomModel made =
        random_model(random, TickSemantics::None, language);
    const CompiledNetwork system(made.network);
    if (system.has_free_moves()) continue;  // SPIN's model has `progress`
    CAPTURE(made.text);
    const auto model = promela_text(made.tree, made.network, {});
    REQUIRE(model.value);
    const SpinVerifier spin(*model.value, SpinUse::Count);
    REQUIRE(spin.complaints() == "");
    compare_counts(system, spin);
    return spin.space()->states;
  }
}

}  // namespace

TEST_CASE("SPIN counts and decides as the engine does") {
  if (!spin_is_installed()) {
    MESSAGE("spin is not installed: nothing compared");
    return;
  }
  const std::uint64_t seed = seed_or(1);
  const int networks = by_effort(4, 60);
  const int claims = by_effort(4, 10);
  Census census;
  for (int i = 0; i < networks; ++i) {
    const auto number = static_cast<std::uint64_t>(i);
    compare_random(seed * 1'000'000 + number, kAllTicks[i % 4], claims, census);
  }
  MESSAGE(census.networks << " of SPIN's models, " << census.with_free_moves
                          << " with free moves, the states of "
                          << census.counted << " counted; " << census.formulas
                          << " formulas, " << census.violated << " violated");
}

TEST_CASE("SPIN counts the states and steps of random trees") {
  if (!spin_is_installed()) {
    MESSAGE("spin is not installed: nothing compared");
    return;
  }
  SplitMix64 random(seed_or(1));
  const int trees = by_effort(12, 200);
  std::uint64_t states = 0;
  for (int i = 0; i < trees; ++i) {
    CAPTURE(i);
    states += count_random(random, i % 4 == 3 ? Language::Xml : Language::Btf);
  }
  MESSAGE(trees << " trees without time counted by SPIN, " << states
                << " states");
}

}  // namespace btcheck::reference::spin_cross_check_test
