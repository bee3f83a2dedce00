// SPDX-License-Identifier: MIT
//
// Breadth first over pairs of sets: all states that a run from the first state
// may have come to by what was seen, and all from the second (the subset
// construction of Rabin and Scott 1959, on both sides). A pair of which one
// side can do something that the other cannot ends a shortest difference.
#include "explore/minimise/traces.hpp"

#include <algorithm>
#include <boost/container_hash/hash.hpp>
#include <map>
#include <unordered_map>
#include <utility>

#include "text/budget.hpp"

namespace btcheck {
namespace {

using States = std::vector<std::uint32_t>;
using Labels = std::vector<std::uint32_t>;

// What can be seen from a set of states: for each label where it leads to.
struct Outlook {
  std::map<std::uint32_t, std::uint32_t> next;  // label to number of a set
  bool stops = false;
  bool unseen = false;
};

class StateSets {
 public:
  explicit StateSets(const LabelledGraph& graph) : graph_(graph) {}

  // With all that is reached silently.
  std::uint32_t closed(States states) {
    ++closure_;
    seen_.resize(graph_.size(), 0);
    States all;
    const auto add = [&](std::uint32_t state) {
      if (std::exchange(seen_[state], closure_) != closure_) {
        all.push_back(state);
      }
    };
    for (const std::uint32_t state : states) add(state);
    for (std::size_t i = 0; i < all.size(); ++i) {
      ask_budget();
      for (const LabelledGraph::Arc& arc : graph_.arcs(all[i])) {
        if (arc.label == LabelledGraph::kSilent) add(arc.target);
      }
    }
    std::ranges::sort(all);
    const auto next = static_cast<std::uint32_t>(sets_.size());
    const auto [known, is_new] = known_.emplace(std::move(all), next);
    if (is_new) {
      sets_.push_back(&known->first);
      outlooks_.emplace_back();
    }
    return known->second;
  }

  // Valid until the next call of closed().
  const Outlook& outlook(std::uint32_t set) {
    if (outlooks_[set].second) return outlooks_[set].first;
    Outlook made;
    std::map<std::uint32_t, States> next;
    for (const std::uint32_t state : *sets_[set]) {
      made.stops |= graph_.arcs(state).empty();
      for (const LabelledGraph::Arc& arc : graph_.arcs(state)) {
        if (arc.label != LabelledGraph::kSilent) {
          next[arc.label].push_back(arc.target);
        } else if (arc.target == state) {
          made.unseen = true;
        }
      }
    }
    for (auto& [label, states] : next) {
      made.next.emplace(label, closed(std::move(states)));
    }
    outlooks_[set] = {std::move(made), true};
    return outlooks_[set].first;
  }

 private:
  const LabelledGraph& graph_;
  std::unordered_map<States, std::uint32_t, boost::hash<States>> known_;
  std::vector<const States*> sets_;  // by number
  std::vector<std::pair<Outlook, bool>> outlooks_;
  std::vector<std::uint32_t> seen_;
  std::uint32_t closure_ = 0;
};

struct Pair {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::uint32_t from = 0;   // an index into all pairs
  std::uint32_t label = 0;  // that led here from there
};

// How the two differ at once: better by what is seen than by how it ends.
std::optional<TraceDifference> difference_at(const Outlook& first,
                                             const Outlook& second) {
  const auto made = [&](bool is_of_first, TraceEnd end, Labels labels) {
    const Outlook& other = is_of_first ? second : first;
    TraceDifference found{std::move(labels), end,         is_of_first, {},
                          other.stops,       other.unseen};
    for (const auto& [label, set] : other.next) found.instead.push_back(label);
    return found;
  };
  for (const bool is_of_first : {true, false}) {
    const Outlook& one = is_of_first ? first : second;
    const Outlook& other = is_of_first ? second : first;
    for (const auto& [label, set] : one.next) {
      if (other.next.contains(label)) continue;
      return made(is_of_first, TraceEnd::Seen, {label});
    }
  }
  if (first.stops != second.stops) {
    return made(first.stops, TraceEnd::Stops, {});
  }
  if (first.unseen != second.unseen) {
    return made(first.unseen, TraceEnd::Unseen, {});
  }
  return std::nullopt;
}

}  // namespace

TraceComparison compare_traces(const LabelledGraph& graph, std::uint32_t first,
                               std::uint32_t second, std::size_t most) {
  StateSets sets(graph);
  std::vector<Pair> pairs = {{sets.closed({first}), sets.closed({second})}};
  const auto key = [](std::uint32_t one, std::uint32_t other) {
    return std::uint64_t{one} << 32 | other;
  };
  std::unordered_map<std::uint64_t, bool> known;
  known[key(pairs[0].first, pairs[0].second)] = true;
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    ask_budget();
    if (i >= most) return {std::nullopt, false};
    const Pair at = pairs[i];
    const Outlook one = sets.outlook(at.first);
    const Outlook other = sets.outlook(at.second);
    if (auto found = difference_at(one, other)) {
      Labels& labels = found->labels;
      for (std::uint32_t p = i; p != 0; p = pairs[p].from) {
        labels.push_back(pairs[p].label);
      }
      // The last label stands first.
      const auto own = labels.begin() + (found->end == TraceEnd::Seen ? 1 : 0);
      std::reverse(own, labels.end());
      std::rotate(labels.begin(), own, labels.end());
      return {std::move(found), true};
    }
    for (const auto& [label, to] : one.next) {
      const std::uint32_t beside = other.next.at(label);
      if (to == beside) continue;
      if (!known.emplace(key(to, beside), true).second) continue;
      pairs.push_back({to, beside, i, label});
    }
  }
  return {};
}

}  // namespace btcheck
