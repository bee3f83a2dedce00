// SPDX-License-Identifier: MIT
//
// The targets of back edges of a depth-first search break every cycle of a
// graph. One kind of cycle need not be broken: halting child after child. An
// edge that demands of a child the status s, asks it to halt, and so sees it
// end its turn with another status, takes away one child with status s; where
// all calls of a cycle's component are of this kind nothing gives one back, so
// there are no more rounds than children.
#include "explore/reduce/call_protocol.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "explore/search/strong_components.hpp"
#include "explore/state/accesses.hpp"

namespace btcheck {
namespace {

// Whether the edge may leave this value in the variable.
bool may_write(const Edge& edge, VariableId variable, int value) {
  return std::ranges::any_of(edge.updates, [&](const Assignment& update) {
    return update.variable == variable &&
           constant_value(update).value_or(value) == value;
  });
}

class OwnCycles {
 public:
  OwnCycles(const Network& network, const CallProtocol& protocol,
            AutomatonId id)
      : network_(network),
        protocol_(protocol),
        id_(id),
        automaton_(network.automaton(id)),
        next_(automaton_.locations.size()) {
    for (const Edge& edge : automaton_.edges) {
      if (ends_turn(automaton_, edge)) continue;
      next_[index(edge.source)].push_back(index(edge.target));
    }
  }

  std::vector<LocationId> heads() const {
    enum class Mark : std::uint8_t { Unseen, OnPath, Left };
    std::vector<Mark> marks(automaton_.locations.size(), Mark::Unseen);
    std::vector<std::vector<std::uint32_t>> next(automaton_.locations.size());
    const std::vector<std::uint32_t> component = components();
    std::vector<std::pair<const Edge*, bool>> on_cycle;
    // By component: an edge in it calls some child and takes none away.
    std::vector<bool> gives_back(automaton_.locations.size(), false);
    for (const Edge& edge : automaton_.edges) {
      if (ends_turn(automaton_, edge) || takes_time(network_, edge) ||
          component[index(edge.source)] != component[index(edge.target)]) {
        continue;
      }
      const bool takes = takes_away(edge);
      on_cycle.emplace_back(&edge, takes);
      if (calls(edge) && !takes) {
        gives_back[component[index(edge.source)]] = true;
      }
    }
    for (const auto& [edge, takes] : on_cycle) {
      if (takes && !gives_back[component[index(edge->source)]]) continue;
      next[index(edge->source)].push_back(index(edge->target));
    }
    std::vector<LocationId> heads;
    std::vector<std::uint32_t> path;
    for (std::uint32_t start = 0; start < marks.size(); ++start) {
      if (marks[start] == Mark::Unseen) path.push_back(start);
      while (!path.empty()) {
        const std::uint32_t here = path.back();
        marks[here] = Mark::OnPath;
        if (next[here].empty()) {
          marks[here] = Mark::Left;
          path.pop_back();
          continue;
        }
        const std::uint32_t there = next[here].back();
        next[here].pop_back();
        if (marks[there] == Mark::OnPath) heads.push_back(LocationId{there});
        if (marks[there] == Mark::Unseen) path.push_back(there);
      }
    }
    return heads;
  }

 private:
  // By location: those that reach each other within a turn.
  std::vector<std::uint32_t> components() const {
    const auto arcs_of = [&](std::uint32_t location) {
      return std::span<const std::uint32_t>(next_[location]);
    };
    ComponentSearch search(next_.size(), arcs_of);
    for (std::uint32_t location = 0; location < next_.size(); ++location) {
      search.search_from(location, [](std::uint32_t target) { return target; });
    }
    return search.take_components();
  }

  // By location: whether it is reached from this one within a turn.
  std::vector<bool> reached_from(std::uint32_t location) const {
    std::vector<bool> reached(next_.size(), false);
    std::vector<std::uint32_t> open{location};
    while (!open.empty()) {
      const std::uint32_t here = open.back();
      open.pop_back();
      if (reached[here]) continue;
      reached[here] = true;
      open.insert(open.end(), next_[here].begin(), next_[here].end());
    }
    return reached;
  }

  std::optional<AutomatonId> called_by(const Assignment& update) const {
    const auto called = protocol_.gated(update.variable);
    return called == id_ ? std::nullopt : called;
  }

  bool calls(const Edge& edge) const {
    return std::ranges::any_of(edge.updates, [&](const Assignment& update) {
      return called_by(update).has_value();
    });
  }

  // The edge demands a status of the child it calls and writes another, and
  // with that one the child never writes the demanded one before its turn ends.
  bool takes_away(const Edge& edge) const {
    std::optional<AutomatonId> child;
    for (const Assignment& update : edge.updates) {
      const auto called = called_by(update);
      if (called && child) return false;
      if (called) child = called;
    }
    if (!child) return false;
    const Automaton& called = network_.automaton(*child);
    const VariableId status = network_.node_status[index(called.node)];
    const auto demanded = demanded_value(edge.guard, status);
    std::optional<int> asked;
    for (const Assignment& update : edge.updates) {
      if (update.variable == status) asked = constant_value(update);
    }
    if (!demanded || !asked || *asked == *demanded) return false;
    const auto writes_it = [&](const Edge& its) {
      return may_write(its, status, *demanded);
    };
    return std::ranges::none_of(called.edges, writes_it) ||
           ends_otherwise(*child, status, *asked, *demanded);
  }

  // A child called with `asked` in its status never writes `demanded`.
  bool ends_otherwise(AutomatonId child, VariableId status, int asked,
                      int demanded) const {
    const Automaton& called = network_.automaton(child);
    const OwnCycles turn(network_, protocol_, child);
    for (const Edge& first : called.edges) {
      if (index(first.source) != 0 || excludes(first.guard, status, asked)) {
        continue;
      }
      if (may_write(first, status, demanded)) return false;
      const auto reached = turn.reached_from(index(first.target));
      for (const Edge& later : called.edges) {
        if (reached[index(later.source)] &&
            may_write(later, status, demanded)) {
          return false;
        }
      }
    }
    return true;
  }

  const Network& network_;
  const CallProtocol& protocol_;
  AutomatonId id_;
  const Automaton& automaton_;
  // By location: where its edges lead within the turn.
  std::vector<std::vector<std::uint32_t>> next_;
};

}  // namespace

std::vector<LocationId> cycle_heads(const Network& network,
                                    const CallProtocol& protocol,
                                    AutomatonId automaton) {
  return OwnCycles(network, protocol, automaton).heads();
}

}  // namespace btcheck
