// SPDX-License-Identifier: MIT
#include "explore/minimise/difference.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "text/budget.hpp"

namespace btcheck {
namespace {

using States = std::vector<std::uint32_t>;  // in order, each once

// By state: whether it can go on silently for ever. Those that cannot are taken
// away one by one, from the ends.
std::vector<bool> endless_states(const LabelledGraph& graph) {
  std::vector<std::uint32_t> ways(graph.size(), 0);
  std::vector<States> from(graph.size());
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    ask_budget();
    for (const LabelledGraph::Arc& arc : graph.arcs(s)) {
      if (arc.label != LabelledGraph::kSilent) continue;
      ++ways[s];
      from[arc.target].push_back(s);
    }
  }
  States ending;
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    if (ways[s] == 0) ending.push_back(s);
  }
  std::vector<bool> is_endless(graph.size(), true);
  while (!ending.empty()) {
    ask_budget();
    const std::uint32_t s = ending.back();
    ending.pop_back();
    is_endless[s] = false;
    for (const std::uint32_t before : from[s]) {
      if (--ways[before] == 0) ending.push_back(before);
    }
  }
  return is_endless;
}

class RunComparison {
 public:
  RunComparison(const LabelledGraph& graph, std::size_t most)
      : graph_(graph), is_endless_(endless_states(graph)), most_(most) {}

  ComparedRuns compare(std::uint32_t first, std::uint32_t second) {
    add({closed({first}), closed({second})}, 0, LabelledGraph::kSilent);
    for (std::size_t next = 0; next < reached_.size(); ++next) {
      if (auto found = difference_at(next)) return {std::move(found), true};
      for (const std::uint32_t label : labels_at(next)) {
        if (reached_.size() >= most_) return {std::nullopt, false};
        const Pair& pair = *reached_[next].pair;
        add({after(pair.first, label), after(pair.second, label)}, next, label);
      }
    }
    return {};
  }

 private:
  using Pair = std::pair<States, States>;
  struct Reached {
    const Pair* pair = nullptr;  // in known_
    std::size_t before = 0;      // the first: itself
    std::uint32_t label = LabelledGraph::kSilent;
  };

  void add(Pair pair, std::size_t before, std::uint32_t label) {
    const auto [at, is_new] = known_.insert(std::move(pair));
    if (is_new) reached_.push_back({&*at, before, label});
  }

  // With all that is reached from there silently.
  States closed(States states) const {
    std::set<std::uint32_t> all(states.begin(), states.end());
    while (!states.empty()) {
      ask_budget();
      const std::uint32_t s = states.back();
      states.pop_back();
      for (const LabelledGraph::Arc& arc : graph_.arcs(s)) {
        if (arc.label == LabelledGraph::kSilent &&
            all.insert(arc.target).second) {
          states.push_back(arc.target);
        }
      }
    }
    return {all.begin(), all.end()};
  }

  States after(const States& states, std::uint32_t label) const {
    States targets;
    for (const std::uint32_t s : states) {
      for (const LabelledGraph::Arc& arc : graph_.arcs(s)) {
        if (arc.label == label) targets.push_back(arc.target);
      }
    }
    return closed(std::move(targets));
  }

  std::set<std::uint32_t> labels_at(std::size_t place) const {
    std::set<std::uint32_t> labels;
    const Pair& pair = *reached_[place].pair;
    for (const States* states : {&pair.first, &pair.second}) {
      for (const std::uint32_t s : *states) {
        for (const LabelledGraph::Arc& arc : graph_.arcs(s)) {
          if (arc.label != LabelledGraph::kSilent) labels.insert(arc.label);
        }
      }
    }
    return labels;
  }

  std::optional<RunDifference> difference_at(std::size_t place) const {
    const auto& [first, second] = *reached_[place].pair;
    const auto run = [&](bool is_of_first, DifferenceEnd end) {
      return RunDifference{is_of_first, labels_up_to(place), end};
    };
    if (second.empty()) return run(true, DifferenceEnd::Step);
    if (first.empty()) return run(false, DifferenceEnd::Step);
    const auto stops = [&](const States& states) {
      return std::ranges::any_of(
          states, [&](std::uint32_t s) { return graph_.arcs(s).empty(); });
    };
    if (stops(first) != stops(second))
      return run(stops(first), DifferenceEnd::Stop);
    const auto is_silent = [&](const States& states) {
      return std::ranges::any_of(
          states, [&](std::uint32_t s) { return is_endless_[s]; });
    };
    if (is_silent(first) != is_silent(second)) {
      return run(is_silent(first), DifferenceEnd::Silence);
    }
    return std::nullopt;
  }

  std::vector<std::uint32_t> labels_up_to(std::size_t place) const {
    std::vector<std::uint32_t> labels;
    for (; place != 0; place = reached_[place].before) {
      labels.push_back(reached_[place].label);
    }
    std::ranges::reverse(labels);
    return labels;
  }

  const LabelledGraph& graph_;
  std::vector<bool> is_endless_;
  std::size_t most_;
  std::set<Pair> known_;
  std::vector<Reached> reached_;  // breadth first
};

}  // namespace

ComparedRuns compare_runs(const LabelledGraph& graph, std::uint32_t first,
                          std::uint32_t second, std::size_t most) {
  return RunComparison(graph, most).compare(first, second);
}

}  // namespace btcheck
