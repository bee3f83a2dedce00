// SPDX-License-Identifier: MIT
//
// The rules of a file as monitors: what a run that goes on says about each.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/bind/verdict.hpp"
#include "check/replay/replay.hpp"
#include "ltl/monitor/monitor.hpp"
#include "model/automata/network.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// A rule to be watched. Bit i of a label is propositions[i], which is about
// single states.
struct RuleMonitor {
  const BoundProperty* rule = nullptr;
  Monitor monitor;
  std::vector<StatePredicate> propositions;
  // Of a real-time pattern: true where a unit of time has passed. 0: the rule
  // does not speak of time.
  PropositionSet elapsed = 0;
};

// A monitor for each rule of a file, which must outlive the result. Refused is
// what no single run shows (BT1801), events of steps (BT1802), and what is too
// large (BT1803); warned of what no beginning of a run decides (BT1804).
// Strong fairness never ends a run and is not looked at.
Result<std::vector<RuleMonitor>> monitors_of(const BoundFile& file,
                                             const SourceText& source);

// All rules along one run of a network, state by state.
class RunMonitor {
 public:
  // Both must outlive it.
  RunMonitor(const Network& network, const std::vector<RuleMonitor>& rules);

  // The state that the run is in now, the first one included, and how many
  // units of time have passed since the one before.
  void see(const Valuation& state, int elapsed);

  // The outlook of each rule, and the number of the state that decided it.
  struct Seen {
    MonitorRun run;
    std::optional<std::size_t> decided;
  };
  const std::vector<Seen>& rules() const { return seen_; }
  std::size_t states() const { return states_; }

 private:
  NetworkInterpreter interpreter_;
  const std::vector<RuleMonitor>& monitors_;
  std::vector<Seen> seen_;
  std::size_t states_ = 0;
};

}  // namespace btcheck
