// SPDX-License-Identifier: MIT
//
// Turns what a search has noted into answers with replayed runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "check/bind/verdict.hpp"
#include "check/findings/suspicion.hpp"
#include "check/questions/defaults.hpp"
#include "check/questions/watches.hpp"
#include "check/replay/replay.hpp"
#include "check/replay/run_tree.hpp"
#include "check/search/searched_network.hpp"
#include "explore/search/reachability.hpp"

namespace btcheck {

// All that is given must outlive this.
class Reporter {
 public:
  Reporter(const SearchedNetwork& searched,
           const Reachability<ReducedNetwork>& search, bool is_complete,
           const Network& network, const Limits& limits, DefaultReport& report);
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;
  ~Reporter();

  // Looks up the runs to these states of the search, the nearest first: where
  // no time is left for all of them, it is the longest that are not told.
  void look_up(std::vector<StateId> states);

  // A state or a step that was found, if any was.
  template <class First>
  Possibility possibility(const First& first) {
    Possibility answer;
    if (first) {
      answer.run = run_to(*first);
      if (answer.run) answer.verdict = Verdict::Holds;
    } else if (is_complete_) {
      answer.verdict = Verdict::Violated;
    }
    return answer;
  }

  // NoZeroTimeLoop, by the states of such a loop, if there is any.
  void never_loops(const std::vector<StateId>& loop);

  // Nothing where a step could not be replayed, or no time is left to do it.
  std::optional<KeptRun> run_to(StateId state);
  // A run on the way that the search found, up to the edge.
  std::optional<KeptRun> run_to(const FoundStep& last);
  // The same, and on from there until the node has answered; nothing where it
  // answers otherwise, or the world outside has a say.
  std::optional<KeptRun> run_to(const FoundStep& last, const Consequence& then);
  // Likewise on from a run of the network.
  std::optional<KeptRun> run_on(const KeptRun& run, const Consequence& then);

 private:
  using Place = RunTree::Place;

  std::optional<KeptRun> run_to(std::optional<Place> place) const;
  std::optional<Place> place_behind(const FoundStep& last);
  std::optional<KeptRun> run_on(Place place, const Consequence& then);
  // The step that comes next; nothing where it is not the tree's to decide.
  std::optional<std::uint32_t> only_edge(const Valuation& state) const;
  const ReducedNetwork& system() const { return searched_.system(); }
  StateVector words_of(StateId state) const;
  // Where the run to a state of the search ends. All runs come from one search,
  // so what they share is executed once.
  std::optional<Place> place_of(StateId state);
  std::vector<RunState> steps_between(const StateVector& from,
                                      const StateVector& to) const;
  // From a place on, with these steps.
  std::optional<Place> executed(Place place,
                                const std::vector<RunState>& steps);
  // Takes the place along with what is executed.
  Replayer::Taken following(Place& place);
  std::nullopt_t failed();
  bool has_time();
  KeptRun kept(const Run& run);
  // The step without time from one state to another; a node's if there is one.
  Step instant_step(const StateVector& from, const StateVector& to) const;
  // The way to the loop's first state, then once round: a lasso's loop begins
  // one step after its prefix.
  Lasso lasso_through(const std::vector<StateId>& loop) const;

  const SearchedNetwork& searched_;
  const Reachability<ReducedNetwork>& search_;
  bool is_complete_;
  const Limits& limits_;
  DefaultReport& report_;
  const Network& network_;
  NetworkInterpreter interpreter_;
  Replayer replayer_;
  std::shared_ptr<RunTree> runs_;
  std::unordered_map<std::uint32_t, Place> places_;  // by StateId
  std::optional<Place> at_;                          // where replayer_ is
  std::uint32_t asked_ = 0;
  bool is_late_ = false;
};

}  // namespace btcheck
