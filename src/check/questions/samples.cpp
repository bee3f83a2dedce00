// SPDX-License-Identifier: MIT
#include "check/questions/samples.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace btcheck {
namespace {

constexpr std::size_t kLong = std::size_t{1} << 17;
constexpr std::size_t kMostSteps = std::size_t{1} << 16;

// By edge: a leaf succeeds.
std::vector<bool> successes(const BehaviorTree& tree, const Network& network) {
  std::vector<bool> found(network.edge_count(), false);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (!tree.nodes[n].children.empty()) continue;
    const Automaton& leaf = network.automaton(NodeId{n});
    for (std::uint32_t e = 0; e < leaf.edges.size(); ++e) {
      found[leaf.first_edge + e] =
          leaf.target(leaf.edges[e]).role == LocationRole::Success;
    }
  }
  return found;
}

}  // namespace

bool are_samples_due(std::size_t expanded, const Limits& limits) {
  return expanded >= kLong || !limits.has_spare();
}

Samples::Samples(const BehaviorTree& tree, const SearchedNetwork& searched,
                 const std::vector<Sighting>& sightings, const Network& network,
                 const Limits& limits, DefaultReport& report,
                 std::size_t expanded)
    : walks_(searched.system(), limits,
             successes(tree, searched.system().network().network())),
      questions_(tree, searched.system().network(), sightings),
      reporter_(searched, walks_, false, network, limits, report) {
  evidence_.add(seen());
  SearchProgress progress;
  progress.states = progress.expanded = expanded;
  walks_.run(questions_, std::min(expanded / 4, kMostSteps),
             [&] { return limits.reached(progress) == StopReason::None; });
}

std::string Samples::told(std::vector<Suspicion> suspicions) const {
  std::string lines;
  const auto success = evidence_.possibility(&DefaultQuestions::success);
  if (success.run) {
    lines +=
        fmt::format("seen so far: the mission can succeed, after {} tick{}\n",
                    success.ticks(), success.ticks() == 1 ? "" : "s");
  }
  Judge judge(evidence_, false);
  for (Suspicion& each : suspicions) {
    if (is_question(each.finding) || !judge.confirm(each)) continue;
    lines += fmt::format("seen so far: {}: {}\n", each.finding.code,
                         each.finding.message);
  }
  return lines;
}

}  // namespace btcheck
