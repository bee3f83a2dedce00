// SPDX-License-Identifier: MIT
//
// Numbers told apart by region against all their values.
//
// Random trees over numbers are lowered twice: with every value that a SetSV
// can measure, the space of which is written out naively, and with one for each
// region, which is searched. What both can reach must be the same but for the
// numbers themselves, and so must be every comparison in the tree and its
// rules; verdicts, default report and findings must be those of all values,
// under every reduction; and every run told must be a run over all values.
// Where a SetSV, or a number that moves by itself, is left with one value,
// there may be findings more.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check/questions/defaults.hpp"
#include "check/replay/replay.hpp"
#include "check/search/engine.hpp"
#include "model/lowering.hpp"
#include "model/sampling.hpp"
#include "model/tree/node_types.hpp"
#include "reference/effort.hpp"
#include "reference/naive_defaults.hpp"
#include "reference/naive_verdict.hpp"
#include "reference/random_property.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference::regions_cross_check_test {
namespace {

constexpr std::size_t kMostStates = 3000;
constexpr Reduction kReductions[] = {Reduction::None, Reduction::Live,
                                     Reduction::Full};

struct Census {
  int trees = 0;
  int skipped = 0;
  int split = 0;  // fewer states than with all values
  int properties = 0;
  int violated = 0;
  int runs = 0;
  int findings = 0;
  std::uint64_t states = 0;
  std::uint64_t left = 0;
};

// --- A run over all values -----------------------------------------------

bool are_same(const Edge& left, const Edge& right) {
  return left.source == right.source && left.target == right.target &&
         left.guard == right.guard && left.when == right.when &&
         std::ranges::equal(left.updates, right.updates,
                            [](const Assignment& one, const Assignment& other) {
                              return one.variable == other.variable &&
                                     one.value == other.value;
                            });
}

// The number of the edge of another network over the same automata.
std::optional<std::uint32_t> edge_in(const Network& whole,
                                     const Network& network,
                                     std::uint32_t edge) {
  const Automaton& owner = network.owner_of_edge(edge);
  const auto at = static_cast<std::size_t>(&owner - network.automata.data());
  const Automaton& other = whole.automata.at(at);
  const auto found =
      std::ranges::find_if(other.edges, [&](const Edge& candidate) {
        return are_same(candidate, network.edge(edge));
      });
  if (found == other.edges.end()) return std::nullopt;
  return other.first_edge +
         static_cast<std::uint32_t>(found - other.edges.begin());
}

std::string flaw_of_run(const Network& whole, const Network& network,
                        const Run& run) {
  const NetworkInterpreter interpreter(whole);
  Valuation state = interpreter.initial();
  if (state != run.initial) return "another beginning";
  for (const RunStep& step : run.steps) {
    Step taken = step.step;
    if (taken.edge != kTimeStep) {
      const auto edge = edge_in(whole, network, taken.edge);
      if (!edge) return "a step that the tree does not have";
      taken.edge = *edge;
    }
    const auto after = interpreter.taken(state, taken);
    if (!after || *after != step.after) return "a step that cannot be taken";
    state = *after;
  }
  const bool is_closed = run.loop == kNoLoop || state == run.state(run.loop);
  return is_closed ? "" : "a loop that does not close";
}

// --- What both can reach --------------------------------------------------

// All but the numbers, and how each condition comes out.
std::set<std::vector<int>> projection(const BehaviorTree& tree,
                                      const Network& network,
                                      const NaiveSpace& space,
                                      const std::vector<Expression>& asked) {
  std::set<std::vector<int>> found;
  std::vector<bool> is_number(network.variables.size());
  for (std::size_t v = 0; v < tree.variables.size(); ++v) {
    is_number[index(network.state_variable[v])] =
        !tree.variables[v].is_enumeration();
  }
  for (const NaiveState& state : space.states) {
    std::vector<int> seen = state.clocks;
    for (std::size_t v = 0; v < is_number.size(); ++v) {
      if (!is_number[v]) seen.push_back(state.values[v]);
    }
    for (const Expression& condition : asked) {
      seen.push_back(naive_value(condition, state) != 0 ? 1 : 0);
    }
    found.insert(std::move(seen));
  }
  return found;
}

std::vector<Expression> conditions_in(const Network& network,
                                      std::vector<Expression> asked) {
  for (const Automaton& automaton : network.automata) {
    for (const Edge& edge : automaton.edges) asked.push_back(edge.guard);
  }
  return asked;
}

// --- Comparing ---------------------------------------------------------------

class Comparison {
 public:
  Comparison(const BehaviorTree& tree, const SourceText& source,
             TickSemantics ticks, Census& census)
      : tree_(tree),
        source_(source),
        whole_(lower(tree, ticks)),
        census_(census) {}

  std::string flaw(SplitMix64& random) {
    space_ = naive_space(whole_, kMostStates);
    if (!space_) {
      ++census_.skipped;
      return {};
    }
    std::string wrong = flaw_of_defaults();
    return wrong.empty() ? flaw_of_rules(random) : wrong;
  }

 private:
  // Split as far as the tree and what is asked allow.
  Network split(Network network, const std::vector<Expression>& asked) const {
    REQUIRE(sample_regions(tree_, source_, asked, lowering(tree_, whole_.ticks),
                           network, 1)
                .empty());
    return network;
  }

  std::string flaw_of_space(const Network& network,
                            const std::vector<Expression>& asked) {
    const auto space = naive_space(network, kMostStates);
    if (!space) return "more states than with all values";
    census_.states += space_->states.size();
    census_.left += space->states.size();
    census_.split += space->states.size() < space_->states.size() ? 1 : 0;
    const std::vector<Expression> all = conditions_in(network, asked);
    return projection(tree_, whole_, *space_, all) ==
                   projection(tree_, network, *space, all)
               ? ""
               : "other states can be reached";
  }

  std::string flaw_of_defaults() {
    const Network network =
        split(lower_to_bind(tree_, lowering(tree_, whole_.ticks), 1), {});
    std::string wrong = flaw_of_space(network, {});
    const CompiledNetwork system(network);
    const CompiledNetwork all(whole_);
    for (const Reduction reduction : kReductions) {
      if (!wrong.empty()) return wrong;
      const DefaultReport report =
          check_defaults(tree_, system, reduction, Limits{});
      wrong = flaw_of_report(network, report);
      if (!wrong.empty() || reduction != Reduction::None) continue;
      wrong = flaw_of_findings(network, report,
                               check_defaults(tree_, all, reduction, Limits{}));
    }
    return wrong;
  }

  std::string flaw_of_report(const Network& network,
                             const DefaultReport& report) {
    if (!report.error.empty()) return report.error;
    for (const TreeReport& answer : report.tree) {
      const bool holds = answer.verdict == Verdict::Holds;
      if (holds != naive_answer(tree_, whole_, *space_, answer.question)) {
        return fmt::format("tree question {}",
                           static_cast<int>(answer.question));
      }
      const std::string wrong = flaw_of_kept(network, answer.run);
      if (!wrong.empty()) return wrong;
    }
    for (const NodeReport& node : report.nodes) {
      for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
        const bool holds = node.answers[q].verdict == Verdict::Holds;
        if (holds != naive_answer(whole_, *space_, node.node,
                                  static_cast<NodeQuestion>(q))) {
          return fmt::format("{} {}", unique_name(tree_, node.node),
                             kNodeQuestionNames[q]);
        }
        const std::string wrong = flaw_of_kept(network, node.answers[q].run);
        if (!wrong.empty()) return wrong;
      }
    }
    return {};
  }

  std::string flaw_of_kept(const Network& network,
                           const std::optional<KeptRun>& run) {
    if (!run) return {};
    ++census_.runs;
    return flaw_of_run(whole_, network, run->told());
  }

  // A choice between values of one region is none: what follows from what is
  // seen more often.
  bool measures_one_value(const Network& network) const {
    const auto results = [](const Automaton& leaf) {
      return std::ranges::count_if(leaf.edges, [&](const Edge& edge) {
        return leaf.target(edge).role == LocationRole::Success;
      });
    };
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      if (tree_.nodes[n].type != NodeType::SetSV) continue;
      if (results(network.automaton(NodeId{n})) > 1) continue;
      if (results(whole_.automaton(NodeId{n})) > 1) return true;
    }
    for (std::size_t v = 0; v < tree_.variables.size(); ++v) {
      if (tree_.variables[v].is_enumeration()) continue;
      const auto automaton = network.state_automaton[v];
      if (automaton && network.automaton(*automaton).edges.size() < 2) {
        return true;
      }
    }
    return false;
  }

  std::string flaw_of_findings(const Network& network,
                               const DefaultReport& found,
                               const DefaultReport& expected) {
    const auto known = [](const DefaultReport& report) {
      std::set<std::tuple<std::string, NodeId, std::string>> all;
      for (const TreeFinding& each : report.findings) {
        all.emplace(each.code, each.node, each.message);
      }
      return all;
    };
    census_.findings += static_cast<int>(found.findings.size());
    const auto here = known(found);
    const auto there = known(expected);
    const bool are_same = measures_one_value(network)
                              ? std::ranges::includes(here, there)
                              : here == there;
    return are_same ? "" : "other findings";
  }

  std::string flaw_of_rules(SplitMix64& random) {
    PropertyWeights weights;
    const std::size_t states = space_->states.size();
    weights.most_temporal = states < 100 ? 3 : states < 800 ? 2 : 1;
    weights.response = whole_.ticks != TickSemantics::None && states < 500;
    weights.timed = whole_.ticks != TickSemantics::None && states < 300;
    weights.branching = states < 300;
    std::vector<RandomProperty> properties;
    std::string text;
    for (int i = 0; i < 4; ++i) {
      properties.push_back(random_property(tree_, whole_, random, weights));
      text += fmt::format("property p{} : {}\n", i, properties.back().body);
    }
    const auto file = read_properties("random.ltl", text);
    if (!file.value) return "cannot be read\n" + text;
    Network network = lower_to_bind(tree_, lowering(tree_, whole_.ticks), 1);
    const auto bound =
        bind_properties(tree_, network, *file.value, {"random.ltl", text},
                        ExtraAssumption::None);
    if (!bound.value) return "cannot be bound\n" + text;
    network = split(std::move(network), bound.value->atoms);
    std::string wrong = flaw_of_space(network, bound.value->atoms);
    for (const Reduction reduction : kReductions) {
      if (!wrong.empty()) break;
      wrong = flaw_of_verdicts(network, *bound.value, reduction, properties);
    }
    return wrong.empty() ? wrong : wrong + "\n" + text;
  }

  std::string flaw_of_verdicts(const Network& network, const BoundFile& bound,
                               Reduction reduction,
                               const std::vector<RandomProperty>& properties) {
    const CompiledNetwork system(network);
    const auto verdicts =
        verify(system, bound, {SearchOrder::BreadthFirst, reduction}, Limits{})
            .verdicts;
    for (std::size_t i = 0; i < properties.size(); ++i) {
      const auto expected =
          naive_verdict(tree_, whole_, *space_, properties[i]);
      if (!expected) continue;
      const PropertyVerdict& found = verdicts.at(i);
      if (!found.error.empty()) return found.error;
      ++census_.properties;
      census_.violated += found.verdict == Verdict::Violated ? 1 : 0;
      if ((found.verdict == Verdict::Holds) != expected->holds) {
        return fmt::format("p{} with reduction {}: naively {}", i,
                           static_cast<int>(reduction),
                           expected->holds ? "holds" : "violated");
      }
      if (!found.run) continue;
      ++census_.runs;
      const std::string wrong = flaw_of_run(whole_, network, *found.run);
      if (!wrong.empty()) return fmt::format("the run of p{}: {}", i, wrong);
    }
    return {};
  }

  const BehaviorTree& tree_;
  const SourceText& source_;
  Network whole_;
  std::optional<NaiveSpace> space_;
  Census& census_;
};

std::string flaw_of(const std::string& text, std::uint64_t seed,
                    Census& census) {
  const auto tree = read_btf("random.btf", text);
  if (!tree.value) return {};
  const SourceText source("random.btf", text);
  SplitMix64 random(seed);
  constexpr TickSemantics kTicks[] = {
      TickSemantics::Root, TickSemantics::Leaves, TickSemantics::None};
  return Comparison(*tree.value, source, kTicks[seed % 3], census).flaw(random);
}

RandomTreeWeights trees_of_numbers(std::uint64_t seed) {
  RandomTreeWeights weights;
  weights.max_nodes = 7;
  weights.max_running = 2;
  weights.number = 90;
  weights.most_number = 9;
  weights.computed = 10 + static_cast<int>(seed % 3) * 25;
  weights.leaving_range = 60;
  weights.looping_root = 60;
  weights.contract = 40;
  weights.moving_number = seed % 2 == 0 ? 40 : 0;
  weights.decided = 30;
  return weights;
}

}  // namespace

TEST_CASE("numbers told apart by region answer as all their values do") {
  const std::uint64_t first = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(120, 5000);
  Census census;
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t seed = first * 1'000'003 + i;
    const std::string text = random_tree(seed, trees_of_numbers(seed));
    REQUIRE(read_btf("random.btf", text).value.has_value());
    ++census.trees;
    const std::string wrong = flaw_of(text, seed, census);
    if (wrong.empty()) continue;
    const std::string small = shrink(text, [&](const std::string& candidate) {
      Census other;
      const std::string found = flaw_of(candidate, seed, other);
      return !found.empty() && !found.starts_with("cannot be");
    });
    Census other;
    FAIL("seed ", seed, "\n", text, wrong, "\nand after shrinking\n", small,
         flaw_of(small, seed, other));
  }
  MESSAGE(census.trees << " trees, " << census.skipped << " too large; "
                       << census.split << " spaces smaller, " << census.left
                       << " of " << census.states << " states; "
                       << census.properties << " verdicts, " << census.violated
                       << " violated; " << census.runs << " runs, "
                       << census.findings << " findings");
  CHECK_COVERED(census.split > census.trees / 4);
  CHECK_COVERED(census.violated > census.trees / 2);
}

}  // namespace btcheck::reference::regions_cross_check_test
