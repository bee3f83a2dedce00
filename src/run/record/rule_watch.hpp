// SPDX-License-Identifier: MIT
//
// Rules that watch a run of an engine while it goes on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/check.hpp"
#include "check/monitor/rule_monitor.hpp"
#include "ltl/rules/property.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "run/engine/tree_engine.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// The rules of several files as monitors of one network.
class RunRules {
 public:
  RunRules() = default;
  RunRules(RunRules&&) = default;
  RunRules& operator=(RunRules&&) = default;

  // Gives the network what the rules need it to remember, so it is called once,
  // before the network is compiled. Refused is what a monitor cannot watch
  // (check/monitor), and a file that has time pass elsewhere than at ticks of
  // the root (BT1702). All must outlive it.
  static Result<RunRules> make(const BehaviorTree& tree, Network& network,
                               const std::vector<InputFile>& files);

  const std::vector<RuleMonitor>& monitors() const { return monitors_; }
  // Where a rule stands, by its number among the monitors.
  const SourceText& source(std::size_t rule) const { return *source_of_[rule]; }

 private:
  // Of one file. Its rules point into it.
  struct Bound {
    SourceText source;
    PropertyFile rules;
    BoundFile bound = {};
  };

  std::list<Bound> files_;
  std::vector<RuleMonitor> monitors_;
  std::vector<const SourceText*> source_of_;
};

// Shows the monitors each state, as the engine comes to it.
class RuleWatch : public EngineObserver {
 public:
  // Hears of a rule, by its number, as soon as it is violated whatever comes.
  using Broken = std::function<void(std::size_t rule, int tick)>;
  // Both must outlive it.
  RuleWatch(const TreeEngine& engine, const RunRules& rules, Broken broken);

  void began(StateView state) override { see(state, 0); }
  void stepped(StateView after, const Step& step) override {
    see(after, step.elapsed);
  }

  Outlook outlook(std::size_t rule) const {
    return monitor_.rules()[rule].run.outlook();
  }
  // The tick in which a rule was decided; 0: before the first, or not yet. What
  // happens between two ticks is counted with the second, as in a kept run.
  int decided(std::size_t rule) const { return decided_[rule]; }

 private:
  void see(StateView state, int elapsed);

  const TreeEngine& engine_;
  RunMonitor monitor_;
  std::vector<int> decided_;
  int last_ = -1;  // the tick before the time that has passed last
  Broken broken_;
};

}  // namespace btcheck
