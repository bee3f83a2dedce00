// SPDX-License-Identifier: MIT
//
// The runs of a report, walked again in a tree that is much like the one it is
// of: what can be seen on them needs no search.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "check/bind/verdict.hpp"
#include "check/questions/default_questions.hpp"
#include "check/questions/defaults.hpp"
#include "check/questions/reporter.hpp"
#include "check/questions/witnesses.hpp"
#include "check/search/searched_network.hpp"
#include "explore/search/reachability.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// A report of a tree as it was before an edit, or of this one as far as it was
// searched. All must outlive this.
struct EarlierReport {
  const BehaviorTree& tree;
  const Network& network;
  const DefaultReport& report;
};

// Which node of a tree was which of an earlier one, by NodeId there: alike are
// those before the first that differs and those behind the last; what lies
// between is where there are as many.
std::vector<std::optional<NodeId>> nodes_since(const BehaviorTree& earlier,
                                               const BehaviorTree& tree);

class EarlierRuns {
 public:
  // Takes each run as far as it can be taken here, the shortest first, and only
  // those that show what has not been seen by then. Nothing of the network may
  // be reduced. All that is given must outlive this, but for the earlier
  // report.
  EarlierRuns(const BehaviorTree& tree, const SearchedNetwork& whole,
              const std::vector<Sighting>& sightings, const Network& network,
              const Limits& limits, DefaultReport& report,
              const EarlierReport& earlier);
  EarlierRuns(const EarlierRuns&) = delete;
  EarlierRuns& operator=(const EarlierRuns&) = delete;

  const DefaultQuestions& shown() const { return questions_; }
  Seen seen() { return {questions_, reporter_}; }

 private:
  // States on the runs, each with the steps that were asked for.
  class Walks : public Reachability<ReducedNetwork> {
   public:
    using Reachability::Reachability;

    StateId begin();
    // The state that this step leads to, if it can be taken. The visitor is
    // shown a state when it is left first.
    std::optional<StateId> follow(StateId from, const Step& step,
                                  DefaultQuestions& visitor);
    // Shows the state without leaving it.
    void look_at(StateId state, DefaultQuestions& visitor);

   private:
    Expansion expansion_;
    std::vector<bool> is_shown_;  // by StateId
    // By state and edge.
    std::unordered_map<std::uint64_t, std::optional<StateId>> taken_;
  };

  Walks walks_;
  DefaultQuestions questions_;
  Reporter reporter_;
};

}  // namespace btcheck
