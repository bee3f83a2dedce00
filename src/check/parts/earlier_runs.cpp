// SPDX-License-Identifier: MIT
#include "check/parts/earlier_runs.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "text/budget.hpp"

namespace btcheck {
namespace {

// A run, and what it shows first of all, where that is one thing: that a node
// does something, or a sighting.
struct Claim {
  const KeptRun* run = nullptr;
  std::optional<NodeId> node = {};
  std::size_t question = 0;
  const SightedRun* sighted = nullptr;
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
  for (const SightedRun& each : report.sighted) {
    claims.push_back({&each.run, {}, 0, &each});
  }
  for (const StaleGuardReport& each : report.stale_guards) add(each.run);
  for (const LeftRunningReport& each : report.left_running) add(each.run);
  for (const TreeFinding& each : report.findings) add(each.run);
  std::ranges::stable_sort(
      claims, {}, [](const Claim& each) { return each.run->step_count(); });
  return claims;
}

// Earlier runs that are runs of this network, step by step.
class TakenOver {
 public:
  TakenOver(const Counterparts& here, const Network& network)
      : here_(here), runs_(std::make_shared<RunTree>(network)) {}

  std::optional<KeptRun> run(const KeptRun& earlier) {
    if (earlier.loop() != kNoLoop) return std::nullopt;
    const auto end = place(earlier.tree(), earlier.end());
    if (!end) return std::nullopt;
    return KeptRun(runs_, *end);
  }

 private:
  using Place = RunTree::Place;

  std::optional<Place> place(const RunTree& tree, Place end) {
    auto& places = places_[&tree];
    places.try_emplace(0, Place{0});
    std::vector<Place> way;
    Place at = end;
    for (; !places.contains(at); at = tree.before(at)) way.push_back(at);
    std::optional<Place> here = places.at(at);
    for (; !way.empty(); way.pop_back()) {
      const auto step =
          here ? here_.kept(tree.last_step(way.back())) : std::nullopt;
      here = step ? std::optional(runs_->follow(*here, *step)) : std::nullopt;
      places.emplace(way.back(), here);
    }
    return here;
  }

  const Counterparts& here_;
  std::shared_ptr<RunTree> runs_;
  // By tree and place there; nothing where the way to it is not the same.
  std::unordered_map<const RunTree*,
                     std::unordered_map<Place, std::optional<Place>>>
      places_;
};

}  // namespace

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
                         const Inquiry& inquiry, const Network& network,
                         const Limits& limits, DefaultReport& report,
                         const EarlierReport& earlier)
    : network_(network),
      sightings_(inquiry.sightings()),
      consequences_(inquiry.consequences()),
      walks_(whole.system(), limits),
      questions_(tree, whole.system().network(), sightings_),
      reporter_(whole, walks_, false, network, limits, report),
      shows_(sightings_.size(), false) {
  known_.nodes.resize(tree.nodes.size());
  known_.sighted.resize(sightings_.size());
  const Counterparts here(earlier, tree, network);
  take_over(here, earlier);
  walk(here, earlier.report);
  for (std::size_t i = 0; i < sightings_.size(); ++i) {
    const auto& found = questions_.sightings.found()[i];
    shows_[i] = known_.sighted[i] ||
                (found && (!consequences_[i] ||
                           reporter_.run_to(*found, *consequences_[i])));
  }
}

NodeQuestions EarlierRuns::shown(NodeId node) const {
  NodeQuestions shown;
  for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
    shown[q] = known_.nodes[index(node)][q] || questions_.nodes[index(node)][q];
  }
  return shown;
}

std::optional<std::size_t> EarlierRuns::number_of(
    const Counterparts& here, const SightedRun& earlier) const {
  bool has_all = true;
  const auto map = [&](NodeId& node) {
    const auto& now = here.node(node);
    has_all = has_all && now;
    if (now) node = *now;
  };
  Sighting sighting = earlier.sighting;
  map(sighting.node);
  for (auto& [node, status] : sighting.with) map(node);
  if (sighting.retried) map(*sighting.retried);
  auto then = earlier.then;
  if (then) map(then->node);
  for (std::size_t i = 0; has_all && i < sightings_.size(); ++i) {
    if (sightings_[i] == sighting && consequences_[i] == then) return i;
  }
  return std::nullopt;
}

void EarlierRuns::take_over(const Counterparts& here,
                            const EarlierReport& earlier) {
  TakenOver taken(here, network_);
  for (const NodeReport& each : earlier.report.nodes) {
    const auto& node = here.node(each.node);
    if (!node) continue;
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      const auto& run = each.answers[q].run;
      if (run) known_.nodes[index(*node)][q] = taken.run(*run);
    }
  }
  for (const SightedRun& each : earlier.report.sighted) {
    const auto number = number_of(here, each);
    if (number) known_.sighted[*number] = taken.run(each.run);
  }
}

void EarlierRuns::walk(const Counterparts& here, const DefaultReport& earlier) {
  const auto is_shown = [&](const Claim& claim) {
    if (claim.sighted != nullptr) {
      const auto number = number_of(here, *claim.sighted);
      return !number || known_.sighted[*number] ||
             questions_.sightings.found()[*number];
    }
    if (!claim.node) return false;
    const auto& node = here.node(*claim.node);
    return !node || shown(*node)[claim.question];
  };
  const StateId start = walks_.begin();
  for (const Claim& claim : claims_of(earlier)) {
    if (is_shown(claim)) continue;
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
