// SPDX-License-Identifier: MIT
//
// A network made ready to be searched for the answer to one question.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/bind/verdict.hpp"
#include "check/replay/replay.hpp"
#include "explore/components/composition.hpp"
#include "explore/reduce/live_variables.hpp"
#include "explore/reduce/reduced_network.hpp"

namespace btcheck {

// The network, reduced as far as the question allows, and the way back from
// what a search finds in it to a run of the network itself.
class SearchedNetwork {
 public:
  // Nothing reduced. The system must outlive this.
  explicit SearchedNetwork(const CompiledNetwork& system);
  // What is observed must be all that the search looks at. With `parts` all
  // else stands as components, where that keeps the answers: of linear time, in
  // which neither single steps nor dead states are seen.
  SearchedNetwork(const CompiledNetwork& system, const Observed& observed,
                  Reduction reduction, ComponentStore* parts = nullptr);
  // For a search that notices changes of `seen` at any moment, and looks at
  // `kept` only on certain steps of the nodes concerned.
  SearchedNetwork(const CompiledNetwork& system, const Observed& seen,
                  const Observed& kept, Reduction reduction);
  // With parts of the system as components: what is observed has to stand in
  // `parts`, which must outlive this, and is told in terms of its network.
  SearchedNetwork(const CompiledNetwork& system, const Composition& parts,
                  const Observed& seen, const Observed& kept);
  ~SearchedNetwork();
  SearchedNetwork(const SearchedNetwork&) = delete;
  SearchedNetwork& operator=(const SearchedNetwork&) = delete;

  const ReducedNetwork& system() const { return *reduced_; }
  // A run that is found here need not be a shortest one.
  bool is_reduced() const {
    return parts_ != nullptr || reduced_->is_reduced();
  }

  // The run that a search of `system()` has found, step by step, executed on
  // the network as it was given; sets `error` when it cannot be.
  std::optional<Run> replayed(const Lasso& found, std::string& error) const;
  // What executes such a run step by step; this must outlive it.
  Replayer replayer() const;

 private:
  void reduce(const Network& network, const Observed& seen,
              const Observed& kept, Reduction reduction);

  struct Parts;

  const CompiledNetwork& original_;
  std::unique_ptr<const Parts> own_parts_;
  const Composition* parts_ = nullptr;
  std::optional<LiveNetwork> live_;
  std::optional<CompiledNetwork> compiled_;  // live_'s
  std::optional<AmpleSets> ample_;
  std::optional<ReducedNetwork> reduced_;
};

// What is looked at when states are asked for, each predicate by itself. (One
// that only a dead state can meet does not care which step was the last.)
Observed observed_alone(const Network& network,
                        std::span<const StatePredicate> predicates);

// What a property's search looks at, its assumptions included.
Observed observed_by(const Network& network,
                     std::span<const StatePredicate> predicates);
Observed observed_by(const Network& network, const BoundFormula& formula,
                     const std::vector<FairnessPair>& conditions);

}  // namespace btcheck
