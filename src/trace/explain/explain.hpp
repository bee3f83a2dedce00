// SPDX-License-Identifier: MIT
//
// `btcheck explain LOG`: why a run ended so.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/whatif/whatif.hpp"
#include "explore/state/limits.hpp"
#include "trace/explain/causes.hpp"
#include "trace/explain/instances.hpp"
#include "trace/explain/moments.hpp"
#include "trace/explain/suspects.hpp"
#include "trace/explain/ways.hpp"

namespace btcheck {

// What `btcheck whatif` says of a fault.
struct FaultRowInTable {
  InjectedFault fault;
  std::size_t number = 0;  // from 1
  Harm harm{};
};

struct Explanation {
  // The tree as its contracts have it, followed in the log.
  Conformance followed;
  std::vector<Cause> causes;
  // Where the mission has not succeeded: the last place from which it still
  // could, as contracts allow; and with the first suspect's fault and all else
  // working.
  std::optional<LastWay> last_way;
  bool is_hopeless = false;  // it could not from its beginning on
  std::optional<LastWay> last_way_with_fault;
  bool is_hopeless_with_fault = false;
  Suspects suspects;
  std::vector<FaultRowInTable> rows;  // of the first suspect's faults
  std::vector<FindingInLog> findings;
  // A limit was reached: something of this is missing.
  StopReason stopped = StopReason::None;
  SearchProgress progress;

  // Neither the tree nor one of its faults can have written the log.
  bool is_refused() const {
    return followed.refused.has_value() && suspects.single.empty() &&
           suspects.together.empty();
  }
};

struct ExplainInput {
  ExplainedTree tree;
  const Network& network;  // of that tree
  // As `btcheck whatif` has it, where that is another one.
  const BehaviorTree& for_table;
  unsigned threads = 1;
};

Explanation explain(const ExplainInput& input, const ExplainedLog& log,
                    const Limits& limits);

}  // namespace btcheck
