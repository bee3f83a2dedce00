// SPDX-License-Identifier: MIT
//
// Where fair runs come to rest: built-in justice and strong fairness.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "explore/search/stored_graph.hpp"

namespace btcheck {

// The steps of a stored graph, backwards: by state, where its steps come from.
class Predecessors {
 public:
  explicit Predecessors(const StoredGraph& graph);

  std::span<const std::uint32_t> of(std::size_t state) const {
    return {sources_.data() + first_[state],
            sources_.data() + first_[state + 1]};
  }

  // The states with a step into `target`.
  StateSet before(const StateSet& target) const;

  // The states from which a path leads into `target` all of whose states but
  // the last are in `hold`; those of `target` among them.
  StateSet leading_to(const StateSet& hold, const StateSet& target) const;

 private:
  std::vector<std::uint64_t> first_;  // by state: its first source
  std::vector<std::uint32_t> sources_;
};

// A strong fairness condition on one graph, as sets of its states: requested
// infinitely often, therefore granted infinitely often.
struct FairnessSets {
  StateSet requested;
  StateSet granted;
};

// A run is fair when it makes progress infinitely often (built-in justice: no
// condition where every step is progress) and keeps every strong condition.
//
// The states of `within` that lie in a strongly connected part of it which a
// fair run can go round in for ever, seeing every state of it. Different parts
// are different components of the states returned. After Lichtenstein and
// Pnueli (POPL 1985): each round takes time linear in the graph, and there are
// at most `conditions.size() + 1` rounds.
StateSet fair_components(const StoredGraph& graph, const StateSet& within,
                         std::span<const FairnessSets> conditions);

// A cycle through `state`, one of a set that fair_components has returned, by
// whose repetition a run is fair: `state` first, the last one leads back to
// it. Not the shortest, but each leg of it is.
std::vector<StateId> fair_cycle(const StoredGraph& graph,
                                const StateSet& fair_components, StateId state,
                                std::span<const FairnessSets> conditions);

// The fair runs of one graph: what all formulas about it have in common. The
// graph, closed, must outlive it. To make it takes as long as an operator
// AF does, so properties of one graph should share it.
class FairRuns {
 public:
  explicit FairRuns(const StoredGraph& graph,
                    std::vector<FairnessSets> conditions = {})
      : graph_(graph),
        conditions_(std::move(conditions)),
        predecessors_(graph),
        fair_(starts_within(~StateSet(graph.size()))) {}

  const StoredGraph& graph() const { return graph_; }
  std::span<const FairnessSets> conditions() const { return conditions_; }
  const Predecessors& predecessors() const { return predecessors_; }

  // The states where a fair run begins.
  const StateSet& starts() const { return fair_; }
  // The states where a run begins that is fair and never leaves `hold`.
  StateSet starts_within(const StateSet& hold) const {
    return predecessors_.leading_to(hold,
                                    fair_components(graph_, hold, conditions_));
  }

 private:
  const StoredGraph& graph_;
  std::vector<FairnessSets> conditions_;
  Predecessors predecessors_;
  StateSet fair_;
};

}  // namespace btcheck
