// SPDX-License-Identifier: MIT
//
// The quotients of `btcheck space` against states that are enumerated and
// compared without cleverness; what is seen of a step is told a second time.
#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "check/space/quotient.hpp"
#include "model/btf_text.hpp"
#include "model/lowering.hpp"
#include "reference/effort.hpp"
#include "reference/naive_bisimulation.hpp"
#include "reference/naive_network.hpp"
#include "reference/reduction_cases.hpp"

namespace btcheck::reference::space_quotient_cross_check_test {
namespace {

constexpr Equivalence kBoth[] = {Equivalence::Strong, Equivalence::Branching};
constexpr SeenAnswers kAllSeen[] = {SeenAnswers::OfRoot, SeenAnswers::OfLeaves,
                                    SeenAnswers::OfAll};

// "" for what is hidden. The names of locations say what a node answers.
std::string label_of(const Network& network, std::optional<std::uint32_t> step,
                     SeenAnswers seen) {
  static const std::set<std::string> kAnswers = {"success", "failure",
                                                 "running", "skipped", "error"};
  if (!step) return "time";
  const Automaton& owner = network.owner_of_edge(*step);
  const Edge& edge = network.edge(*step);
  if (owner.kind != AutomatonKind::Node) return "";
  const std::string& to = owner.target(edge).name;
  if (!kAnswers.contains(to) || kAnswers.contains(owner.source(edge).name)) {
    return "";
  }
  bool is_called = false;
  for (const Variable& variable : network.variables) {
    is_called |= variable.role == VariableRole::Caller && variable.owner &&
                 &network.automaton(*variable.owner) == &owner;
  }
  bool calls = false;
  for (const Location& location : owner.locations) {
    calls |= location.role == LocationRole::Called;
  }
  if (seen == SeenAnswers::OfRoot && is_called) return "";
  if (seen == SeenAnswers::OfLeaves && calls) return "";
  return owner.name + " -> " + to;
}

// Numbers for labels, shared by two graphs.
using Numbers = std::map<std::string, std::uint32_t>;

std::uint32_t number_of(Numbers& numbers, const std::string& label) {
  if (label.empty() || label == "i") return LabelledGraph::kSilent;
  const auto next = static_cast<std::uint32_t>(numbers.size() + 1);
  return numbers.try_emplace(label, next).first->second;
}

LabelledGraph graph_of(const Network& network, const NaiveSpace& space,
                       SeenAnswers seen, Numbers& numbers) {
  LabelledGraph graph;
  for (std::size_t s = 0; s < space.states.size(); ++s) {
    std::vector<LabelledGraph::Arc> arcs;
    for (const NaiveSpace::Step& step : space.steps[s]) {
      if (!step.edge && step.target == s) continue;  // an idle one
      arcs.push_back({number_of(numbers, label_of(network, step.edge, seen)),
                      static_cast<std::uint32_t>(step.target)});
    }
    graph.add_state(arcs);
  }
  return graph;
}

LabelledGraph renumbered(const SpaceQuotient& quotient, Numbers& numbers) {
  LabelledGraph graph;
  for (std::uint32_t s = 0; s < quotient.graph.size(); ++s) {
    std::vector<LabelledGraph::Arc> arcs;
    for (const LabelledGraph::Arc& arc : quotient.graph.arcs(s)) {
      arcs.push_back(
          {number_of(numbers, quotient.labels[arc.label]), arc.target});
    }
    graph.add_state(arcs);
  }
  return graph;
}

// Steps between blocks, each once. A hidden one within a block counts where its
// states can go on silently for ever among themselves, which every state of a
// block can or none.
std::size_t steps_between(const LabelledGraph& graph,
                          const Partition& partition, Equivalence equivalence) {
  const auto is_inert = [&](std::uint32_t s, const LabelledGraph::Arc& arc) {
    return equivalence == Equivalence::Branching &&
           arc.label == LabelledGraph::kSilent &&
           partition.block[s] == partition.block[arc.target];
  };
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> steps;
  // States that cannot go on for ever are taken away one by one.
  std::vector<std::uint32_t> left(graph.size(), 0);
  std::vector<std::vector<std::uint32_t>> into(graph.size());
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    for (const LabelledGraph::Arc& arc : graph.arcs(s)) {
      if (is_inert(s, arc)) {
        ++left[s];
        into[arc.target].push_back(s);
      } else {
        steps.emplace(partition.block[s], arc.label,
                      partition.block[arc.target]);
      }
    }
  }
  std::vector<std::uint32_t> ending;
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    if (left[s] == 0) ending.push_back(s);
  }
  while (!ending.empty()) {
    const std::uint32_t s = ending.back();
    ending.pop_back();
    for (const std::uint32_t from : into[s]) {
      if (--left[from] == 0) ending.push_back(from);
    }
  }
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    if (left[s] > 0) {
      steps.emplace(partition.block[s], LabelledGraph::kSilent,
                    partition.block[s]);
    }
  }
  return steps.size();
}

// How many quotients were smaller than the whole.
int compare(const Network& network, const NaiveSpace& space) {
  int smaller = 0;
  for (const SeenAnswers seen : kAllSeen) {
    for (const Equivalence equivalence : kBoth) {
      CAPTURE(static_cast<int>(seen));
      CAPTURE(static_cast<int>(equivalence));
      const SpaceQuotient found =
          quotient_of_space(network, equivalence, seen, {});
      REQUIRE(found.stopped == StopReason::None);
      REQUIRE(found.whole.states == space.states.size());
      REQUIRE(found.whole.transitions == space.transitions);
      Numbers numbers;
      const LabelledGraph whole = graph_of(network, space, seen, numbers);
      const Partition blocks = signature_partition(whole, equivalence);
      REQUIRE(found.graph.size() == blocks.blocks);
      REQUIRE(found.graph.arc_count() ==
              steps_between(whole, blocks, equivalence));
      // Nobody tells the two apart, and each state of one is one of the other.
      const LabelledGraph small = renumbered(found, numbers);
      const Partition both =
          signature_partition(beside(whole, small), equivalence);
      REQUIRE(both.blocks == blocks.blocks);
      REQUIRE(both.block[0] == both.block[whole.size()]);
      smaller += found.graph.size() < whole.size();
    }
  }
  return smaller;
}

}  // namespace

TEST_CASE("quotients of random trees are those of signatures") {
  int trees = 0;
  int smaller = 0;
  for_reduction_cases(97, by_effort(24, 300), [&](const ReductionCase& each) {
    if (each.space.states.size() > 400) return GoOn::Yes;
    CAPTURE(each.text);
    ++trees;
    smaller += compare(each.network, each.space);
    return GoOn::Yes;
  });
  CHECK_COVERED(trees >= 50);
  CHECK_COVERED(smaller > 3 * trees);
}

TEST_CASE("quotients of the examples are those of signatures") {
  int trees = 0;
  for (const std::string_view name : kExamples) {
    CAPTURE(name);
    const Network network = lower(tree_of(example(name)), TickSemantics::Root);
    const auto space =
        naive_space(network, by_effort<std::size_t>(2'000, 40'000));
    if (!space) continue;
    ++trees;
    compare(network, *space);
  }
  CHECK(trees >= 3);
}

}  // namespace btcheck::reference::space_quotient_cross_check_test
