// SPDX-License-Identifier: MIT
//
// Operators of the past: the bits that a network keeps, and what the states of
// a run before this one say by definition. Then the verdicts, with every
// reduction.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/bind/remembered.hpp"
#include "check/replay/replay.hpp"
#include "check/rules_network.hpp"
#include "check/search/engine.hpp"
#include "model/automata/tick_memory.hpp"
#include "model/lowering.hpp"
#include "reference/effort.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference::past_cross_check_test {
namespace {

constexpr int kRules = 4;    // of one tree
constexpr int kSteps = 160;  // of one run
constexpr int kDeepest = 3;  // operators inside each other

std::string random_condition(SplitMix64& random, const BehaviorTree& tree,
                             int depth) {
  const auto inner = [&] { return random_condition(random, tree, depth - 1); };
  if (depth > 0) {
    switch (random.below(6)) {
      case 0:
        return fmt::format("once ({})", inner());
      case 1:
        return fmt::format("previously ({})", inner());
      case 2:
      case 3:
        return fmt::format("(({}) since ({}))", inner(), inner());
      case 4:
        return fmt::format("not ({})", inner());
      default:
        return fmt::format("(({}) {} ({}))", inner(),
                           random.percent(50) ? "and" : "or", inner());
    }
  }
  const int node = random.below(static_cast<int>(tree.nodes.size()));
  if (!tree.variables.empty() && random.percent(30)) {
    const StateVariable& variable = tree.variables[static_cast<std::size_t>(
        random.below(static_cast<int>(tree.variables.size())))];
    const int value =
        variable.min + random.below(variable.max - variable.min + 1);
    if (variable.is_enumeration()) {
      return fmt::format("{} == {}", variable.name, variable.value_name(value));
    }
    constexpr std::array kForms = {"{} == {}", "{} < {}", "2 * {} - 1 > {}"};
    return fmt::format(
        fmt::runtime(kForms[static_cast<std::size_t>(random.below(3))]),
        variable.name, value);
  }
  if (random.percent(10)) return "tick.ends";
  if (random.percent(25)) return fmt::format("btn{}.answer == success", node);
  constexpr std::array kEvents = {"ticked", "success", "failure", "running",
                                  "active"};
  return fmt::format("btn{}.{}", node,
                     kEvents[static_cast<std::size_t>(random.below(5))]);
}

// The states of a run so far, and what they say.
class Definition {
 public:
  Definition(const PropertyFile& file, const BoundFile& bound,
             const NetworkInterpreter& interpreter, VariableId root_answer)
      : file_(file),
        bound_(bound),
        interpreter_(interpreter),
        root_answer_(root_answer),
        truth_(file.atoms.size()) {}

  void add(const Valuation& state) {
    ends_.push_back(state.variables[index(root_answer_)] != 0);
    for (std::uint32_t a = 0; a < file_.atoms.size(); ++a) {
      const Atom& atom = file_.atoms[a];
      if (is_past(atom.kind)) {
        held_[a].push_back(holds(atom.of));
        began_[a].push_back(holds(atom.since));
      }
      truth_[a] = is_past(atom.kind)
                      ? remembers(a)
                      : interpreter_.is_true(bound_.atoms[a], state);
    }
  }

  // In the last state.
  bool holds(FormulaId formula) const {
    const FormulaNode& node = file_.formulas[formula];
    switch (node.kind) {
      case FormulaKind::True:
        return true;
      case FormulaKind::False:
        return false;
      case FormulaKind::Atom:
        return truth_[node.atom];
      case FormulaKind::Not:
        return !holds(node.left);
      case FormulaKind::And:
        return holds(node.left) && holds(node.right);
      case FormulaKind::Or:
        return holds(node.left) || holds(node.right);
      default:
        FAIL("no such operator is made");
        return false;
    }
  }

 private:
  bool remembers(std::uint32_t atom) const {
    const std::vector<bool>& held = held_.at(atom);
    const std::vector<bool>& began = began_.at(atom);
    const std::size_t now = held.size() - 1;
    switch (file_.atoms[atom].kind) {
      case AtomKind::Once:
        for (std::size_t i = 0; i <= now; ++i) {
          if (held[i]) return true;
        }
        return false;
      case AtomKind::Since:
        for (std::size_t i = now + 1; i-- > 0;) {
          if (began[i]) return true;
          if (!held[i]) return false;
        }
        return false;
      default: {
        std::size_t at = now;
        while (at > 0 && ends_[at]) --at;   // out of this tick's end
        while (at > 0 && !ends_[at]) --at;  // to the end of that before
        return ends_[at] && at < now && !is_same_end(at, now) && held[at];
      }
    }
  }

  bool is_same_end(std::size_t first, std::size_t last) const {
    for (std::size_t i = first; i <= last; ++i) {
      if (!ends_[i]) return false;
    }
    return true;
  }

  const PropertyFile& file_;
  const BoundFile& bound_;
  const NetworkInterpreter& interpreter_;
  VariableId root_answer_;
  std::vector<bool> truth_;                          // by atom
  std::map<std::uint32_t, std::vector<bool>> held_;  // by atom, by state
  std::map<std::uint32_t, std::vector<bool>> began_;
  std::vector<bool> ends_;
};

// Steps that may be taken; time last.
std::vector<Step> steps_from(const Network& network,
                             const NetworkInterpreter& interpreter,
                             const Valuation& state) {
  std::vector<Step> steps;
  for (std::uint32_t e = 0; e < network.edge_count(); ++e) {
    if (interpreter.may_fire(state, e)) steps.push_back({.edge = e});
  }
  if (interpreter.may_wait(state)) {
    steps.push_back({.edge = kTimeStep, .elapsed = 1});
  }
  return steps;
}

}  // namespace

TEST_CASE("bits of the past say what the states before say") {
  const std::uint64_t seed = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(150, 5'000);
  std::size_t compared = 0;
  std::size_t true_ones = 0;
  std::size_t verdicts = 0;
  RandomTreeWeights weights;
  weights.sampled = 60;
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t here = seed * 1'000'000 + i;
    const std::string text = random_tree(here, weights);
    const auto tree = read_btf("random.btf", text);
    REQUIRE(tree.value.has_value());
    SplitMix64 random(here);
    std::string rules = "property first: possible tick.ends\n";
    for (int r = 0; r < kRules; ++r) {
      rules += fmt::format("property r{}: never {}\n", r,
                           random_condition(random, *tree.value, kDeepest));
    }
    CAPTURE(here);
    CAPTURE(text);
    CAPTURE(rules);
    const SourceText source("past.ltl", rules);
    const auto file = read_properties("past.ltl", rules);
    REQUIRE(file.value.has_value());
    Network network = lower(*tree.value, TickSemantics::Root);
    remember_for(*tree.value, *file.value, network);
    const auto bound =
        bind_properties(*tree.value, network, *file.value, source, {});
    REQUIRE(bound.value.has_value());
    const auto answer = answer_of(network, tree.value->roots[0]);
    REQUIRE(answer.has_value());

    const NetworkInterpreter interpreter(network);
    Definition definition(*file.value, *bound.value, interpreter, *answer);
    Valuation state = interpreter.initial();
    for (int s = 0; s < kSteps; ++s) {
      definition.add(state);
      for (const BoundProperty& property : bound.value->properties) {
        const bool is_so = interpreter.is_true(property.predicate, state);
        CHECK(is_so == definition.holds(property.property->formula));
        ++compared;
        true_ones += is_so;
      }
      const auto steps = steps_from(network, interpreter, state);
      if (steps.empty()) break;
      interpreter.take(state, steps[static_cast<std::size_t>(random.below(
                                  static_cast<int>(steps.size())))]);
    }

    if (i % 3 != 0) continue;
    const CompiledNetwork system(network);
    std::vector<std::vector<Verdict>> found;
    for (const Reduction reduction :
         {Reduction::None, Reduction::Live, Reduction::Full}) {
      SearchChoices choices;
      choices.reduction = reduction;
      found.emplace_back();
      Limits limits;
      limits.max_states = 200'000;
      for (const PropertyVerdict& each :
           verify(system, *bound.value, choices, limits).verdicts) {
        CHECK(each.error == "");
        found.back().push_back(each.verdict);
      }
    }
    // The same where SetSV gives one value of each region.
    const auto split =
        network_for(*tree.value, SourceText("random.btf", text), *file.value,
                    source, TickSemantics::Root, ExtraAssumption::None, 1);
    REQUIRE(split.value.has_value());
    Limits limits;
    limits.max_states = 200'000;
    found.emplace_back();
    const CompiledNetwork sampled(*split.value->network);
    for (const PropertyVerdict& each :
         verify(sampled, split.value->bound, {}, limits).verdicts) {
      found.back().push_back(each.verdict);
    }
    for (std::size_t p = 0; p < found[0].size(); ++p) {
      if (found[0][p] == Verdict::Undecided) continue;
      ++verdicts;
      CHECK(found[1][p] == found[0][p]);
      CHECK(found[2][p] == found[0][p]);
      CHECK(found[3][p] == found[0][p]);
    }
  }
  MESSAGE(compared << " of the past compared, " << true_ones << " true, "
                   << verdicts << " verdicts");
  CHECK_COVERED(true_ones > compared / 10);
  CHECK_COVERED(true_ones < compared * 9 / 10);
}

}  // namespace btcheck::reference::past_cross_check_test
