// SPDX-License-Identifier: MIT
#include "explore/reduce/called_with.hpp"

#include <algorithm>

#include "explore/reduce/contexts.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

constexpr std::int64_t kMostStatuses = 64;
// Arcs, each for each child.
constexpr std::size_t kMostVisits = 20'000'000;

using Values = std::uint64_t;

// Of a status: what an automaton writes into it.
class Status {
 public:
  Status(const Network& network, VariableId variable)
      : network_(network),
        variable_(variable),
        of_(network.variable(variable)) {}

  bool is_small() const { return of_.domain_size() <= kMostStatuses; }
  VariableId variable() const { return variable_; }
  int lowest() const { return of_.min; }
  Values initial() const { return bit(of_.initial); }
  Values every() const {
    return ~Values{0} >> (kMostStatuses - of_.domain_size());
  }
  Values excluded(const Expression& guard) const {
    return excluded_values(network_, guard, variable_);
  }
  // Nothing where the edge does not write it.
  std::optional<Values> written(const Edge& edge) const {
    std::optional<Values> written;
    for (const Assignment& update : edge.updates) {
      if (update.variable != variable_) continue;
      const auto value = constant_value(update);
      const bool is_in = value && *value >= of_.min && *value <= of_.max;
      written = is_in ? bit(*value) : every();
    }
    return written;
  }
  Values written(const Automaton& automaton) const {
    Values all = 0;
    for (const Edge& edge : automaton.edges) all |= written(edge).value_or(0);
    return all;
  }

 private:
  Values bit(int value) const { return Values{1} << (value - of_.min); }

  const Network& network_;
  VariableId variable_;
  const Variable& of_;
};

// What an edge of the parent does with one child.
struct Use {
  Values excluded = 0;
  std::optional<Values> written;
  bool calls = false;
};

// With which statuses a parent calls one child after the other.
class Parent {
 public:
  Parent(const Automaton& automaton, const Contexts& contexts)
      : automaton_(automaton),
        contexts_(contexts),
        mentions_(automaton),
        uses_(automaton.edges.size()) {}

  CalledWith entry(const Status& status, const Automaton& child,
                   bool is_called_first) {
    CalledWith entry{status.variable(), status.lowest(), 0,
                     status.written(automaton_)};
    const Values left = status.written(child);
    const auto& asked = mentions_.of(status.variable());
    const auto& called = mentions_.of(*child.gate);
    for (const auto& mention : asked) {
      const Edge& edge = automaton_.edges[mention.edge];
      uses_[mention.edge].emplace();
      uses_[mention.edge]->excluded = status.excluded(mention.guard);
      uses_[mention.edge]->written = status.written(edge);
    }
    for (const auto& mention : called) {
      if (!uses_[mention.edge]) uses_[mention.edge].emplace();
      uses_[mention.edge]->calls = calls(mention.edge, *child.gate);
    }
    std::vector<Values> values(contexts_.size(), 0);
    std::vector<std::uint32_t> open = {Contexts::kInitial};
    values[Contexts::kInitial] = status.initial();
    if (is_called_first) {
      entry.entered = status.initial();
      values[Contexts::kInitial] |= left;
    }
    while (!open.empty()) {
      const std::uint32_t context = open.back();
      open.pop_back();
      contexts_.for_each_arc_from(context, [&](const Contexts::Arc& arc) {
        Values here = values[context];
        if (const auto& use = uses_[arc.edge]) {
          here &= ~use->excluded;
          if (here != 0) here = use->written.value_or(here);
          if (use->calls) {
            entry.entered |= here;
            if (here != 0) here |= left;
          }
        }
        if ((here & ~values[arc.to]) == 0) return;
        values[arc.to] |= here;
        open.push_back(arc.to);
      });
    }
    for (const auto* all : {&asked, &called}) {
      for (const auto& mention : *all) uses_[mention.edge].reset();
    }
    return entry;
  }

 private:
  bool calls(std::uint32_t edge, VariableId gate) const {
    bool calls = false;
    for (const Assignment& update : automaton_.edges[edge].updates) {
      if (update.variable == gate) calls = constant_value(update) != 0;
    }
    return calls;
  }

  const Automaton& automaton_;
  const Contexts& contexts_;
  const Mentions mentions_;
  std::vector<std::optional<Use>> uses_;  // by edge
};

}  // namespace

std::vector<std::optional<CalledWith>> called_with(const Network& network,
                                                   const CallProtocol& protocol,
                                                   const Accesses& accesses) {
  std::vector<std::optional<CalledWith>> entries(network.automata.size());
  if (!protocol.holds()) return entries;
  std::vector<AutomatonId> order;
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    if (!protocol.parent(AutomatonId{a})) order.push_back(AutomatonId{a});
  }
  for (std::size_t next = 0; next < order.size(); ++next) {
    ask_budget();
    const AutomatonId id = order[next];
    const auto& below = protocol.children(id);
    if (below.empty()) continue;
    order.insert(order.end(), below.begin(), below.end());
    const Automaton& automaton = network.automaton(id);
    if (!accesses.moves_alone(network, id)) continue;
    const Contexts contexts(network, automaton, kMostVisits / below.size(),
                            entries[index(id)]);
    if (contexts.arcs().size() > kMostVisits / below.size()) continue;
    Parent parent(automaton, contexts);
    for (const AutomatonId each : below) {
      const Automaton& child = network.automaton(each);
      if (child.kind != AutomatonKind::Node || !child.gate) continue;
      const Status status(network, network.node_status[index(child.node)]);
      const AutomatonId family[] = {id, each};
      const bool is_theirs =
          accesses.are_written_only_by(family, status.variable());
      if (!status.is_small() || !is_theirs) continue;
      entries[index(each)] = parent.entry(
          status, child, network.variable(*child.gate).initial != 0);
    }
  }
  return entries;
}

}  // namespace btcheck
