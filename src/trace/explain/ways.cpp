// SPDX-License-Identifier: MIT
#include "trace/explain/ways.hpp"

#include <algorithm>
#include <utility>

#include "explore/store/state_store.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// What a search from one place of the log may take.
constexpr std::uint64_t kMostStates = 200'000;

// The states that were reached, and how.
struct Reached {
  std::uint32_t from = 0;
  std::uint32_t edge = kTimeStep;
};

// What decided it: the first moment that is no more part of what was read; or
// an answer of a leaf before it that has no record of its own.
std::size_t decisive(const BehaviorTree& tree, const LogMoments& moments,
                     std::size_t records) {
  const auto& all = moments.all();
  const auto first = static_cast<std::size_t>(
      std::ranges::find_if(
          all, [&](const Moment& each) { return each.records > records; }) -
      all.begin());
  const auto is_leafs = [&](const Moment& each) {
    return is_leaf(tree.node(each.node).type) && each.what != Happening::Asked;
  };
  if (first < all.size() && is_leafs(all[first])) return first;
  for (std::size_t at = first; at-- > 0 && all[at].records == records;) {
    if (is_leafs(all[at])) return at;
  }
  return std::min(first, all.size() - 1);
}

}  // namespace

Ways::Ways(const BehaviorTree& tree, const Network& network,
           const Limits& limits)
    : tree_(tree), system_(network), limits_(limits) {
  events_.resize(network.edge_count());
  for (std::uint32_t e = 0; e < events_.size(); ++e) events_[e] = told_by(e);
}

// What a way is told by: leaves and roots that are asked and answer.
std::optional<NodeEvent> Ways::told_by(std::uint32_t edge) const {
  const auto event = event_of(system_.network(), edge);
  if (!event || event->what() == Happening::Halted) return std::nullopt;
  const Edge& taken = system_.network().edge(edge);
  if (taken.source == taken.target) return std::nullopt;
  const Node& node = tree_.node(event->node());
  return node.is_root() || is_leaf(node.type) ? event : std::nullopt;
}

Conformance Ways::follow(const ExplainedLog& log) const {
  return conform(tree_, system_, log.log, log.nodes, limits_, {}, log.reading);
}

std::optional<Ways::Way> Ways::way_to_success(
    std::span<const StateVector> states) {
  VectorSet store(system_.word_count());
  std::vector<Reached> reached;
  for (const StateVector& state : states) {
    if (store.insert(state).is_new) reached.push_back({});
  }
  const std::size_t starts = reached.size();
  std::optional<Reached> end;
  StateVector here;
  SearchProgress progress;
  for (std::uint32_t next = 0; next < store.size() && !end; ++next) {
    if (next % kPollInterval == 0) {
      progress.states = store.size();
      progress.expanded = next;
      progress.bytes = store.bytes();
      stopped_ = progress.states > kMostStates ? StopReason::MaxStates
                                               : limits_.reached(progress);
      if (stopped_ != StopReason::None) return std::nullopt;
    }
    const StateView view = store[next];
    here.assign(view.begin(), view.end());
    system_.successors(here, [&](StateView target, Step step) {
      if (end) return;
      if (step.edge != kTimeStep) {
        const auto& event = events_[step.edge];
        if (event && tree_.node(event->node()).is_root()) {
          if (event->what() == Happening::Success) {
            end = Reached{next, step.edge};
          }
          if (event->what() == Happening::Success ||
              event->what() == Happening::Failure) {
            return;
          }
        }
      }
      if (store.insert(target).is_new) reached.push_back({next, step.edge});
    });
  }
  if (!end) return std::nullopt;
  Way way;
  for (Reached at = *end;; at = reached[at.from]) {
    if (at.edge != kTimeStep && events_[at.edge]) {
      const NodeEvent event = *events_[at.edge];
      if (!tree_.node(event.node()).is_root()) {
        if (event.what() != Happening::Asked) way.events.push_back(event);
      } else if (event.what() == Happening::Asked) {
        ++way.ticks;
      }
    }
    if (at.from < starts) break;
  }
  std::ranges::reverse(way.events);
  return way;
}

std::optional<Ways::Way> Ways::way_after(const ExplainedLog& log,
                                         std::size_t records) {
  const BehaviorLog cut = first_records(log.log, records);
  const Conformance found =
      conform(tree_, system_, cut, log.nodes, limits_, {}, log.reading);
  if (found.stopped != StopReason::None) stopped_ = found.stopped;
  if (!found.conforms()) return std::nullopt;
  if (records > 0) return way_to_success(found.states);
  std::vector<StateVector> first;
  system_.initial_states(
      [&](StateView state) { first.emplace_back(state.begin(), state.end()); });
  return way_to_success(first);
}

std::optional<LastWay> Ways::last_way(const ExplainedLog& log) {
  const Mission& mission = log.moments.last();
  if (mission.begin == mission.end) return std::nullopt;
  // A way that is there after some records was there before.
  std::size_t low =
      mission.begin == 0 ? 0 : log.moments.at(mission.begin - 1).records;
  std::size_t behind = log.moments.at(mission.end - 1).records;
  auto way = way_after(log, low);
  is_hopeless_ = !way && stopped_ == StopReason::None;
  if (!way) return std::nullopt;
  const std::size_t end = behind++;
  while (low + 1 < behind) {
    const std::size_t middle = low + (behind - low) / 2;
    auto found = way_after(log, middle);
    if (stopped_ != StopReason::None) return std::nullopt;
    if (found) {
      way = std::move(found);
      low = middle;
    } else {
      behind = middle;
    }
  }
  LastWay last{low, {}, std::move(way->events), way->ticks};
  if (low < end) last.moment = decisive(tree_, log.moments, low);
  return last;
}

std::vector<NodeId> Ways::asked_next(std::span<const StateVector> states,
                                     bool one_was_asked) const {
  constexpr std::size_t kMost = 20'000;
  VectorSet store(system_.word_count());
  for (const StateVector& state : states) store.insert(state);
  std::vector<NodeId> asked;
  bool may_rest = false;
  StateVector here;
  for (std::uint32_t next = 0; next < store.size() && !may_rest; ++next) {
    if (store.size() > kMost) return {};
    const StateView view = store[next];
    here.assign(view.begin(), view.end());
    system_.successors(here, [&](StateView target, Step step) {
      if (step.edge != kTimeStep) {
        const auto& event = events_[step.edge];
        if (event && tree_.node(event->node()).is_root()) {
          may_rest = !one_was_asked;
        } else if (event && event->what() == Happening::Asked) {
          if (std::ranges::find(asked, event->node()) == asked.end()) {
            asked.push_back(event->node());
          }
          return;
        }
      }
      store.insert(target);
    });
  }
  if (may_rest) asked.clear();
  return asked;
}

}  // namespace btcheck
