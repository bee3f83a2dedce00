// SPDX-License-Identifier: MIT
#include "check/parts/earlier_runs.hpp"

#include <algorithm>
#include <utility>

#include "text/budget.hpp"

namespace btcheck {
namespace {

bool are_alike(const Node& one, const Node& other) {
  return one.type == other.type && one.name == other.name;
}

// The automata of a network that belong to a node, or move a variable: those
// that are the same in two networks have the same place here.
class Counterparts {
 public:
  Counterparts(const EarlierReport& earlier, const BehaviorTree& tree,
               const Network& network)
      : earlier_(earlier.network),
        network_(network),
        automata_(earlier.network.automata.size()),
        nodes_(nodes_since(earlier.tree, tree)) {
    const auto timers = timers_of(earlier_);
    const auto timers_here = timers_of(network);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (!nodes_[n]) continue;
      const std::size_t here = index(*nodes_[n]);
      automata_[index(earlier_.node_automaton[n])] =
          network.node_automaton[here];
      const std::size_t both =
          std::min(timers[n].size(), timers_here[here].size());
      for (std::size_t i = 0; i < both; ++i) {
        automata_[index(timers[n][i])] = timers_here[here][i];
      }
    }
    for (const Automaton& each : network.automata) {
      if (each.kind != AutomatonKind::StateVariable) continue;
      const auto same =
          std::ranges::find_if(earlier_.automata, [&](const Automaton& other) {
            return other.kind == each.kind && other.name == each.name;
          });
      if (same == earlier_.automata.end()) continue;
      automata_[static_cast<std::size_t>(same - earlier_.automata.begin())] =
          AutomatonId{
              static_cast<std::uint32_t>(&each - network.automata.data())};
    }
  }

  const std::optional<NodeId>& node(NodeId earlier) const {
    return nodes_[index(earlier)];
  }
  std::optional<Step> step(Step step) const {
    if (step.edge == kTimeStep) return step;
    const Automaton& owner = earlier_.owner_of_edge(step.edge);
    const auto& here =
        automata_[static_cast<std::size_t>(&owner - earlier_.automata.data())];
    if (!here) return std::nullopt;
    const Automaton& automaton = network_.automaton(*here);
    const std::uint32_t place = step.edge - owner.first_edge;
    if (place >= automaton.edges.size()) return std::nullopt;
    step.edge = automaton.first_edge + place;
    return step;
  }

 private:
  // By NodeId.
  static std::vector<std::vector<AutomatonId>> timers_of(
      const Network& network) {
    std::vector<std::vector<AutomatonId>> timers(network.node_automaton.size());
    for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
      const Automaton& each = network.automata[a];
      if (each.kind != AutomatonKind::Timer) continue;
      timers[index(each.node)].push_back(AutomatonId{a});
    }
    return timers;
  }

  const Network& earlier_;
  const Network& network_;
  std::vector<std::optional<AutomatonId>> automata_;  // by AutomatonId before
  std::vector<std::optional<NodeId>> nodes_;
};

// A run, and what it shows first of all, if it is that a node does something.
struct Claim {
  const KeptRun* run = nullptr;
  std::optional<NodeId> node = {};
  std::size_t question = 0;
};

std::vector<Claim> claims_of(const DefaultReport& report) {
  std::vector<Claim> claims;
  const auto add = [&](const std::optional<KeptRun>& run) {
    if (run) claims.push_back({&*run});
  };
  for (const TreeReport& each : report.tree) add(each.run);
  for (const NodeReport& each : report.nodes) {
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      const auto& run = each.answers[q].run;
      if (run) claims.push_back({&*run, each.node, q});
    }
  }
  for (const StaleGuardReport& each : report.stale_guards) add(each.run);
  for (const LeftRunningReport& each : report.left_running) add(each.run);
  for (const TreeFinding& each : report.findings) add(each.run);
  std::ranges::stable_sort(
      claims, {}, [](const Claim& each) { return each.run->step_count(); });
  return claims;
}

}  // namespace

std::vector<std::optional<NodeId>> nodes_since(const BehaviorTree& earlier,
                                               const BehaviorTree& tree) {
  const std::size_t before = earlier.nodes.size();
  const std::size_t now = tree.nodes.size();
  const std::size_t fewer = std::min(before, now);
  std::size_t front = 0;
  while (front < fewer && are_alike(earlier.nodes[front], tree.nodes[front])) {
    ++front;
  }
  std::size_t back = 0;
  while (back < fewer - front && are_alike(earlier.nodes[before - 1 - back],
                                           tree.nodes[now - 1 - back])) {
    ++back;
  }
  if (before == now) front = before - back;
  std::vector<std::optional<NodeId>> nodes(before);
  for (std::size_t n = 0; n < before; ++n) {
    if (n < front) {
      nodes[n] = NodeId{static_cast<std::uint32_t>(n)};
    } else if (n >= before - back) {
      nodes[n] = NodeId{static_cast<std::uint32_t>(now - (before - n))};
    }
  }
  return nodes;
}

StateId EarlierRuns::Walks::begin() {
  StateId start{};
  store_initial([&](StateId state) {
    tree_.reach(state, state);
    start = state;
  });
  return start;
}

std::optional<StateId> EarlierRuns::Walks::follow(StateId from,
                                                  const Step& step,
                                                  DefaultQuestions& visitor) {
  const std::uint64_t key = std::uint64_t{index(from)} << 32 | step.edge;
  const auto [known, is_new] = taken_.try_emplace(key);
  if (!is_new) return known->second;
  look_at(from, visitor);
  for (const auto& successor : expansion_.successors) {
    if (successor.step.edge != step.edge) continue;
    const StateId next = store_.insert(successor.key).id;
    tree_.reach(next, from);
    known->second = next;
    break;
  }
  return known->second;
}

void EarlierRuns::Walks::look_at(StateId state, DefaultQuestions& visitor) {
  ask_budget();
  compute(state, expansion_, visitor);
  if (is_shown_.size() <= index(state)) is_shown_.resize(index(state) + 1);
  if (is_shown_[index(state)]) return;
  is_shown_[index(state)] = true;
  const auto& steps = expansion_.successors;
  // Where time passes and changes nothing, the state is its own successor.
  const bool is_dead = steps.size() == 1 &&
                       steps.front().step.edge == kTimeStep &&
                       store_.insert(steps.front().key).id == state;
  visitor.expanded(state, expansion_.words, is_dead);
}

EarlierRuns::EarlierRuns(const BehaviorTree& tree, const SearchedNetwork& whole,
                         const std::vector<Sighting>& sightings,
                         const Network& network, const Limits& limits,
                         DefaultReport& report, const EarlierReport& earlier)
    : walks_(whole.system(), limits),
      questions_(tree, whole.system().network(), sightings),
      reporter_(whole, walks_, false, network, limits, report) {
  const Counterparts here(earlier, tree, network);
  const StateId start = walks_.begin();
  for (const Claim& claim : claims_of(earlier.report)) {
    if (claim.node) {
      const auto& node = here.node(*claim.node);
      if (node && questions_.nodes[index(*node)][claim.question]) continue;
    }
    std::optional<StateId> at = start;
    for (const Step& each : claim.run->steps()) {
      const auto step = here.step(each);
      const auto next =
          step ? walks_.follow(*at, *step, questions_) : std::nullopt;
      if (!next) break;
      at = next;
    }
    walks_.look_at(*at, questions_);
  }
}

}  // namespace btcheck
