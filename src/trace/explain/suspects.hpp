// SPDX-License-Identifier: MIT
//
// Which fault of which leaf a log shows: the tree is followed with each of the
// faults that `btcheck whatif` puts into it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "check/whatif/faults.hpp"
#include "explore/state/limits.hpp"
#include "model/automata/network.hpp"
#include "text/input_file.hpp"
#include "trace/explain/causes.hpp"
#include "trace/explain/ways.hpp"

namespace btcheck {

// A leaf, and the faults with each of which the log conforms while all others
// work: the log does not tell them apart. The likeliest is the first.
struct Suspect {
  NodeId leaf{};
  std::vector<InjectedFault> faults;
  // Moments in which it did what it should not; of one that only ran long, when
  // that began and ended.
  std::vector<std::size_t> at;
  std::size_t answers = 0;  // that it gave in all
};

struct Suspects {
  // Why the tree cannot have written the log with all leaves working; of a log
  // that it can have written, nothing.
  std::optional<LogEvent> refused;
  std::int64_t refused_in = 0;  // the tick of that
  // One fault is enough; the likeliest first. Where none was needed: what would
  // have been one, if it was not meant.
  std::vector<Suspect> single;
  // Where no single one is enough: one of each of these leaves.
  std::vector<Suspect> together;
  // Where these are not enough either: leaves that have failed.
  std::vector<Suspect> failed;
  StopReason stopped = StopReason::None;

  bool is_needed() const { return refused.has_value(); }
};

// A tree as it was read, and how it is lowered.
struct ExplainedTree {
  const BehaviorTree& tree;
  SourceText source;
  TickSemantics ticks = TickSemantics::Root;
};

Suspects suspects_of(const ExplainedTree& tree, const ExplainedLog& log,
                     const std::vector<Cause>& causes, const Limits& limits);

}  // namespace btcheck
