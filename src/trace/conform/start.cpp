// SPDX-License-Identifier: MIT
//
// A kept run names its steps in words, which change with what rules have the
// network remember. So it is followed by who takes them and what can be seen in
// its states; what cannot, clocks and counters of nodes, comes of executing the
// steps.
#include "trace/conform/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <string_view>
#include <utility>

#include "check/replay/replay.hpp"
#include "explore/state/step.hpp"
#include "text/choice.hpp"
#include "trace/conform/conform.hpp"

namespace btcheck {
namespace {

using States = std::vector<Valuation>;

Result<States> refused(std::string_view code, const std::string& file,
                       std::string message, std::string help) {
  Diagnostic found;
  found.code = code;
  found.file = file;
  found.message = std::move(message);
  found.help = std::move(help);
  return {std::nullopt, {std::move(found)}};
}

// Compares states of a network with recorded ones.
class Likeness {
 public:
  Likeness(const BehaviorTree& tree, const Network& network)
      : tree_(tree), network_(network) {}

  bool is_like(const Valuation& state, const RecordedState& seen) const {
    const auto statuses = status_names(tree_.profile);
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      const Automaton& automaton = network_.automaton(NodeId{n});
      const auto location =
          static_cast<std::size_t>(value(state, automaton.location));
      const auto status =
          static_cast<std::size_t>(value(state, network_.node_status[n]));
      if (automaton.locations[location].name != seen.locations[n] ||
          statuses[status] != seen.statuses[n]) {
        return false;
      }
    }
    for (std::size_t v = 0; v < tree_.variables.size(); ++v) {
      const int now = value(state, network_.state_variable[v]);
      if (tree_.variables[v].value_name(now) != seen.values[v]) return false;
    }
    return true;
  }

  // The run's nodes and variables are those of the tree.
  bool is_of(const RecordedRun& run) const {
    if (run.nodes.size() != tree_.nodes.size() ||
        run.variables.size() != tree_.variables.size()) {
      return false;
    }
    for (std::uint32_t n = 0; n < run.nodes.size(); ++n) {
      if (run.nodes[n].key != unique_name(tree_, NodeId{n})) return false;
    }
    return true;
  }

 private:
  static int value(const Valuation& state, VariableId variable) {
    return state.variables[index(variable)];
  }

  const BehaviorTree& tree_;
  const Network& network_;
};

// The steps that may be taken by the automaton that took the recorded one; time
// is a step too.
template <class Found>
void each_step(const Network& network, const NetworkInterpreter& interpreter,
               const Valuation& state, int elapsed, const RecordedStep& seen,
               Found&& found) {
  if (elapsed > 0) {
    if (interpreter.may_wait(state)) found(Step{kTimeStep, 1, true});
    return;
  }
  for (std::uint32_t edge = 0; edge < network.edge_count(); ++edge) {
    const bool is_its =
        interpreter.may_fire(state, edge) &&
        seen.step.starts_with(network.owner_of_edge(edge).name + ": ");
    if (is_its) found(Step{edge, 0, true});
  }
}

void add_once(States& states, Valuation state) {
  if (std::ranges::find(states, state) == states.end()) {
    states.push_back(std::move(state));
  }
}

}  // namespace

Result<States> states_after(const std::string& file, const BehaviorTree& tree,
                            const Network& network, const RecordedRun& run,
                            std::optional<int> tick) {
  const Likeness likeness(tree, network);
  const std::string help = "let btcheck write the run of this tree again";
  if (!likeness.is_of(run)) {
    return refused("BT1808", file, "this is a run of another tree",
                   fmt::format("it is of {}", run.tree));
  }
  if (run.ticks != tick_name(network.ticks)) {
    return refused("BT1808", file,
                   fmt::format("time passes at `{}` in this run, at `{}` here",
                               run.ticks, tick_name(network.ticks)),
                   word(Choice::Tick, run.ticks));
  }
  std::size_t last = run.states.size();
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    if (!tick || run.states[i].tick == *tick) last = i;
  }
  if (last == run.states.size()) {
    return refused("BT1305", file, fmt::format("the run has no tick {}", *tick),
                   fmt::format("its last tick is {}", run.states.back().tick));
  }
  const NetworkInterpreter interpreter(network);
  States here{interpreter.initial()};
  std::erase_if(here, [&](const Valuation& state) {
    return !likeness.is_like(state, run.states[0]);
  });
  for (std::size_t i = 1; i <= last && !here.empty(); ++i) {
    States next;
    const int elapsed = run.states[i].time - run.states[i - 1].time;
    for (const Valuation& state : here) {
      each_step(network, interpreter, state, elapsed, run.states[i],
                [&](const Step& step) {
                  Valuation after = interpreter.after(state, step);
                  if (likeness.is_like(after, run.states[i])) {
                    add_once(next, std::move(after));
                  }
                });
    }
    if (next.empty()) {
      return refused("BT1808", file,
                     fmt::format("this tree has no such run: not the step "
                                 "`{}` of tick {}",
                                 run.states[i].step, run.states[i].tick),
                     help);
    }
    here = std::move(next);
  }
  if (here.empty()) {
    return refused("BT1808", file, "this tree does not begin so", help);
  }
  return {std::move(here), {}};
}

Result<States> states_after(const std::string& file, const BehaviorTree& tree,
                            const Network& network,
                            const RecordedRun& recorded_tree,
                            const BehaviorLog& log, const LogReading& reading,
                            std::optional<int> tick, const Limits& limits) {
  if (tick && !knows_ticks(log, reading)) {
    return refused(
        "BT1814", file,
        fmt::format("this log does not show where its tick {} ends", *tick),
        fmt::format("attach btcheck::observer to the tree, or say {}",
                    word(Choice::TickGap, "MS")));
  }
  auto in_tree = placed(log, tree, recorded_tree);
  for (Diagnostic& found : in_tree.diagnostics) found.file = file;
  if (!in_tree.value) return {std::nullopt, std::move(in_tree.diagnostics)};
  const BehaviorLog& log_there = *in_tree.value;
  auto nodes = LoggedNodes::match(log_there, tree, recorded_tree);
  if (!nodes.value) {
    nodes.diagnostics.front().file = file;
    return {std::nullopt, std::move(nodes.diagnostics)};
  }
  const CompiledNetwork system(network);
  const Conformance found =
      conform(tree, system, log_there, *nodes.value, limits, tick, reading);
  if (found.stopped != StopReason::None) {
    return refused("BT1808", file,
                   "where the log ends was not found within the limits",
                   fmt::format("raise {} or {}", word(Choice::Memory),
                               word(Choice::Timeout)));
  }
  if (found.refused) {
    return refused("BT1808", file,
                   fmt::format("the tree cannot have written this log: not "
                               "its record {}",
                               *found.refused + 1),
                   "btcheck conform LOG TREE tells more");
  }
  States states;
  for (const StateVector& packed : found.states) {
    Valuation state;
    for (std::uint32_t v = 0; v < network.variables.size(); ++v) {
      state.variables.push_back(
          static_cast<int>(system.value(packed, VariableId{v})));
    }
    for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
      state.clocks.push_back(
          static_cast<int>(system.clock(packed, AutomatonId{a})));
    }
    states.push_back(std::move(state));
  }
  return {std::move(states), std::move(in_tree.diagnostics)};
}

bool has_clock(const Valuation& state) {
  return std::ranges::any_of(state.clocks, [](int clock) { return clock > 0; });
}

void begin_at(Network& network, const Valuation& state) {
  assert(!has_clock(state));
  for (std::size_t v = 0; v < network.variables.size(); ++v) {
    network.variables[v].initial = state.variables[v];
  }
}

}  // namespace btcheck
