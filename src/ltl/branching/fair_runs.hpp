// SPDX-License-Identifier: MIT
//
// The fair runs of one graph: what all formulas about it have in common.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "explore/search/stored_graph.hpp"
#include "ltl/branching/fair_components.hpp"
#include "ltl/branching/predecessors.hpp"

namespace btcheck {

// The graph, closed, must outlive it. To make it takes as long as an operator
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

  // Besides the graph.
  std::size_t bytes() const {
    return predecessors_.bytes() +
           (2 * conditions_.size() + 1) * (graph_.size() / 8);
  }

 private:
  const StoredGraph& graph_;
  std::vector<FairnessSets> conditions_;
  Predecessors predecessors_;
  StateSet fair_;
};

}  // namespace btcheck
