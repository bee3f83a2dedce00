// SPDX-License-Identifier: MIT
//
// Random walks beside the search of the default report.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "check/questions/default_questions.hpp"
#include "check/questions/reporter.hpp"
#include "check/questions/witnesses.hpp"
#include "check/search/searched_network.hpp"
#include "explore/search/random_walks.hpp"

namespace btcheck {

// True when the search has come so far, or half of its time is over.
bool are_samples_due(std::size_t expanded, const Limits& limits);

// At most a quarter as many steps as the search has expanded states. All that
// is given must outlive this.
class Samples {
 public:
  Samples(const BehaviorTree& tree, const SearchedNetwork& searched,
          const std::vector<Sighting>& sightings, const Network& network,
          const Limits& limits, DefaultReport& report, std::size_t expanded);
  Samples(const Samples&) = delete;
  Samples& operator=(const Samples&) = delete;

  // Lines that say what was seen.
  std::string told(std::vector<Suspicion> suspicions) const;

  Seen seen() { return {questions_, reporter_}; }
  std::size_t bytes() const { return walks_.bytes(); }

 private:
  RandomWalks<ReducedNetwork> walks_;
  DefaultQuestions questions_;
  Reporter reporter_;
  Evidence evidence_;
};

}  // namespace btcheck
