// SPDX-License-Identifier: MIT
//
// Decimals against whole numbers.
//
// A random tree over whole numbers is written once more in other units: what
// was 2 is 2 steps of 0.25, and where a comparison cannot notice, the number
// beside it is a little more or less. The two networks must have the same
// states, number by number, and the same steps; rules that are written in the
// same units must have the same verdicts, under every reduction.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/search/engine.hpp"
#include "ltl/rules/property.hpp"
#include "model/lowering.hpp"
#include "reference/effort.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_tree.hpp"
#include "text/utf8.hpp"

namespace btcheck::reference::decimals_cross_check_test {
namespace {

constexpr std::size_t kMostStates = 3000;

// What 1 becomes, and what makes no difference beside it.
struct Unit {
  const char* step;
  int thousandths;
  int less;  // thousandths, below a step
};
constexpr std::array<Unit, 5> kUnits = {{{"0.1", 100, 30},
                                         {"0.25", 250, 5},
                                         {"1.5", 1500, 500},
                                         {"0.125", 125, 124},
                                         {"20", 20'000, 7500}}};

bool is_number(const std::string& word) {
  return !word.empty() && std::ranges::all_of(word, is_digit);
}

std::string in_units(const Unit& unit, int number, int more) {
  return decimal_text(std::int64_t{number} * unit.thousandths + more, 3);
}

// By how much the number beside a variable may differ: `x > 2` is `x > 2.03`,
// where x has no value in between.
int play(const Unit& unit, const std::string& sign, SplitMix64& random) {
  if (random.percent(40)) return 0;
  if (sign == ">" || sign == "<=") return unit.less;
  return sign == "<" || sign == ">=" ? -unit.less : 0;
}

bool is_variable(const SExpression& form) {
  return !form.is_list &&
         (form.word.ends_with('x') || form.word.ends_with('y'));
}

// Every number of an expression in the unit.
void convert_expression(SExpression& form, const Unit& unit,
                        SplitMix64& random) {
  if (!form.is_list || form.list.empty()) return;
  const std::string sign = form.list[0].word;
  const bool has_play = form.list.size() == 3 && is_variable(form.list[1]);
  for (SExpression& part : form.list) {
    if (!part.is_list && is_number(part.word)) {
      part.word = in_units(unit, std::stoi(part.word),
                           has_play ? play(unit, sign, random) : 0);
    } else {
      convert_expression(part, unit, random);
    }
  }
}

bool begins_with(const SExpression& form, std::string_view word) {
  return form.is_list && !form.list.empty() && form.list[0].word == word;
}

void convert_declaration(SExpression& form, const Unit& unit) {
  bool has_max = false;
  for (std::size_t i = 2; i < form.list.size(); ++i) {
    SExpression& part = form.list[i];
    has_max |= part.word == ":max";
    if (!part.is_list && is_number(part.word)) {
      part.word = in_units(unit, std::stoi(part.word), 0);
    }
  }
  if (!has_max) return;
  for (const char* const word : {":step", unit.step}) {
    SExpression& added = form.list.emplace_back();
    added.word = word;
  }
}

void convert(SExpression& form, const Unit& unit, SplitMix64& random) {
  if (begins_with(form, "defsv")) return convert_declaration(form, unit);
  if (begins_with(form, "Eval")) {
    return convert_expression(form, unit, random);
  }
  for (std::size_t i = 0; i < form.list.size(); ++i) {
    const bool is_expression =
        i > 0 && (form.list[i - 1].word == ":requires" ||
                  form.list[i - 1].word == ":on-success" ||
                  form.list[i - 1].word == ":on-failure");
    if (is_expression) {
      convert_expression(form.list[i], unit, random);
    } else {
      convert(form.list[i], unit, random);
    }
  }
}

// One rule, over whole numbers and in the unit.
std::pair<std::string, std::string> random_rule(const BehaviorTree& tree,
                                                const Unit& unit,
                                                SplitMix64& random) {
  std::vector<std::string> numbers;
  for (const StateVariable& variable : tree.variables) {
    if (!variable.is_enumeration()) numbers.push_back(variable.name);
  }
  if (numbers.empty()) return {"possible dead", "possible dead"};
  const auto below = [&](int bound) { return random.below(bound); };
  constexpr std::array<const char*, 6> kSigns = {"==", "!=", "<",
                                                 "<=", ">",  ">="};
  constexpr std::array<const char*, 4> kForms = {"possible {}", "never {}",
                                                 "always {}", "<> ({})"};
  const std::string sign = kSigns[static_cast<std::size_t>(below(6))];
  const std::string form = kForms[static_cast<std::size_t>(below(4))];
  const std::string& one = numbers[static_cast<std::size_t>(
      below(static_cast<int>(numbers.size())))];
  const auto both = [&](const std::string& text, int first, int second,
                        int more) {
    const auto told = [&](const std::string& a, const std::string& b) {
      return fmt::format(fmt::runtime(form),
                         fmt::format(fmt::runtime(text), a, b));
    };
    return std::pair(
        told(std::to_string(first), std::to_string(second)),
        told(in_units(unit, first, 0), in_units(unit, second, more)));
  };
  const int number = below(4);
  switch (below(4)) {
    case 0:
      return both(one + " in {}..{}", std::min(number, 1), number + 1,
                  random.percent(50) ? unit.less : 0);
    case 1:
      return both(fmt::format("2 * {} - {{}} {} {{}}", one, sign), 1, number,
                  0);
    case 2:
      return both(
          fmt::format("{} + {} {} {{}} + {{}}", one, numbers.back(), sign), 0,
          number, 0);
    default:
      return both(fmt::format("{} {} {{1}}", one, sign), 0, number,
                  play(unit, sign, random));
  }
}

std::optional<Verdict> verdict_of(const BehaviorTree& tree,
                                  const CompiledNetwork& system,
                                  const std::string& rule,
                                  Reduction reduction) {
  const std::string text = "property p: " + rule + "\n";
  const auto file = read_properties("p.ltl", text);
  if (!file.value) return std::nullopt;
  const SourceText source("p.ltl", text);
  const auto bound = bind_properties(tree, system.network(), *file.value,
                                     source, ExtraAssumption::None);
  if (!bound.value) return std::nullopt;
  const auto found = verify(system, *bound.value,
                            {SearchOrder::BreadthFirst, reduction}, Limits{})
                         .verdicts.at(0);
  REQUIRE(found.error == "");
  return found.verdict;
}

bool are_same(const NaiveSpace& one, const NaiveSpace& other) {
  const auto same_steps = [](const auto& left, const auto& right) {
    return std::ranges::equal(left, right, [](const auto& a, const auto& b) {
      return a.target == b.target && a.edge == b.edge;
    });
  };
  return one.states == other.states && one.dead == other.dead &&
         std::ranges::equal(one.steps, other.steps, same_steps);
}

}  // namespace

TEST_CASE("a tree in steps is the tree in whole numbers") {
  const std::uint64_t seed = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(1000, 10'000);
  RandomTreeWeights weights;
  weights.number = 90;
  weights.most_number = 4;
  weights.leaving_range = 100;  // mod is not for decimals
  weights.contract = 50;
  int compared = 0;
  int faults = 0;
  int violated = 0;
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t here = seed * 1'000'000 + i;
    SplitMix64 random(here);
    const Unit& unit = kUnits[i % kUnits.size()];
    const std::string text = random_tree(here, weights);
    SExpression file = parse_s_expression(text);
    convert(file, unit, random);
    const std::string converted = print_s_expression(file);
    CAPTURE(text);
    CAPTURE(converted);
    const auto whole = read_btf("t.btf", text);
    const auto stepped = read_btf("t.btf", converted);
    REQUIRE(whole.value);
    if (!stepped.value) FAIL(render(stepped.diagnostics.at(0)));
    const Network network = lower(*whole.value, TickSemantics::Root);
    const Network other = lower(*stepped.value, TickSemantics::Root);
    const auto space = naive_space(network, kMostStates);
    if (!space) continue;
    const auto other_space = naive_space(other, kMostStates);
    REQUIRE(other_space);
    REQUIRE(are_same(*space, *other_space));
    ++compared;
    faults += network.fault ? 1 : 0;
    const CompiledNetwork system(network);
    const CompiledNetwork other_system(other);
    for (int rules = 0; rules < 3; ++rules) {
      const auto both = random_rule(*whole.value, unit, random);
      const std::string& rule = both.first;
      const std::string& other_rule = both.second;
      CAPTURE(rule);
      CAPTURE(other_rule);
      for (const Reduction reduction : {Reduction::None, Reduction::Full}) {
        const auto expected = verdict_of(*whole.value, system, rule, reduction);
        REQUIRE(expected);
        REQUIRE(verdict_of(*stepped.value, other_system, other_rule,
                           reduction) == expected);
        violated += *expected == Verdict::Violated;
      }
    }
  }
  MESSAGE(trees << " trees, " << compared << " compared, " << faults
                << " with faults; " << violated << " verdicts violated");
  CHECK_COVERED(compared > static_cast<int>(trees / 2));
  CHECK_COVERED(faults > 20);
  CHECK_COVERED(violated > 200);
}

}  // namespace btcheck::reference::decimals_cross_check_test
