// SPDX-License-Identifier: MIT
//
// The runs of a report, taken over or walked again in a tree that is much like
// the one it is of: what can be seen on them needs no search.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "check/parts/counterparts.hpp"
#include "check/questions/default_questions.hpp"
#include "check/questions/defaults.hpp"
#include "check/questions/inquiry.hpp"
#include "check/questions/reporter.hpp"
#include "check/questions/witnesses.hpp"
#include "check/search/searched_network.hpp"
#include "explore/search/reachability.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

class EarlierRuns {
 public:
  // Runs that are runs here as they stand are taken over; each other is taken
  // as far as it can be taken here, the shortest first, and only those that
  // show what has not been seen by then. Nothing of the network may be reduced.
  // All that is given must outlive this, but for the earlier report.
  EarlierRuns(const BehaviorTree& tree, const SearchedNetwork& whole,
              const Inquiry& inquiry, const Network& network,
              const Limits& limits, DefaultReport& report,
              const EarlierReport& earlier);
  EarlierRuns(const EarlierRuns&) = delete;
  EarlierRuns& operator=(const EarlierRuns&) = delete;

  // What is seen on both kinds of runs, of what nodes do and of sightings by
  // number.
  NodeQuestions shown(NodeId node) const;
  bool shows(std::size_t sighting) const { return shows_[sighting]; }
  // Those that are taken over, and what was seen on the others.
  const KnownAnswers& taken_over() const { return known_; }
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
    void show(StateId state, DefaultQuestions& visitor);
    bool is_shown(StateId state) const {
      return index(state) < is_shown_.size() && is_shown_[index(state)];
    }

    Expansion expansion_;
    std::vector<bool> is_shown_;  // by StateId
    // By state and edge.
    std::unordered_map<std::uint64_t, std::optional<StateId>> taken_;
  };

  // By place in an earlier report: the number that a sighting has here.
  using Numbers = std::vector<std::optional<std::size_t>>;

  void take_over(const Counterparts& here, const DefaultReport& earlier,
                 const Numbers& numbers);
  void walk(const Counterparts& here, const DefaultReport& earlier,
            const Numbers& numbers);
  std::optional<std::size_t> number_of(const Counterparts& here,
                                       const SightedRun& earlier) const;

  const Network& network_;
  const std::vector<Sighting>& sightings_;
  const std::vector<std::optional<Consequence>> consequences_;
  KnownAnswers known_;
  Walks walks_;
  DefaultQuestions questions_;
  Reporter reporter_;
  std::vector<bool> shows_;  // by number of the sighting
};

}  // namespace btcheck
