// SPDX-License-Identifier: MIT
//
// From a run of the network to one that stands for itself.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// What is told of the run beside its states.
struct RunHeading {
  std::string property;  // its name
  std::string formula;   // its text
  std::string verdict;   // HOLDS, VIOLATED
  std::string why = {};
  std::string source = {};  // the text of the tree's file
  std::vector<WatchedPart> watched = {};
  // The state that waits for an answer, or that shows what is asked.
  std::optional<std::size_t> trigger = {};
  std::string trigger_words = {};        // what is said of it
  std::string end_words = {};            // and of the last state
  std::optional<std::size_t> lost = {};  // the state that breaks the rule
};

RecordedRun recorded(const BehaviorTree& tree, const Network& network,
                     const Run& run, const RunHeading& heading);

}  // namespace btcheck
