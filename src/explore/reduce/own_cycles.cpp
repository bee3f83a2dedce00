// SPDX-License-Identifier: MIT
//
// The targets of back edges of a depth-first search break every cycle of a
// graph. One kind of cycle need not be broken: halting child after child. An
// edge that demands of a child the status s, asks it to halt, and so sees it
// end its turn with another status, takes away one child with status s; where
// all calls of a cycle's component are of this kind nothing gives one back, so
// there are no more rounds than children.
#include "explore/reduce/own_cycles.hpp"

#include <algorithm>

#include "explore/reduce/certainties.hpp"

namespace btcheck {
namespace {

class OwnCycles {
 public:
  OwnCycles(const Network& network, const CallProtocol& protocol,
            AutomatonId id)
      : network_(network),
        protocol_(protocol),
        id_(id),
        automaton_(network.automaton(id)),
        within_turn_(automaton_.locations.size()),
        reaches_(automaton_.locations.size()) {
    for (const Edge& edge : automaton_.edges) {
      if (ends_turn(automaton_, edge)) continue;
      within_turn_[index(edge.source)].push_back(index(edge.target));
    }
    for (std::uint32_t l = 0; l < reaches_.size(); ++l) explore(l);
  }

  std::vector<LocationId> heads() const;

 private:
  bool is_on_cycle(const Edge& edge) const {
    return !ends_turn(automaton_, edge) && !takes_time(network_, edge) &&
           reaches_[index(edge.target)][index(edge.source)];
  }
  bool share_cycle(const Edge& one, const Edge& other) const {
    return reaches_[index(one.target)][index(other.source)] &&
           reaches_[index(other.target)][index(one.source)];
  }

  void explore(std::uint32_t start);
  std::optional<AutomatonId> called_by(const Assignment& update) const;
  bool calls(const Edge& edge) const;
  bool takes_away(const Edge& edge) const;
  bool ends_otherwise(AutomatonId child, VariableId status, int asked,
                      int demanded) const;
  bool is_bounded(const Edge& edge,
                  const std::vector<const Edge*>& giving_back) const;

  const Network& network_;
  const CallProtocol& protocol_;
  AutomatonId id_;
  const Automaton& automaton_;
  // By location: where its edges lead, but for those that end a turn; and those
  // reached from it within a turn, itself included.
  std::vector<std::vector<std::uint32_t>> within_turn_;
  std::vector<std::vector<bool>> reaches_;
};

void OwnCycles::explore(std::uint32_t start) {
  std::vector<bool>& reached = reaches_[start];
  reached.resize(automaton_.locations.size(), false);
  reached[start] = true;
  std::vector<std::uint32_t> open{start};
  while (!open.empty()) {
    const std::uint32_t here = open.back();
    open.pop_back();
    for (const std::uint32_t target : within_turn_[here]) {
      if (reached[target]) continue;
      reached[target] = true;
      open.push_back(target);
    }
  }
}

std::optional<AutomatonId> OwnCycles::called_by(
    const Assignment& update) const {
  const auto called = protocol_.gated(update.variable);
  return called == id_ ? std::nullopt : called;
}

bool OwnCycles::calls(const Edge& edge) const {
  return std::any_of(
      edge.updates.begin(), edge.updates.end(),
      [&](const Assignment& update) { return called_by(update).has_value(); });
}

// Whether the edge may leave this value in the variable.
bool may_write(const Edge& edge, VariableId variable, int value) {
  return std::any_of(edge.updates.begin(), edge.updates.end(),
                     [&](const Assignment& update) {
                       return update.variable == variable &&
                              constant_value(update).value_or(value) == value;
                     });
}

bool ever_writes(const Automaton& automaton, VariableId variable, int value) {
  return std::any_of(
      automaton.edges.begin(), automaton.edges.end(),
      [&](const Edge& edge) { return may_write(edge, variable, value); });
}

// A child called with `asked` in its status never writes `demanded` in its
// turn.
bool OwnCycles::ends_otherwise(AutomatonId child, VariableId status, int asked,
                               int demanded) const {
  const Automaton& called = network_.automaton(child);
  const OwnCycles turn(network_, protocol_, child);
  for (const Edge& first : called.edges) {
    if (index(first.source) != 0 || excludes(first.guard, status, asked)) {
      continue;
    }
    if (may_write(first, status, demanded)) return false;
    for (const Edge& later : called.edges) {
      if (turn.reaches_[index(first.target)][index(later.source)] &&
          may_write(later, status, demanded)) {
        return false;
      }
    }
  }
  return true;
}

// The edge demands a status of the child it calls and writes another, and with
// that one the child never writes the demanded one before its turn ends.
bool OwnCycles::takes_away(const Edge& edge) const {
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
  return !ever_writes(called, status, *demanded) ||
         ends_otherwise(*child, status, *asked, *demanded);
}

// An edge that takes away, on no cycle with one that may give back.
bool OwnCycles::is_bounded(const Edge& edge,
                           const std::vector<const Edge*>& giving_back) const {
  return std::none_of(
      giving_back.begin(), giving_back.end(),
      [&](const Edge* other) { return share_cycle(edge, *other); });
}

std::vector<LocationId> OwnCycles::heads() const {
  enum class Mark : std::uint8_t { Unseen, OnPath, Left };
  std::vector<Mark> marks(automaton_.locations.size(), Mark::Unseen);
  std::vector<std::vector<std::uint32_t>> next(automaton_.locations.size());
  struct OnCycle {
    const Edge* edge = nullptr;
    bool takes_away = false;
  };
  std::vector<OnCycle> on_cycle;
  std::vector<const Edge*> giving_back;  // they call some child otherwise
  for (const Edge& edge : automaton_.edges) {
    if (!is_on_cycle(edge)) continue;
    on_cycle.push_back({&edge, takes_away(edge)});
    const bool gives_back = calls(edge) && !on_cycle.back().takes_away;
    if (gives_back) giving_back.push_back(&edge);
  }
  for (const OnCycle& each : on_cycle) {
    if (each.takes_away && is_bounded(*each.edge, giving_back)) continue;
    next[index(each.edge->source)].push_back(index(each.edge->target));
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

}  // namespace

std::vector<LocationId> cycle_heads(const Network& network,
                                    const CallProtocol& protocol,
                                    AutomatonId automaton) {
  return OwnCycles(network, protocol, automaton).heads();
}

}  // namespace btcheck
