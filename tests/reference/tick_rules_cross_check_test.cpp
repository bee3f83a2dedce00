// SPDX-License-Identifier: MIT
//
// Rules about ticks: what searches say, and what comes of every tick of the
// tree told by recursion.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/bind/remembered.hpp"
#include "check/search/engine.hpp"
#include "model/lowering.hpp"
#include "reference/effort.hpp"
#include "reference/random_tree.hpp"
#include "reference/tick_outcomes.hpp"

namespace btcheck::reference::tick_rules_cross_check_test {
namespace {

constexpr int kRules = 4;              // of one tree
constexpr std::size_t kMost = 20'000;  // ticks looked at

// Conditions over answers, joined: one of the ways it may be so.
struct RandomRule {
  struct Part {
    std::size_t node = 0;
    bool is_equal = true;
    std::string_view answer;
  };
  std::vector<Part> parts;
  bool are_all = true;  // joined by `and`
  int quantifier = 0;   // every, no, some

  bool holds_in(const TickAnswers& answers) const {
    const auto is_so = [&](const Part& part) {
      return (answers[part.node] == part.answer) == part.is_equal;
    };
    return are_all ? std::ranges::all_of(parts, is_so)
                   : std::ranges::any_of(parts, is_so);
  }

  bool holds(const std::vector<TickAnswers>& ticks) const {
    const auto is_so = [&](const TickAnswers& tick) { return holds_in(tick); };
    if (quantifier == 0) return std::ranges::all_of(ticks, is_so);
    return std::ranges::any_of(ticks, is_so) == (quantifier == 2);
  }

  std::string text() const {
    constexpr std::array<std::string_view, 3> kWords = {
        "every tick", "in no tick", "in some tick"};
    std::string condition;
    for (const Part& part : parts) {
      const std::string node =
          part.node == 0 ? "root" : fmt::format("btn{}", part.node);
      if (!condition.empty()) condition += are_all ? " and " : " or ";
      condition += fmt::format("{}.answer {} {}", node,
                               part.is_equal ? "==" : "!=", part.answer);
    }
    return fmt::format("{}: {}", kWords[static_cast<std::size_t>(quantifier)],
                       condition);
  }
};

RandomRule random_rule(SplitMix64& random, std::size_t nodes) {
  constexpr std::array<std::string_view, 4> kAnswers = {"none", "success",
                                                        "failure", "running"};
  RandomRule rule;
  rule.are_all = random.percent(60);
  rule.quantifier = random.below(3);
  const int parts = 1 + random.below(3);
  for (int i = 0; i < parts; ++i) {
    rule.parts.push_back(
        {static_cast<std::size_t>(random.below(static_cast<int>(nodes))),
         random.percent(75),
         kAnswers[static_cast<std::size_t>(random.below(4))]});
  }
  return rule;
}

// Either nothing is shared, or nothing runs side by side and by itself.
RandomTreeWeights weights_of(std::uint64_t round) {
  RandomTreeWeights weights;
  weights.max_running = 4;
  if (round % 2 == 0) {
    weights.max_variables = 0;
    weights.max_parallels = 2;
  } else {
    weights.sampled = 100;
    weights.max_parallels = 0;
  }
  return weights;
}

// The tree says what it does in a tick only as it interleaves: a variable that
// nothing writes moves at any instant, and an Eval beside another child of a
// Parallel may read the status of that.
bool is_interleaved(const std::string& text, const BehaviorTree& tree) {
  const auto has = [&](std::string_view word) {
    return text.find(word) != std::string::npos;
  };
  if (has("Parallel") && has("rstatus")) return true;
  for (std::uint32_t v = 0; v < tree.variables.size(); ++v) {
    if (moves_freely(tree, StateVariableId{v})) return true;
  }
  return false;
}

std::vector<Verdict> verdicts(const BehaviorTree& tree, const std::string& text,
                              Reduction reduction, TickSemantics ticks) {
  const auto file = read_properties("ticks.ltl", text);
  REQUIRE(file.value.has_value());
  Network network = lower(tree, ticks);
  remember_for(tree, *file.value, network);
  const auto bound = bind_properties(tree, network, *file.value,
                                     SourceText("ticks.ltl", text), {});
  REQUIRE(bound.value.has_value());
  const CompiledNetwork system(network);
  SearchChoices choices;
  choices.reduction = reduction;
  std::vector<Verdict> found;
  for (const PropertyVerdict& each :
       verify(system, *bound.value, choices, {}).verdicts) {
    CHECK(each.error == "");
    found.push_back(each.verdict);
  }
  return found;
}

}  // namespace

TEST_CASE("rules about ticks say what comes of ticks") {
  const std::uint64_t seed = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(150, 1'600);
  std::size_t pairs = 0;
  std::size_t violated = 0;
  std::size_t too_large = 0;
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t here = seed * 1'000'000 + i;
    const std::string text = random_tree(here, weights_of(i));
    const auto tree = read_btf("random.btf", text);
    REQUIRE(tree.value.has_value());
    if (is_interleaved(text, *tree.value)) continue;
    const auto outcomes = tick_outcomes(*tree.value, kMost);
    too_large += !outcomes;
    if (!outcomes) continue;
    SplitMix64 random(here);
    std::string rules;
    std::vector<Verdict> expected;
    for (int r = 0; r < kRules; ++r) {
      const RandomRule rule = random_rule(random, tree.value->nodes.size());
      rules += fmt::format("property r{}: {}\n", r, rule.text());
      expected.push_back(rule.holds(*outcomes) ? Verdict::Holds
                                               : Verdict::Violated);
      violated += expected.back() == Verdict::Violated;
      ++pairs;
    }
    CAPTURE(here);
    CAPTURE(text);
    CAPTURE(rules);
    for (const Reduction reduction :
         {Reduction::None, Reduction::Live, Reduction::Full}) {
      CHECK(verdicts(*tree.value, rules, reduction, TickSemantics::Root) ==
            expected);
    }
    // Under `nodes` and `none` the answers are the same where no delay counts
    // units of time.
    const bool has_delay = text.find(":duration") != std::string::npos ||
                           text.find("RateController") != std::string::npos;
    if (has_delay) continue;
    const auto other = i % 3 == 0 ? TickSemantics::Nodes : TickSemantics::None;
    CHECK(verdicts(*tree.value, rules, Reduction::Full, other) == expected);
  }
  MESSAGE(pairs << " pairs, " << violated << " violated, " << too_large
                << " trees too large");
  CHECK_COVERED(violated > pairs / 5);
  CHECK_COVERED(violated < pairs * 4 / 5);
  CHECK_COVERED(pairs > trees * 3);
}

}  // namespace btcheck::reference::tick_rules_cross_check_test
