// SPDX-License-Identifier: MIT
#include "check/whatif/unnoticed.hpp"

#include <algorithm>
#include <utility>

#include "explore/store/state_store.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostPlaces = 300'000;

}  // namespace

HealthyRuns::HealthyRuns(const BehaviorTree& tree, const AnswerGraph& healthy,
                         NodeId leaf)
    : healthy_(healthy), leaf_(leaf) {
  for (auto& seen : seen_) seen.resize(healthy.size(), 0);
  const NodeId root = root_of(tree, leaf);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    is_in_tree_.push_back(root_of(tree, NodeId{n}) == root);
  }
  std::vector<Place> places;
  ++closure_;
  add_from(0, false, places);
  intern(std::move(places));
}

HealthyRuns::Places HealthyRuns::intern(std::vector<Place> places) {
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  const auto next = static_cast<Places>(sets_.size());
  const auto [known, is_new] = known_.emplace(std::move(places), next);
  if (is_new) sets_.push_back(&known->first);
  return known->second;
}

HealthyRuns::Read HealthyRuns::read(Place place) const {
  const AnswerGraph::Arc& arc =
      healthy_.arc(static_cast<std::uint32_t>(place >> 21));
  return {arc, healthy_.events(arc), (place >> 1) & (kMostEvents - 1),
          (place & 1) != 0};
}

bool HealthyRuns::is_before(Place place, NodeEvent event) const {
  if ((place & kEnd) != 0) return false;
  const Read at = read(place);
  return at.events[at.done] == event;
}

bool HealthyRuns::is_done(Places places) const {
  return std::ranges::find(*sets_[places], kEnd) == sets_[places]->end();
}

// On along an arc to an event that is heard, or to its end.
void HealthyRuns::go_on(
    Read at, std::uint32_t arc, std::vector<Place>& places,
    std::vector<std::pair<std::uint32_t, bool>>& open) const {
  while (at.done < at.events.size() && !is_heard(at.events[at.done])) {
    const NodeEvent event = at.events[at.done];
    if (event.node() == leaf_ && is_answer(event.what())) {
      at.succeeded = event.what() == Happening::Success;
    }
    ++at.done;
  }
  if (at.done == at.events.size()) {
    open.emplace_back(at.arc.target, at.succeeded);
  } else {
    places.push_back(place(arc, at.done, at.succeeded));
  }
}

// Places before an event that is heard, which can be reached without another.
void HealthyRuns::add_from(std::uint32_t state, bool succeeded,
                           std::vector<Place>& places) {
  std::vector<std::pair<std::uint32_t, bool>> open = {{state, succeeded}};
  while (!open.empty()) {
    const auto [here, has_succeeded] = open.back();
    open.pop_back();
    auto& seen = seen_[has_succeeded ? 1 : 0][here];
    if (std::exchange(seen, closure_) == closure_) continue;
    if (healthy_.ending(here) == Ending::Success) {
      places.push_back(kEnd | (has_succeeded ? 1 : 0));
    }
    const auto arcs = healthy_.arcs(here);
    for (std::uint32_t i = 0; i < arcs.size(); ++i) {
      go_on({arcs[i], healthy_.events(arcs[i]), 0, has_succeeded},
            healthy_.first_arc(here) + i, places, open);
    }
  }
}

std::optional<HealthyRuns::Places> HealthyRuns::after(Places places,
                                                      NodeEvent event) {
  const std::uint64_t key = (std::uint64_t{places} << 32) | event.bits();
  if (const auto known = after_.find(key); known != after_.end()) {
    return known->second;
  }
  std::vector<Place> next;
  bool happens = false;
  ++closure_;
  for (const Place here : *sets_[places]) {
    if (!is_before(here, event)) continue;
    happens = true;
    Read at = read(here);
    ++at.done;
    std::vector<std::pair<std::uint32_t, bool>> open;
    go_on(at, static_cast<std::uint32_t>(here >> 21), next, open);
    for (const auto& [state, succeeded] : open) {
      add_from(state, succeeded, next);
    }
  }
  std::optional<Places> result;
  if (happens) result = intern(std::move(next));
  after_.emplace(key, result);
  return result;
}

namespace {

// Follows runs with the fault beside the healthy ones that look the same.
class Unnoticed {
 public:
  Unnoticed(const BehaviorTree& tree, HealthyRuns& healthy,
            const AnswerGraph& faulty, const InjectedFault& fault)
      : faulty_(faulty),
        fault_(fault),
        root_(root_of(tree, fault.leaf)),
        counts_(!is_of_world(tree.node(fault.leaf))),
        healthy_(healthy) {}

  Silence take() {
    add({}, 0, 0);
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      ask_budget();
      expand(n);
      if (nodes_.size() <= kMostPlaces) continue;
      silence_.is_known = false;
      return std::move(silence_);
    }
    silence_.within = longest();
    return std::move(silence_);
  }

 private:
  struct At {
    std::uint32_t state = 0;
    HealthyRuns::Places places = HealthyRuns::kStart;
    bool has_struck = false;
    bool is_fresh = false;  // the fault has yet to give its answer
    bool is_done = true;    // what the leaf is for, with its last answer
  };
  struct Spot {
    At at;
    std::uint32_t from = 0;
    std::uint32_t arc = 0;  // by which it was reached first
    std::uint32_t first_move = 0;
  };
  // Of a run that goes on unnoticed: ticks that pass, once it has struck.
  struct Move {
    std::uint32_t to = 0;
    int ticks = 0;
    int until_noticed = -1;  // it is noticed on the way, after so many
  };

  std::uint32_t add(const At& at, std::uint32_t from, std::uint32_t arc) {
    const Word key[] = {Word{at.state} << 32 | at.places,
                        (at.has_struck ? 4u : 0u) | (at.is_fresh ? 2u : 0u) |
                            (at.is_done ? 1u : 0u)};
    const auto [number, is_new] = known_.insert(key);
    if (!is_new) return number;
    nodes_.push_back({at, from, arc, 0});
    const bool is_lost = at.has_struck && !at.is_done && counts_ &&
                         faulty_.ending(at.state) == Ending::Success &&
                         healthy_.is_done(at.places);
    if (is_lost && !silence_.run) silence_.run = run_to(number);
    return number;
  }

  std::vector<std::uint32_t> run_to(std::uint32_t number) const {
    std::vector<std::uint32_t> run;
    for (; number != 0; number = nodes_[number].from) {
      run.push_back(nodes_[number].arc);
    }
    std::ranges::reverse(run);
    return run;
  }

  // What an answer of the leaf says of what it is for.
  bool does_it(Happening answer) const {
    using enum FaultKind;
    switch (fault_.fault.kind) {
      case WritesNothing:
      case WritesOther:
      case Succeeds:
      case Inverted:
        return false;
      case FlipsOnce:
        return answer != Happening::Running;
      default:
        return answer == Happening::Success;
    }
  }

  void expand(std::uint32_t number) {
    const At from = nodes_[number].at;
    nodes_[number].first_move = static_cast<std::uint32_t>(moves_.size());
    const auto arcs = faulty_.arcs(from.state);
    for (std::uint32_t i = 0; i < arcs.size(); ++i) {
      At at = from;
      at.state = arcs[i].target;
      Move move;
      for (const NodeEvent event : faulty_.events(arcs[i])) {
        if (event.what() == Happening::Struck) {
          at.has_struck = true;
          at.is_done = false;
          at.is_fresh = fault_.fault.kind == FaultKind::FlipsOnce;
        } else if (event == NodeEvent(root_, Happening::Asked)) {
          move.ticks += at.has_struck ? 1 : 0;
        } else if (event.node() == fault_.leaf && at.has_struck &&
                   is_answer(event.what())) {
          // The answer that the fault itself gives does nothing.
          if (!std::exchange(at.is_fresh, false)) {
            at.is_done = does_it(event.what());
          }
        } else if (healthy_.is_heard(event)) {
          const auto after = healthy_.after(at.places, event);
          if (!after) {
            move.until_noticed = move.ticks;
            break;
          }
          at.places = *after;
        }
      }
      if (move.until_noticed < 0) {
        move.to = add(at, number, faulty_.first_arc(from.state) + i);
      }
      moves_.push_back(move);
    }
  }

  // The longest time behind the strike, over all nodes; nothing where there is
  // a cycle. The graph of moves is walked in depth, each node once.
  std::optional<int> longest() const {
    enum class Mark : std::uint8_t { New, Open, Done };
    std::vector<Mark> marks(nodes_.size(), Mark::New);
    std::vector<int> most(nodes_.size(), 0);
    struct Frame {
      std::uint32_t node;
      std::uint32_t next;
    };
    int longest = 0;
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      if (!nodes_[n].at.has_struck || marks[n] != Mark::New) continue;
      std::vector<Frame> open = {{n, nodes_[n].first_move}};
      marks[n] = Mark::Open;
      while (!open.empty()) {
        Frame& top = open.back();
        const std::uint32_t node = top.node;
        if (top.next == end_of(node)) {
          marks[node] = Mark::Done;
          longest = std::max(longest, most[node]);
          open.pop_back();
          continue;
        }
        const Move& move = moves_[top.next];
        if (move.until_noticed >= 0) {
          most[node] = std::max(most[node], move.until_noticed);
        } else if (marks[move.to] == Mark::New) {
          marks[move.to] = Mark::Open;
          open.push_back({move.to, nodes_[move.to].first_move});
          continue;
        } else if (marks[move.to] == Mark::Open) {
          return std::nullopt;
        } else {
          most[node] = std::max(most[node], move.ticks + most[move.to]);
        }
        ++top.next;
      }
    }
    // What passes in the step with the strike, behind it.
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      if (nodes_[n].at.has_struck) continue;
      for (std::uint32_t m = nodes_[n].first_move; m < end_of(n); ++m) {
        const Move& move = moves_[m];
        if (move.until_noticed >= 0) {
          longest = std::max(longest, move.until_noticed);
        } else if (nodes_[move.to].at.has_struck) {
          longest = std::max(longest, move.ticks + most[move.to]);
        }
      }
    }
    return longest;
  }
  std::uint32_t end_of(std::uint32_t node) const {
    return node + 1 < nodes_.size() ? nodes_[node + 1].first_move
                                    : static_cast<std::uint32_t>(moves_.size());
  }

  const AnswerGraph& faulty_;
  const InjectedFault& fault_;
  NodeId root_;
  bool counts_;  // what it is for was to be done
  HealthyRuns& healthy_;
  std::vector<Spot> nodes_;
  std::vector<Move> moves_;
  VectorSet known_{2};  // the numbers are those of the nodes
  Silence silence_;
};

}  // namespace

Silence silence_of(const BehaviorTree& tree, HealthyRuns& healthy,
                   const AnswerGraph& faulty, const InjectedFault& fault) {
  return Unnoticed(tree, healthy, faulty, fault).take();
}

std::optional<Notice> notice_on(const BehaviorTree& tree, HealthyRuns& healthy,
                                const std::vector<NodeEvent>& run) {
  const NodeEvent tick(root_of(tree, healthy.leaf()), Happening::Asked);
  HealthyRuns::Places places = HealthyRuns::kStart;
  bool has_struck = false;
  int ticks = 0;
  for (const NodeEvent event : run) {
    has_struck = has_struck || event.what() == Happening::Struck;
    if (event == tick && has_struck) ++ticks;
    if (!healthy.is_heard(event)) continue;
    const auto after = healthy.after(places, event);
    if (!after) return Notice{event.node(), event.what(), ticks};
    places = *after;
  }
  return std::nullopt;
}

}  // namespace btcheck
