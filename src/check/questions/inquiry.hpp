// SPDX-License-Identifier: MIT
//
// What the default report asks of a tree, and what comes of the answers.
#pragma once

#include <optional>
#include <vector>

#include "check/findings/normal_tree.hpp"
#include "check/findings/suspicion.hpp"
#include "check/questions/defaults.hpp"
#include "check/questions/stale_guards.hpp"
#include "check/questions/witnesses.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

class Inquiry {
 public:
  // Both must outlive this.
  Inquiry(const BehaviorTree& tree, const Network& network);

  const std::vector<Sighting>& sightings() const { return sightings_; }
  const std::vector<Suspicion>& suspicions() const { return suspicions_; }
  // By number of the sighting: what has to follow on the run that shows it.
  std::vector<std::optional<Consequence>> consequences() const;

  // Writes what is known into a report. `of_tree` has been asked for the tree
  // as a whole, of all its states if `is_tree_complete`; with `is_complete` all
  // that has not been seen does not happen.
  void answer(const Seen& of_tree, bool is_tree_complete,
              const Evidence& evidence, bool is_complete,
              DefaultReport& report) &&;

 private:
  void answer_for_tree(const Seen& seen, bool is_complete,
                       const Evidence& evidence, DefaultReport& report) const;
  void report_guards(const Evidence& evidence, DefaultReport& report) const;

  const BehaviorTree& tree_;
  const Network& network_;
  NormalTree normal_;
  std::vector<Suspicion> suspicions_;
  std::vector<GuardedAction> guarded_;
  // Those of the suspicions in a row, and behind them those of the guards.
  std::vector<Sighting> sightings_;
};

}  // namespace btcheck
