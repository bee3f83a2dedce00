// SPDX-License-Identifier: MIT
#include "trace/explain/explain.hpp"

#include <algorithm>

#include "check/questions/defaults.hpp"
#include "explore/state/step.hpp"
#include "model/sampling.hpp"

namespace btcheck {
namespace {

// What is asked besides, only where it is small: each fault of the table has a
// search of its own.
constexpr std::uint64_t kMostForTable = 20'000;
constexpr std::uint64_t kMostForFindings = 500'000;

Limits at_most(Limits limits, std::uint64_t states) {
  limits.max_states = std::min(limits.max_states, states);
  return limits;
}

std::vector<FaultRowInTable> rows_of(const ExplainInput& input,
                                     const Suspect& suspect,
                                     const Limits& limits) {
  const WhatIfInput asked{input.for_table, input.tree.source, {}, {}};
  WhatIfOptions how;
  how.ticks = input.tree.ticks;
  how.limits = at_most(limits, kMostForTable);
  how.threads = input.threads;
  const auto table = what_if(asked, how);
  if (!table.value || table.value->healthy.stopped != StopReason::None) {
    return {};
  }
  std::vector<FaultRowInTable> found;
  const auto& rows = table.value->rows;
  for (const InjectedFault& fault : suspect.faults) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const InjectedFault& row = rows[i].faults.front();
      if (row.leaf != fault.leaf || row.fault.kind != fault.fault.kind) {
        continue;
      }
      found.push_back({fault, i + 1, rows[i].harm});
    }
  }
  return found;
}

class Explainer {
 public:
  Explainer(const ExplainInput& input, const ExplainedLog& log,
            const Limits& limits)
      : input_(input), log_(log), limits_(limits) {}

  Explanation take() {
    const BehaviorTree& tree = input_.tree.tree;
    made_.causes = causes_of(log_.moments);
    Ways ways(tree, input_.network, limits_);
    made_.followed = ways.follow(log_);
    made_.progress = made_.followed.progress;
    note(made_.followed.stopped);
    if (is_over()) return std::move(made_);
    made_.suspects = suspects_of(input_.tree, log_, made_.causes, limits_);
    note(made_.suspects.stopped);
    if (made_.is_refused() || is_over()) return std::move(made_);
    if (!has_ended_well()) look_for_ways(ways);
    look_for_rows();
    look_for_findings();
    return std::move(made_);
  }

 private:
  void note(StopReason stopped) {
    if (made_.stopped == StopReason::None) made_.stopped = stopped;
  }
  bool is_over() const { return made_.stopped != StopReason::None; }
  bool has_ended_well() const {
    const Outcome outcome = log_.moments.last().outcome;
    return outcome == Outcome::Success || outcome == Outcome::Nothing;
  }

  void look_for_ways(Ways& ways) {
    if (!made_.followed.refused) {
      made_.last_way = ways.last_way(log_);
      made_.is_hopeless = ways.is_hopeless();
    }
    if (made_.suspects.single.empty()) return;
    const std::vector<InjectedFault> fault{
        made_.suspects.single.front().faults.front()};
    const BehaviorTree tree =
        with_faults(input_.tree.tree, fault, Others::Work);
    const auto network =
        lower_values(tree, input_.tree.source, input_.tree.ticks);
    if (!network.value) return;
    Ways with_fault(tree, *network.value, limits_);
    // The nearest fault of the table may not be this one to the letter.
    if (!with_fault.follow(log_).conforms()) return;
    made_.last_way_with_fault = with_fault.last_way(log_);
    made_.is_hopeless_with_fault = with_fault.is_hopeless();
  }

  void look_for_rows() {
    if (made_.suspects.single.empty() || !limits_.has_spare()) return;
    made_.rows = rows_of(input_, made_.suspects.single.front(), limits_);
  }

  void look_for_findings() {
    if (!limits_.has_spare()) return;
    const CompiledNetwork system(input_.network);
    const DefaultReport report =
        check_defaults(input_.tree.tree, system, Reduction::Full,
                       at_most(limits_, kMostForFindings));
    made_.findings = findings_in(input_.tree.tree, report, log_.moments);
  }

  const ExplainInput& input_;
  const ExplainedLog& log_;
  const Limits& limits_;
  Explanation made_;
};

}  // namespace

Explanation explain(const ExplainInput& input, const ExplainedLog& log,
                    const Limits& limits) {
  return Explainer(input, log, limits).take();
}

}  // namespace btcheck
