// SPDX-License-Identifier: MIT
//
// Exported models against the engine: read back from their text by readers
// that know the languages and nothing of networks, explored naively, and
// counted. Neither NuSMV nor frac is needed; what they would see is the text.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "explore/search/reachability.hpp"
#include "explore/state/step.hpp"
#include "model/automata/network.hpp"
#include "model/btf_text.hpp"
#include "model/export/fiacre/fiacre.hpp"
#include "model/export/smv/smv.hpp"
#include "model/lowering.hpp"
#include "model/tree/tree.hpp"
#include "reference/effort.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_tree.hpp"
#include "reference/read_model.hpp"

namespace btcheck::reference::export_cross_check_test {
namespace {

constexpr TickSemantics kAllTicks[] = {
    TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes,
    TickSemantics::None};

BehaviorTree tree_of_text(const std::string& name, const std::string& text) {
  auto read = read_btf(name, text);
  REQUIRE(read.value.has_value());
  return std::move(*read.value);
}

BehaviorTree example_tree(const std::string& name) {
  return tree_of_text(name, example(name));
}

ReachabilityResult counted(const Network& network, std::uint64_t most) {
  const CompiledNetwork system(network);
  const Limits limits{most, UINT64_MAX, nullptr};
  ReachabilityVisitor nothing;
  return BreadthFirst(system, limits).run(nothing);
}

// --- claims about single states ---

Expression random_operand(const Network& network, SplitMix64& random) {
  if (random.percent(40)) return Expression::constant(random.below(9) - 2);
  return Expression::variable(
      random.below(static_cast<int>(network.variables.size())));
}

// A condition of up to four operations of any kind over any variables.
Expression random_condition(const Network& network, SplitMix64& random) {
  Expression made = random_operand(network, random);
  const int operations = 1 + random.below(4);
  for (int i = 0; i < operations; ++i) {
    constexpr int kFirst = static_cast<int>(Operation::Negate);
    constexpr int kCount = static_cast<int>(Operation::Or) - kFirst + 1;
    const auto operation =
        static_cast<Operation>(kFirst + random.below(kCount));
    if (arity(operation) == 1) {
      made = Expression::unary(operation, std::move(made));
    } else if (random.percent(50)) {
      made = Expression::binary(operation, std::move(made),
                                random_operand(network, random));
    } else {
      made = Expression::binary(operation, random_operand(network, random),
                                std::move(made));
    }
  }
  return made;
}

// A location and a status, as properties ask for them.
Expression random_event(const Network& network, SplitMix64& random) {
  const auto compared = [&] {
    const int number = random.below(static_cast<int>(network.variables.size()));
    const Variable& variable =
        network.variables[static_cast<std::size_t>(number)];
    const int size =
        static_cast<int>(std::min<std::int64_t>(variable.domain_size(), 50));
    return Expression::binary(
        random.percent(70) ? Operation::Equal : Operation::NotEqual,
        Expression::variable(number),
        Expression::constant(variable.min + random.below(size)));
  };
  return Expression::binary(random.percent(50) ? Operation::And : Operation::Or,
                            compared(), compared());
}

std::vector<Expression> random_claims(const Network& network,
                                      std::uint64_t seed) {
  SplitMix64 random(seed);
  std::vector<Expression> claims;
  for (int i = 0; i < 6; ++i) {
    claims.push_back(random_condition(network, random));
    claims.push_back(random_event(network, random));
  }
  return claims;
}

std::string claim_name(std::size_t number) {
  return "claim" + std::to_string(number);
}

std::vector<SmvClaim> smv_claims_of(const std::vector<Expression>& conditions) {
  std::vector<SmvClaim> claims;
  for (const Expression& condition : conditions) {
    SmvClaim claim;
    claim.name = claim_name(claims.size());
    claim.formula = "p0";
    claim.propositions.push_back(
        {SmvProposition::Kind::State, condition, {}, {}});
    claims.push_back(std::move(claim));
  }
  return claims;
}

std::vector<ExportClaim> fiacre_claims_of(
    const std::vector<Expression>& conditions) {
  std::vector<ExportClaim> claims;
  for (const Expression& condition : conditions) {
    claims.push_back({claim_name(claims.size()), "always p0", {condition}, {}});
  }
  return claims;
}

struct Census {
  int networks = 0;
  int with_timers = 0;
  int with_faults = 0;
  std::uint64_t states = 0;
  int claims = 0;
  int violated = 0;
};

// What a reader has found about the claims, against the naive states.
void compare_claims(const Network& network,
                    const std::vector<Expression>& conditions,
                    const ReadSpace& theirs, Census& census) {
  if (conditions.empty()) return;
  const auto space = naive_space(network, 10'000);
  REQUIRE(space.has_value());
  for (const auto& [name, holds] : theirs.always) {
    const std::size_t number = std::stoul(name.substr(5));
    CAPTURE(expression_text(network, conditions[number]));
    const bool ours =
        std::ranges::all_of(space->states, [&](const NaiveState& state) {
          return naive_value(conditions[number], state) != 0;
        });
    CHECK(holds == ours);
    ++census.claims;
    census.violated += ours ? 0 : 1;
  }
}

void compare_smv(const BehaviorTree& tree, const Network& network,
                 const ReachabilityResult& ours,
                 const std::vector<Expression>& conditions, Census& census) {
  const auto text = smv_text(tree, network, smv_claims_of(conditions));
  REQUIRE(text.value.has_value());
  const SearchProgress& progress = ours.progress;
  const auto theirs = read_smv_space(*text.value, progress.states + 1000);
  REQUIRE(theirs.has_value());
  CHECK(theirs->states == progress.states);
  CHECK(theirs->transitions == progress.transitions);
  CHECK(theirs->always.size() == conditions.size());
  compare_claims(network, conditions, *theirs, census);
}

// The engine keeps the clocks that stand when a fault ends a run; Fiacre, where
// nothing is enabled any more, has none.
std::size_t states_without_late_clocks(const Network& network) {
  const auto space = naive_space(network, 10'000);
  REQUIRE(space.has_value());
  std::set<NaiveState> distinct;
  for (NaiveState state : space->states) {
    if (network.fault && state.value(*network.fault) != 0) {
      std::ranges::fill(state.clocks, 0);
    }
    distinct.insert(std::move(state));
  }
  return distinct.size();
}

void compare_fiacre(const BehaviorTree& tree, const Network& network,
                    const ReachabilityResult& ours,
                    const std::vector<Expression>& conditions, Census& census) {
  const auto text = fiacre_text(tree, network, fiacre_claims_of(conditions));
  REQUIRE(text.value.has_value());
  const SearchProgress& progress = ours.progress;
  const auto theirs = read_fiacre_space(*text.value, progress.states + 1000);
  REQUIRE(theirs.has_value());
  CHECK(theirs->states == (network.fault ? states_without_late_clocks(network)
                                         : progress.states));
  CHECK(theirs->transitions == progress.transitions);
  // What no single process sees is left out, with a warning.
  CHECK(theirs->always.size() + text.diagnostics.size() == conditions.size());
  compare_claims(network, conditions, *theirs, census);
}

void compare(const BehaviorTree& tree, const Network& network,
             const ReachabilityResult& ours,
             const std::vector<Expression>& conditions, Census& census) {
  compare_smv(tree, network, ours, conditions, census);
  compare_fiacre(tree, network, ours, conditions, census);
  ++census.networks;
  census.states += ours.progress.states;
  census.with_faults += network.fault ? 1 : 0;
  for (const Automaton& automaton : network.automata) {
    if (automaton.kind != AutomatonKind::Timer) continue;
    ++census.with_timers;
    break;
  }
}

void compare_random(std::uint64_t seed, Census& census) {
  constexpr std::uint64_t kMostStates = 3000;
  RandomTreeWeights weights;
  weights.duration = 50;
  weights.max_nodes = 7;
  weights.moving_number = seed % 3 == 0 ? 50 : 0;
  weights.decided = 30;
  weights.timed_moves = 50;
  // Assignments that leave their range are rare: every fourth tree has one.
  const bool wants_fault = seed % 4 == 0;
  if (wants_fault) weights.leaving_range = 100;
  SplitMix64 random(seed);
  const auto ticks = kAllTicks[seed / 4 % 4];
  while (true) {
    const std::string text = random_tree(random.next(), weights);
    CAPTURE(text);
    const BehaviorTree tree = tree_of_text("random.btf", text);
    const Network network = lower(tree, ticks);
    if (wants_fault && !network.fault) continue;
    const ReachabilityResult ours = counted(network, kMostStates);
    if (!ours.is_complete || ours.progress.states < 30) continue;
    return compare(tree, network, ours, random_claims(network, random.next()),
                   census);
  }
}

}  // namespace

TEST_CASE("the exports of the examples have as many states and steps") {
  Census census;
  const std::vector<std::string> small = {"recovery.btf", "roundrobin.btf",
                                          "mars_rover.btf", "train.btf"};
  const std::vector<std::string> more = {"recovery.btf", "roundrobin.btf",
                                         "mars_rover.btf", "train.btf",
                                         "drone1.btf"};
  for (const std::string& name : is_long_run() ? more : small) {
    CAPTURE(name);
    const BehaviorTree tree = example_tree(name);
    for (const TickSemantics ticks : kAllTicks) {
      CAPTURE(tick_name(ticks));
      const Network network = lower(tree, ticks);
      compare(tree, network, counted(network, UINT64_MAX), {}, census);
    }
  }
  MESSAGE(census.networks << " networks, " << census.states << " states");
}

TEST_CASE("updates that read what earlier ones wrote mean the same") {
  // Random trees hardly ever have two effects of which one reads the other.
  const BehaviorTree tree = tree_of_text(
      "chained.btf",
      "(defsv a :min 0 :max 6) (defsv b :min 0 :max 6)"
      "(defaction x :returns (success failure)"
      " :on-success ((:= a (mod (+ b 1) 7)) (:= b (mod (+ a a) 7)))"
      " :on-failure ((:= b (/ a 2)) (:= a (- 6 b))))"
      "(BehaviorTree :name t :loop 1 (Action :ID x))");
  Census census;
  for (const TickSemantics ticks : kAllTicks) {
    const Network network = lower(tree, ticks);
    compare(tree, network, counted(network, UINT64_MAX),
            random_claims(network, seed_or(1)), census);
  }
  CHECK_COVERED(census.states > 200);
}

TEST_CASE("the exports of random trees have as many states and steps") {
  const std::uint64_t seed = seed_or(1);
  Census census;
  const int cases = by_effort(20, 200);
  for (int i = 0; i < cases; ++i) {
    compare_random(seed * 1'000'000 + static_cast<std::uint64_t>(i), census);
  }
  MESSAGE(census.networks << " networks, " << census.with_timers
                          << " with timers, " << census.with_faults
                          << " with faults; " << census.states << " states; "
                          << census.claims << " claims, " << census.violated
                          << " violated");
}

}  // namespace btcheck::reference::export_cross_check_test
