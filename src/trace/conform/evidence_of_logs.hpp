// SPDX-License-Identifier: MIT
//
// What logs that conform show of the leaves: a contract to be read by a person,
// and the tests that are lacking.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "check/questions/defaults.hpp"
#include "model/tree/tree.hpp"
#include "trace/conform/conform.hpp"
#include "trace/logs/behavior_log.hpp"

namespace btcheck {

// Counted over any number of logs of one tree.
class LogEvidence {
 public:
  explicit LogEvidence(const BehaviorTree& tree)
      : tree_(tree), nodes_(tree.nodes.size()) {}

  void add(const BehaviorLog& log, const LoggedNodes& nodes,
           const LogReading& reading);

  // A contract for each type of leaf that the logs show, as a file for
  // --leaves: the answers seen and how many ticks they took, with a
  // margin that shrinks with their number, counts as comments. Leaves of the
  // engine itself have no contracts.
  std::string leaves_text() const;

  // "takeoff: failure": what the report has proven possible and no log shows,
  // for success, failure, running of leaves, halted and skipped.
  std::vector<std::string> unseen(const DefaultReport& report) const;
  // How many of these the logs show, and how many there are.
  struct Coverage {
    std::size_t seen = 0;
    std::size_t possible = 0;
  };
  Coverage coverage(const DefaultReport& report) const;

 private:
  struct Counts {
    std::size_t success = 0;
    std::size_t failure = 0;
    std::size_t running = 0;  // how often it began to run
    std::size_t halted = 0;
    // Of those that answered: ticks in which they ran before.
    std::int64_t shortest = INT64_MAX;
    std::int64_t longest = 0;
    std::int64_t longest_open = 0;  // of those halted, or running at the end
  };

  static std::string duration_text(const Counts& all);
  bool is_shown(NodeId node, NodeQuestion question) const;
  template <class Visit>
  void each_possible(const DefaultReport& report, Visit visit) const;

  const BehaviorTree& tree_;
  std::vector<Counts> nodes_;  // by node
  std::size_t logs_ = 0;
  bool is_guessed_ = false;  // where ticks begin, in one of them
};

}  // namespace btcheck
