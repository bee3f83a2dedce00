// SPDX-License-Identifier: MIT
//
// `btcheck diff` on random pairs against bisimulation by signatures over every
// state that there is, written out: no reduction, no quotient, no components.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check/diff/diff.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree_file.hpp"
#include "reference/effort.hpp"
#include "reference/naive_bisimulation.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_tree.hpp"
#include "reference/random_xml_tree.hpp"

namespace btcheck::reference::diff_cross_check_test {
namespace {

constexpr std::size_t kMostStates = 300;
constexpr std::array kProfiles = {Profile::Btcpp38, Profile::Btcpp4,
                                  Profile::Nav2Humble, Profile::Nav2Jazzy,
                                  Profile::Nav2Main};
constexpr std::uint32_t kHidden = LabelledGraph::kSilent;
constexpr std::uint32_t kStops = 0xfffffffd;  // of completed runs
constexpr std::uint32_t kGoesOn = 0xfffffffe;

std::optional<BehaviorTree> read(const std::string& text,
                                 std::optional<Profile> profile) {
  TreeReading reading;
  reading.profile = profile;
  auto tree = read_tree(profile ? "t.xml" : "t.btf", FileText(text), reading);
  return std::move(tree.value);
}

struct Labelled {
  std::vector<std::vector<LabelledGraph::Arc>> arcs;

  std::uint32_t add() {
    arcs.emplace_back();
    return static_cast<std::uint32_t>(arcs.size() - 1);
  }
};

// Every state, and what is seen of each step.
std::optional<Labelled> labelled(const Diff& diff, std::size_t side) {
  const Network& network = diff.sides[side].network;
  const auto space = naive_space(network, kMostStates);
  if (!space) return std::nullopt;
  std::map<NodeId, std::uint32_t> number;
  for (std::uint32_t n = 0; n < diff.watched.size(); ++n) {
    const NodePair& nodes = diff.watched[n].nodes;
    if (const auto node = side == 0 ? nodes.one : nodes.other) {
      number[*node] = n;
    }
  }
  const NaiveNetwork naive(network);
  Labelled graph;
  graph.arcs.resize(space->states.size());
  std::vector<std::vector<std::uint32_t>> silent(space->states.size());
  std::set<std::pair<std::uint32_t, std::uint32_t>> progress;
  for (std::uint32_t s = 0; s < space->states.size(); ++s) {
    for (const NaiveSpace::Step& step : space->steps[s]) {
      const auto target = static_cast<std::uint32_t>(step.target);
      if (!step.edge && target == s) continue;  // idle
      std::vector<std::uint32_t> labels;
      if (step.edge) {
        const Automaton& owner = network.owner_of_edge(*step.edge);
        const auto role = owner.target(network.edge(*step.edge)).role;
        const auto what = shown_as(role);
        const auto known = number.find(owner.node);
        if (owner.kind == AutomatonKind::Node && what &&
            known != number.end()) {
          labels.push_back(SeenEvent(known->second, *what).label());
        }
      }
      if (naive.is_faulty(space->states[target]) &&
          !naive.is_faulty(space->states[s])) {
        labels.push_back(kThrown.label());
      }
      if (labels.empty()) {
        silent[s].push_back(target);
        if (step.progress) progress.insert({s, target});
        continue;
      }
      std::uint32_t at = s;
      for (std::size_t i = 0; i + 1 < labels.size(); ++i) {
        const std::uint32_t next = graph.add();
        graph.arcs[at].push_back({labels[i], next});
        at = next;
      }
      graph.arcs[at].push_back({labels.back(), target});
    }
  }
  // Who reaches whom silently; states that reach each other are one, of which
  // some step of progress goes round, or none.
  std::vector<std::vector<bool>> reach(silent.size());
  for (std::uint32_t s = 0; s < silent.size(); ++s) {
    reach[s].resize(silent.size());
    reach[s][s] = true;
    std::vector<std::uint32_t> open = {s};
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      for (const std::uint32_t to : silent[at]) {
        if (reach[s][to]) continue;
        reach[s][to] = true;
        open.push_back(to);
      }
    }
  }
  std::vector<std::uint32_t> same(graph.arcs.size());
  for (std::uint32_t s = 0; s < same.size(); ++s) {
    same[s] = s;
    for (std::uint32_t t = 0; t < s && s < silent.size(); ++t) {
      if (reach[s][t] && reach[t][s]) {
        same[s] = t;
        break;
      }
    }
  }
  Labelled merged;
  merged.arcs.resize(graph.arcs.size());
  for (std::uint32_t s = 0; s < graph.arcs.size(); ++s) {
    auto& arcs = merged.arcs[same[s]];
    for (const auto& arc : graph.arcs[s]) {
      arcs.push_back({arc.label, same[arc.target]});
    }
    if (s >= silent.size()) continue;
    for (const std::uint32_t to : silent[s]) {
      if (same[to] != same[s] || progress.contains({s, to})) {
        arcs.push_back({kHidden, same[to]});
      }
    }
  }
  return merged;
}

LabelledGraph graph_of(const Labelled& labelled) {
  LabelledGraph graph;
  for (const auto& arcs : labelled.arcs) graph.add_state(arcs);
  return graph;
}

using States = std::set<std::uint32_t>;

States closed(const Labelled& graph, States states) {
  std::vector<std::uint32_t> open(states.begin(), states.end());
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    for (const auto& arc : graph.arcs[at]) {
      if (arc.label == kHidden && states.insert(arc.target).second) {
        open.push_back(arc.target);
      }
    }
  }
  return states;
}

// What may be seen next, and where that leads to.
std::map<std::uint32_t, States> next_of(const Labelled& graph,
                                        const States& states) {
  std::map<std::uint32_t, States> next;
  for (const std::uint32_t s : states) {
    if (graph.arcs[s].empty()) next[kStops];
    for (const auto& arc : graph.arcs[s]) {
      if (arc.label != kHidden) {
        next[arc.label].insert(arc.target);
      } else if (arc.target == s) {
        next[kGoesOn];
      }
    }
  }
  for (auto& [label, to] : next) to = closed(graph, std::move(to));
  return next;
}

bool has_run(const Labelled& graph, const std::vector<std::uint32_t>& labels) {
  States at = closed(graph, {0});
  for (const std::uint32_t label : labels) {
    auto next = next_of(graph, at);
    const auto found = next.find(label);
    if (found == next.end()) return false;
    at = found->second;
  }
  return true;
}

// The length of a shortest run that one has alone; nothing where there is none.
std::optional<std::size_t> first_difference(const Labelled& one,
                                            const Labelled& other) {
  std::set<std::pair<States, States>> known;
  std::vector<std::pair<States, States>> open = {
      {closed(one, {0}), closed(other, {0})}};
  for (std::size_t depth = 0; !open.empty(); ++depth) {
    std::vector<std::pair<States, States>> next;
    for (const auto& pair : open) {
      if (!known.insert(pair).second) continue;
      const auto here = next_of(one, pair.first);
      const auto there = next_of(other, pair.second);
      const auto keys = [](const auto& of) {
        std::set<std::uint32_t> all;
        for (const auto& [label, to] : of) all.insert(label);
        return all;
      };
      if (keys(here) != keys(there)) return depth;
      for (const auto& [label, to] : here) {
        next.emplace_back(to, there.at(label));
      }
    }
    open = std::move(next);
  }
  return std::nullopt;
}

// A node answers as one of another type would.
void mutate(BehaviorTree& tree, SplitMix64& random) {
  static constexpr std::array kRows = {NodeType::Sequence, NodeType::Fallback,
                                       NodeType::ReactiveSequence,
                                       NodeType::ReactiveFallback};
  static constexpr std::array kSingles = {
      NodeType::Inverter, NodeType::ForceSuccess, NodeType::ForceFailure};
  std::vector<Node*> nodes;
  const auto is_one_of = [](const Node& node, const auto& types) {
    return std::ranges::find(types, node.type) != types.end();
  };
  for (Node& node : tree.nodes) {
    if (is_one_of(node, kRows) || is_one_of(node, kSingles)) {
      nodes.push_back(&node);
    }
  }
  if (nodes.empty()) return;
  Node& node = *nodes[static_cast<std::size_t>(
      random.below(static_cast<int>(nodes.size())))];
  node.type =
      is_one_of(node, kRows)
          ? kRows[static_cast<std::size_t>(random.below(kRows.size()))]
          : kSingles[static_cast<std::size_t>(random.below(kSingles.size()))];
}

struct Census {
  int pairs = 0;
  int equivalent = 0;
  int runs = 0;
  int choices = 0;
  int ends = 0;
};

std::vector<std::uint32_t> labels_of(const std::vector<SeenEvent>& events) {
  std::vector<std::uint32_t> labels;
  for (const SeenEvent& event : events) labels.push_back(event.label());
  return labels;
}

void check_runs(const Difference& found,
                const std::array<const Labelled*, 2>& graphs) {
  std::vector<std::uint32_t> labels = labels_of(found.run);
  if (found.end == TraceEnd::Stops) labels.push_back(kStops);
  if (found.end == TraceEnd::Unseen) labels.push_back(kGoesOn);
  REQUIRE(has_run(*graphs[found.side], labels));
  REQUIRE(!has_run(*graphs[1 - found.side], labels));
  labels.pop_back();
  REQUIRE(has_run(*graphs[1 - found.side], labels));
  REQUIRE(first_difference(*graphs[0], *graphs[1]) == labels.size());
}

void check_pair(const BehaviorTree& one, const BehaviorTree& other,
                const DiffOptions& options, Census& census) {
  const SourceText nowhere("t", FileText(""));
  auto compared = compare_trees({one, nowhere}, {other, nowhere}, options);
  REQUIRE(compared.value);
  const Diff& diff = *compared.value;
  REQUIRE(diff.stopped == StopReason::None);
  REQUIRE(diff.error == "");
  const auto here = labelled(diff, 0);
  const auto there = labelled(diff, 1);
  if (!here || !there) return;
  ++census.pairs;
  const LabelledGraph first = graph_of(*here);
  const Partition partition = signature_partition(
      beside(first, graph_of(*there)), Equivalence::Branching);
  const bool is_same = partition.block[0] == partition.block[first.size()];
  const bool is_told =
      diff.difference && diff.difference->kind == Difference::Kind::Told;
  REQUIRE((!diff.difference || is_told) == is_same);
  census.equivalent += is_same;
  if (is_same) return;
  const Difference& found = *diff.difference;
  if (found.kind == Difference::Kind::Runs) {
    check_runs(found, {&*here, &*there});
    ++census.runs;
    census.ends += found.end != TraceEnd::Seen;
  } else {
    REQUIRE(!first_difference(*here, *there));
    REQUIRE(!found.play.empty());
    const auto last = found.play.back().kind;
    REQUIRE((last == PlayRound::Kind::Wins || last == PlayRound::Kind::Stays));
    ++census.choices;
  }
}

DiffOptions some_options(SplitMix64& random) {
  DiffOptions options;
  options.caller = random.percent(70) ? Caller::Any : Caller::Once;
  options.observe = {random.percent(60) ? "leaves" : "root"};
  return options;
}

}  // namespace

TEST_CASE("pairs of random trees are what every state of theirs says") {
  Census xml;
  Census btf;
  const int wanted = by_effort(100, 1000);
  SplitMix64 random(shifted_seed(4711));
  const auto pair_up = [&](auto text_of, std::optional<Profile> profile,
                           Census& census) {
    const std::uint64_t seed = random.next();
    auto one = read(text_of(seed), profile);
    if (!one) return;
    std::optional<BehaviorTree> other = one;
    if (random.percent(15)) other = read(text_of(seed + 1), profile);
    if (!other) return;
    if (random.percent(85)) mutate(*other, random);
    CAPTURE(text_of(seed));
    CAPTURE(seed);
    check_pair(*one, *other, some_options(random), census);
  };
  for (int i = 0; i < 40 * wanted && xml.pairs < wanted; ++i) {
    const Profile profile =
        kProfiles[static_cast<std::size_t>(i) % kProfiles.size()];
    pair_up([&](std::uint64_t seed) { return random_xml_tree(seed, profile); },
            profile, xml);
  }
  for (int i = 0; i < 40 * wanted && btf.pairs < wanted; ++i) {
    RandomTreeWeights weights;
    weights.max_nodes = 6;
    weights.contract = 40;
    pair_up([&](std::uint64_t seed) { return random_tree(seed, weights); },
            std::nullopt, btf);
  }
  for (const Census* each : {&xml, &btf}) {
    MESSAGE(each->pairs << " pairs, " << each->equivalent << " equivalent, "
                        << each->runs << " by a run (" << each->ends
                        << " by its end), " << each->choices << " by choices");
    CHECK_COVERED(each->pairs == wanted);
    CHECK_COVERED(each->equivalent > wanted / 10);
    CHECK_COVERED(each->runs > wanted / 10);
  }
  CHECK_COVERED(xml.choices + btf.choices > 0);
}

}  // namespace btcheck::reference::diff_cross_check_test
