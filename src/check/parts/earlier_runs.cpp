// SPDX-License-Identifier: MIT
#include "check/parts/earlier_runs.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "text/budget.hpp"

namespace btcheck {
namespace {

// A run, and what it shows first of all, where that is one thing: that a node
// does something, or the sighting of a number.
struct Claim {
  const KeptRun* run = nullptr;
  std::optional<NodeId> node = {};
  std::size_t question = 0;
  std::optional<std::size_t> sighting = {};
};

// `numbers`: by place in the report, of what was sighted and can be here.
std::vector<Claim> claims_of(
    const DefaultReport& report,
    const std::vector<std::optional<std::size_t>>& numbers) {
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
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!numbers[i]) continue;
    claims.push_back({&report.sighted[i].run, {}, 0, numbers[i]});
  }
  for (const StaleGuardReport& each : report.stale_guards) add(each.run);
  for (const LeftRunningReport& each : report.left_running) add(each.run);
  for (const TreeFinding& each : report.findings) add(each.run);
  std::ranges::stable_sort(
      claims, {}, [](const Claim& each) { return each.run->step_count(); });
  return claims;
}

// Earlier runs that are runs of this network.
class TakenOver {
 public:
  TakenOver(const Counterparts& here, const Network& network)
      : here_(here), runs_(std::make_shared<RunTree>(network)) {}

  // All that are asked for later.
  void want(const KeptRun& earlier) {
    std::vector<At>& places = places_[&earlier.tree()];
    places.resize(earlier.tree().size());
    for (Place at = earlier.end(); !places[at].is_wanted && at != 0;
         at = earlier.tree().before(at)) {
      places[at].is_wanted = true;
    }
  }
  void take() {
    for (auto& [tree, places] : places_) {
      places[0].here = Place{0};
      for (Place at = 1; at < places.size(); ++at) {
        if (places[at].is_wanted) take(*tree, at, places);
      }
    }
  }
  std::optional<KeptRun> run(const KeptRun& earlier) const {
    const auto& end = places_.at(&earlier.tree())[earlier.end()].here;
    if (earlier.loop() != kNoLoop || !end) return std::nullopt;
    // What such a leaf does with it is another step here.
    const Step& last = earlier.tree().last_step(earlier.end());
    if (here_.leaf_of(last)) return std::nullopt;
    return KeptRun(runs_, *end);
  }

 private:
  using Place = RunTree::Place;

  using Edges = Counterparts::Edges;

  // The turn of a leaf so far, and where it began.
  struct Turn {
    AutomatonId leaf{};
    Place begin = 0;
    Edges edges = {};
  };
  // A place of an earlier tree: where that is here, or within which turn.
  struct At {
    bool is_wanted = false;
    std::optional<Place> here = {};
    std::optional<Turn> turn = {};
  };

  void take(const RunTree& tree, Place at, std::vector<At>& places) {
    const At& before = places[tree.before(at)];
    const Step& step = tree.last_step(at);
    At& now = places[at];
    if (const auto leaf = here_.leaf_of(step)) {
      std::optional<Turn> turn = before.turn;
      if (before.here) turn = Turn{*leaf, *before.here};
      // Nobody else moves within a turn.
      if (!turn || turn->leaf != *leaf) return;
      turn->edges.push_back(step.edge);
      if (here_.ends_turn(step)) {
        now.here = behind(*turn);
      } else {
        now.turn = std::move(turn);
      }
    } else if (const auto kept =
                   before.here ? here_.kept(step) : std::optional<Step>()) {
      now.here = runs_->add(*before.here, *kept);
    }
  }

  // Where the turn that it has here leads to.
  std::optional<Place> behind(const Turn& turn) {
    const auto [known, is_new] = turns_.try_emplace(turn.edges);
    if (is_new) known->second = here_.turn(turn.leaf, turn.edges);
    if (!known->second) return std::nullopt;
    Place place = turn.begin;
    for (const std::uint32_t edge : *known->second) {
      place = runs_->add(place, Step{.edge = edge});
    }
    return place;
  }

  const Counterparts& here_;
  std::shared_ptr<RunTree> runs_;
  std::unordered_map<const RunTree*, std::vector<At>> places_;
  std::map<Edges, std::optional<Edges>> turns_;  // by the edges of earlier ones
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
  show(from, visitor);
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
  if (!is_shown(state)) show(state, visitor);
}

void EarlierRuns::Walks::show(StateId state, DefaultQuestions& visitor) {
  ask_budget();
  compute(state, expansion_, visitor);
  if (is_shown(state)) return;
  is_shown_.resize(std::max<std::size_t>(is_shown_.size(), index(state) + 1));
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
  Numbers numbers;
  for (const SightedRun& each : earlier.report.sighted) {
    numbers.push_back(number_of(here, each));
  }
  take_over(here, earlier.report, numbers);
  walk(here, earlier.report, numbers);
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
                            const DefaultReport& earlier,
                            const Numbers& numbers) {
  TakenOver taken(here, network_);
  for (const NodeReport& each : earlier.nodes) {
    for (const Possibility& answer : each.answers) {
      if (answer.run) taken.want(*answer.run);
    }
  }
  for (const SightedRun& each : earlier.sighted) {
    taken.want(each.run);
    if (each.followed) taken.want(*each.followed);
  }
  taken.take();
  for (const NodeReport& each : earlier.nodes) {
    const auto& node = here.node(each.node);
    if (!node) continue;
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      const auto& run = each.answers[q].run;
      if (run) known_.nodes[index(*node)][q] = taken.run(*run);
    }
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const SightedRun& each = earlier.sighted[i];
    auto run = numbers[i] ? taken.run(each.run) : std::nullopt;
    if (!run) continue;
    // What follows may be another thing where somebody differs.
    std::optional<KeptRun> followed;
    if (each.then && here.keeps_all()) {
      if (each.followed) followed = taken.run(*each.followed);
    } else if (const auto& then = consequences_[*numbers[i]]) {
      followed = reporter_.run_on(*run, *then);
      if (!followed) continue;
    }
    known_.sighted[*numbers[i]] = {std::move(*run), std::move(followed)};
  }
}

void EarlierRuns::walk(const Counterparts& here, const DefaultReport& earlier,
                       const Numbers& numbers) {
  const auto is_shown = [&](const Claim& claim) {
    if (claim.sighting) {
      return known_.sighted[*claim.sighting] ||
             questions_.sightings.found()[*claim.sighting];
    }
    if (!claim.node) return false;
    const auto& node = here.node(*claim.node);
    return !node || shown(*node)[claim.question];
  };
  const StateId start = walks_.begin();
  for (const Claim& claim : claims_of(earlier, numbers)) {
    if (is_shown(claim)) continue;
    StateId at = start;
    for (const Step& each : claim.run->steps()) {
      const auto step = here.step(each);
      const auto next =
          step ? walks_.follow(at, *step, questions_) : std::nullopt;
      if (!next) break;
      at = *next;
    }
    walks_.look_at(at, questions_);
  }
}

}  // namespace btcheck
