// SPDX-License-Identifier: MIT
//
// Both trees are searched, what is seen of them stands side by side in one
// graph, and its coarsest partition says whether their first states are the
// same: branching bisimilarity that preserves divergence (van Glabbeek, Luttik
// and Trčka 2009). What neither caller nor world can see, the order in which
// nodes call each other for instance, makes no difference.
#include "check/diff/diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "check/bind/node_names.hpp"
#include "explore/minimise/partition.hpp"
#include "explore/state/spent.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kLeaves = "leaves";
constexpr std::string_view kRoot = "root";

BehaviorTree called_by(Caller caller, const BehaviorTree& tree) {
  BehaviorTree called = tree;
  if (caller == Caller::Once) return called;
  for (const NodeId root : called.roots) {
    Node& node = called.nodes[index(root)];
    node.loop = true;
    node.option = true;  // its caller may halt it
  }
  return called;
}

// What is seen of both, or who is not known.
Result<std::vector<WatchedPair>> watched_in(const BehaviorTree& one,
                                            const BehaviorTree& other,
                                            std::vector<std::string> observe) {
  Result<std::vector<WatchedPair>> result;
  std::vector<WatchedPair>& watched = result.value.emplace();
  for (std::size_t i = 0; i < std::max(one.roots.size(), other.roots.size());
       ++i) {
    WatchedPair& root = watched.emplace_back();
    root.is_root = true;
    if (i < one.roots.size()) root.nodes.one = one.roots[i];
    if (i < other.roots.size()) root.nodes.other = other.roots[i];
  }
  if (observe.empty()) observe.emplace_back(kLeaves);
  std::vector<NodeId> of_one;
  std::vector<NodeId> of_other;
  const auto add = [](std::vector<NodeId>& to,
                      const std::vector<NodeId>& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  for (const std::string& what : observe) {
    if (what == kRoot) continue;
    if (what == kLeaves) {
      add(of_one, leaves_of_world(one));
      add(of_other, leaves_of_world(other));
      continue;
    }
    const NodeNames names(one);
    const NodeNames others(other);
    const auto here = names.called(what);
    const auto there = others.called(what);
    if (here.empty() && there.empty()) {
      Diagnostic diagnostic;
      diagnostic.code = "BT0001";
      diagnostic.file = one.file;
      diagnostic.message =
          fmt::format("no node is called `{}`, to be observed", what);
      diagnostic.help = names.nearest_help(what);
      result.diagnostics.push_back(std::move(diagnostic));
    }
    add(of_one, here);
    add(of_other, there);
  }
  if (!result.diagnostics.empty()) {
    result.value.reset();
    return result;
  }
  const auto sorted = [](const BehaviorTree& tree, std::vector<NodeId>& nodes) {
    std::erase_if(nodes,
                  [&](NodeId node) { return tree.node(node).is_root(); });
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  };
  sorted(one, of_one);
  sorted(other, of_other);
  for (const NodePair& pair : paired(one, of_one, other, of_other)) {
    WatchedPair each{pair, false, {}};
    if (pair.one && pair.other) {
      each.otherwise = told_otherwise(one, *pair.one, other, *pair.other);
    }
    watched.push_back(std::move(each));
  }
  return result;
}

std::vector<std::optional<std::uint32_t>> numbers_in(
    const BehaviorTree& tree, const std::vector<WatchedPair>& watched,
    std::optional<NodeId> NodePair::*side) {
  std::vector<std::optional<std::uint32_t>> numbers(tree.nodes.size());
  for (std::uint32_t n = 0; n < watched.size(); ++n) {
    const auto node = watched[n].nodes.*side;
    if (node) numbers[index(*node)] = n;
  }
  return numbers;
}

std::vector<SeenEvent> events_of(const std::vector<std::uint32_t>& labels) {
  std::vector<SeenEvent> events;
  for (const std::uint32_t label : labels) events.emplace_back(label);
  return events;
}

// What is seen of one tree.
struct Seen {
  std::vector<std::optional<std::uint32_t>> numbers;
  std::unique_ptr<AnswerGraph> answers;
  std::unique_ptr<SeenGraph> graph;
};

class TreeComparison {
 public:
  TreeComparison(const DiffOptions& options, Diff& diff)
      : options_(options), diff_(diff) {}

  void compare() {
    const Stage stage("the trees were compared");
    if (!search(0, &NodePair::one) || !search(1, &NodePair::other)) return;
    const LabelledGraph first = seen_[0].graph->fair();
    const LabelledGraph both = beside(first, seen_[1].graph->fair());
    const auto second = static_cast<std::uint32_t>(first.size());
    const Partition partition =
        coarsest_partition(both, Equivalence::Branching);
    diff_.classes = partition.blocks;
    const LabelledGraph small =
        quotient(both, partition, Equivalence::Branching);
    if (partition.block[0] == partition.block[second]) {
      find_told_otherwise(small);
    } else {
      find_difference(small, partition.block[0], partition.block[second]);
    }
    show();
  }

 private:
  // Whether all states are known.
  bool search(std::size_t side, std::optional<NodeId> NodePair::*of) {
    DiffSide& own = diff_.sides[side];
    Seen& seen = seen_[side];
    Limits limits = options_.limits;
    // The states of both count.
    const std::uint64_t before = diff_.sides[0].states;
    limits.max_states -= std::min(limits.max_states, before);
    seen.answers = std::make_unique<AnswerGraph>(own.tree, own.network, limits,
                                                 exact_reduction(own.network));
    own.states = seen.answers->size();
    diff_.stopped = seen.answers->stopped();
    // The search looks at its limit now and then only.
    if (diff_.stopped == StopReason::None && own.states > limits.max_states) {
      diff_.stopped = StopReason::MaxStates;
    }
    if (diff_.stopped != StopReason::None) return false;
    seen.numbers = numbers_in(own.tree, diff_.watched, of);
    seen.graph = std::make_unique<SeenGraph>(*seen.answers, seen.numbers);
    return true;
  }

  void find_difference(const LabelledGraph& graph, std::uint32_t first,
                       std::uint32_t second) {
    Difference found;
    const TraceComparison traces = compare_traces(graph, first, second);
    if (traces.difference) {
      const TraceDifference& of_runs = *traces.difference;
      found.run = events_of(of_runs.labels);
      found.end = of_runs.end;
      found.side = of_runs.is_of_first ? 0 : 1;
      found.instead = events_of(of_runs.instead);
      found.other_stops = of_runs.other_stops;
      found.other_unseen = of_runs.other_unseen;
    } else {
      // Where it is not known whether there is such a run, a play tells them
      // apart all the same.
      found.kind = Difference::Kind::Choices;
      found.play = distinguishing_play(graph, first, second);
    }
    diff_.difference = std::move(found);
  }

  // A shortest run to a leaf that is told something else. State 0 is where both
  // begin.
  void find_told_otherwise(const LabelledGraph& graph) {
    struct Reached {
      std::uint32_t state = 0;
      std::uint32_t from = 0;
      std::uint32_t label = LabelledGraph::kSilent;
    };
    std::vector<Reached> reached = {{}};
    std::vector<bool> known(graph.size());
    known[0] = true;
    for (std::uint32_t i = 0; i < reached.size(); ++i) {
      for (const LabelledGraph::Arc& arc : graph.arcs(reached[i].state)) {
        const bool is_told = is_told_otherwise(arc.label);
        if (known[arc.target] && !is_told) continue;
        known[arc.target] = true;
        reached.push_back({arc.target, i, arc.label});
        if (!is_told) continue;
        Difference found;
        found.kind = Difference::Kind::Told;
        for (auto at = static_cast<std::uint32_t>(reached.size() - 1); at != 0;
             at = reached[at].from) {
          if (reached[at].label == LabelledGraph::kSilent) continue;
          found.run.emplace_back(reached[at].label);
        }
        std::ranges::reverse(found.run);
        diff_.difference = std::move(found);
        return;
      }
    }
  }
  bool is_told_otherwise(std::uint32_t label) const {
    if (label == LabelledGraph::kSilent) return false;
    const SeenEvent event(label);
    return event != kThrown && event.what() == Happening::Asked &&
           !diff_.watched[event.number()].otherwise.empty();
  }

  // The runs of both, executed again.
  void show() {
    if (!diff_.difference ||
        diff_.difference->kind == Difference::Kind::Choices) {
      return;
    }
    const Difference& found = *diff_.difference;
    for (std::size_t side = 0; side < 2; ++side) {
      std::vector<SeenEvent> events = found.run;
      const bool has_all = found.kind == Difference::Kind::Told ||
                           found.end != TraceEnd::Seen || found.side == side;
      if (!has_all) events.pop_back();
      const auto arcs = seen_[side].graph->run_of(events);
      if (!arcs) {
        diff_.error = "a run that differs is none";
        continue;
      }
      std::string error;
      diff_.sides[side].steps = seen_[side].answers->steps_along(*arcs, error);
      if (!error.empty()) diff_.error = std::move(error);
    }
  }

  const DiffOptions& options_;
  Diff& diff_;
  std::array<Seen, 2> seen_;
};

}  // namespace

Result<Diff> compare_trees(const DiffTree& one, const DiffTree& other,
                           const DiffOptions& options) {
  Result<Diff> result;
  Diff& diff = result.value.emplace();
  auto watched = watched_in(one.tree, other.tree, options.observe);
  if (!watched.value) return {std::nullopt, std::move(watched.diagnostics)};
  diff.watched = std::move(*watched.value);
  const DiffTree* const inputs[] = {&one, &other};
  for (std::size_t side = 0; side < 2; ++side) {
    DiffSide& own = diff.sides[side];
    own.tree = called_by(options.caller, inputs[side]->tree);
    auto network = lower_regions(own.tree, inputs[side]->source, options.ticks);
    result.diagnostics.insert(result.diagnostics.end(),
                              network.diagnostics.begin(),
                              network.diagnostics.end());
    if (!network.value) {
      result.value.reset();
      return result;
    }
    own.network = std::move(*network.value);
  }
  try {
    TreeComparison(options, diff).compare();
  } catch (const BudgetSpent& spent) {
    diff.stopped = stop_reason(spent.spent());
  }
  return result;
}

}  // namespace btcheck
