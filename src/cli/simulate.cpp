// SPDX-License-Identifier: MIT
//
// A line is written as soon as its tick is over, so a long run can be watched
// and a pipe can be read while it goes on.
#include "cli/simulate.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <iostream>
#include <ostream>
#include <utility>
#include <variant>
#include <vector>

#include "check/simulate/script.hpp"
#include "cli/commands.hpp"
#include "cli/console/console.hpp"
#include "cli/from.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "text/budget.hpp"
#include "trace/formats/text.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

using Chooser = std::function<ScriptedChoice(const Simulation&)>;

// A root is about to begin a tick that was not asked for.
bool is_past(const Simulation& simulation, int ticks) {
  const auto choices = simulation.choices();
  if (choices[0].kind != ChoiceKind::Tick) return false;
  const Automaton& mover =
      simulation.network().owner_of_edge(choices[0].step.edge);
  return simulation.ticks(mover.node) >= ticks;
}

bool goes_on(const Simulation& simulation, int ticks) {
  if (limits_of_command().reached() != StopReason::None ||
      simulation.end() != RunEnd::None) {
    return false;
  }
  const bool only_moves = simulation.choices()[0].kind == ChoiceKind::Move;
  return (!only_moves || simulation.must_move()) && !is_past(simulation, ticks);
}

Result<Simulation> run_with(const SimulatedTree& simulated,
                            Interleaving interleaving, const Chooser& choose,
                            int ticks, std::ostream& out) {
  Simulation simulation(simulated.tree, simulated.network, interleaving);
  TickLines lines(simulated.tree, simulated.network);
  std::vector<Diagnostic> findings;
  while (findings.empty() && goes_on(simulation, ticks)) {
    ScriptedChoice choice = choose(simulation);
    if (auto* refusal = std::get_if<Diagnostic>(&choice)) {
      findings.push_back(std::move(*refusal));
      continue;
    }
    simulation.take(std::get<std::size_t>(choice));
    simulation.for_each_latest([&](const Valuation&, const RunStep& step) {
      const std::string line = lines.take(step);
      if (!line.empty()) out << line << std::endl;
    });
  }
  out << lines.rest(simulation.state()) << std::flush;
  return {std::move(simulation), std::move(findings)};
}

std::string how_trees_ended(const Simulation& simulation) {
  const BehaviorTree& tree = simulation.tree();
  std::string text;
  for (const NodeId root : tree.roots) {
    const VariableId status = simulation.network().node_status[index(root)];
    const auto answer =
        static_cast<std::size_t>(simulation.state().variables[index(status)]);
    text +=
        fmt::format("{}{} ended with {} in tick {}", text.empty() ? "" : ", ",
                    tree.node(root).name, status_names(tree.profile)[answer],
                    simulation.ticks(root));
  }
  return text;
}

}  // namespace

int most_ticks(const Simulation& simulation) {
  int most = 0;
  for (const NodeId root : simulation.tree().roots) {
    most = std::max(most, simulation.ticks(root));
  }
  return most;
}

std::string ending_text(const Simulation& simulation, int ticks) {
  const int last = most_ticks(simulation);
  switch (simulation.end()) {
    case RunEnd::Ended:
      return how_trees_ended(simulation);
    case RunEnd::Fault:
      return fmt::format(
          "a fault ended the run in tick {}: an assignment out of range, or a "
          "division by zero",
          last);
    case RunEnd::Stuck:
      return fmt::format("the tree is stuck in tick {}: no node can go on",
                         last);
    case RunEnd::None:
      break;
  }
  return last >= ticks
             ? fmt::format("stopped after {} tick{}; --ticks asks for more",
                           ticks, ticks == 1 ? "" : "s")
             : fmt::format("stopped in tick {}", last);
}

Result<Simulation> simulate(const SimulatedTree& simulated,
                            const SimulationPlan& plan, std::ostream& out) {
  if (plan.seed) {
    SplitMix64 random(*plan.seed);
    return run_with(
        simulated, Interleaving::Open,
        [&](const Simulation& simulation) {
          return random_choice(simulation.choices(), random);
        },
        plan.ticks, out);
  }
  auto file = read_file(plan.script);
  if (!file.value) return {std::nullopt, std::move(file.diagnostics)};
  const InputFile& text = *file.value;
  auto script = read_simulation_script(simulated.tree, simulated.network,
                                       text.name, text.text);
  if (!script.value) return {std::nullopt, std::move(script.diagnostics)};
  const SourceText source(text.name, text.text);
  ScriptPlayer player(*script.value, source);
  return run_with(
      simulated, Interleaving::InOrder,
      [&](const Simulation& simulation) { return player.choose(simulation); },
      plan.ticks, out);
}

std::string simulated_itf(const SimulatedTree& simulated, const Run& run,
                          const std::string& how) {
  RunHeading heading;
  heading.property = how;
  heading.formula = "one run of many; no property is checked";
  heading.verdict = "SIMULATED";
  add_sources(heading, simulated.tree, simulated.input);
  return itf_text(recorded(simulated.tree, simulated.network, run, heading));
}

namespace {

// A run that a limit or a signal has ended is kept all the same, where that is
// done soon and in the memory that there is.
class ToKeep final : public Budget {
 public:
  Spent look() override {
    ProcessLimits& limits = limits_of_command();
    const Spent spent = limits.overdrawn();
    return spent == Spent::Memory || !limits.may_tell() ? spent
                                                        : Spent::Nothing;
  }
};

constexpr std::size_t kSample = 64;  // steps, all much of a size

// Of more than a sample: about how many bytes its file has.
std::size_t kept_bytes(const SimulatedTree& simulated, const Run& run,
                       const std::string& how) {
  Run part{run.initial, {}, kNoLoop};
  const std::size_t begin = simulated_itf(simulated, part, how).size();
  part.steps.assign(run.steps.begin(), run.steps.begin() + kSample);
  const std::size_t step =
      (simulated_itf(simulated, part, how).size() - begin) / kSample;
  return begin + step * run.steps.size();
}

}  // namespace

std::string keep_run(const std::string& file, const SimulatedTree& simulated,
                     const Run& run, const std::string& how) {
  const auto refused = [&](const std::string& reason) {
    return fmt::format("cannot write `{}`: {}", file, reason);
  };
  const auto too_long = [&](std::size_t bytes) {
    return refused(
        fmt::format("{} steps take {} MiB, and `trace` reads {}; ask "
                    "for fewer --ticks",
                    run.steps.size(), bytes >> 20, kMostInputBytes >> 20));
  };
  ToKeep budget;
  const BudgetScope scope(&budget);
  try {
    if (run.steps.size() > kSample) {
      const std::size_t about = kept_bytes(simulated, run, how);
      if (about > kMostInputBytes) return too_long(about);
    }
    const std::string text = simulated_itf(simulated, run, how);
    if (text.size() > kMostInputBytes) return too_long(text.size());
    return write_file(file, text);
  } catch (const BudgetSpent& spent) {
    const bool is_memory = spent.spent() == Spent::Memory;
    return refused(
        fmt::format("{} before {} steps of {} nodes were put into words; {}",
                    is_memory ? "--memory was reached" : "it was time to end",
                    run.steps.size(), simulated.tree.nodes.size(),
                    is_memory ? "raise it, or ask for fewer --ticks"
                              : "ask for fewer --ticks"));
  }
}

ExitCode run_simulate(const Options& options) {
  auto lowered = read_and_lower(options);
  if (!lowered) return ExitCode::BadInput;
  {
    const Watch start(options);
    if (!begin_from(options, lowered->tree, lowered->input, lowered->network,
                    start.limits)) {
      return ExitCode::BadInput;
    }
  }
  const SimulatedTree simulated{lowered->tree, lowered->network,
                                lowered->input};
  const SimulationPlan& plan = options.simulation;
  const auto out = printing_stream();
  // It ends between two steps, and the run is kept.
  const BudgetScope own_way(nullptr);
  Guard::dismiss();
  if (!plan.seed && plan.script.empty()) {
    InterruptWatch::stand_down();
    step_through(simulated, std::cin, *out,
                 ::isatty(STDIN_FILENO) != 0 ? Echo::No : Echo::Yes);
    return lowered->code;
  }
  auto [run, findings] = simulate(simulated, plan, *out);
  if (run && !options.output.empty()) {
    const std::string how = plan.seed ? fmt::format("seed {}", *plan.seed)
                                      : "script " + plan.script;
    const std::string complaint =
        keep_run(options.output, simulated, run->run(), how);
    if (!complaint.empty()) {
      findings.push_back(file_error("BT0004", "", complaint));
    }
  }
  if (findings.empty() && !options.is_quiet) {
    tell(ending_text(*run, plan.ticks) + '\n');
  }
  show(options, findings);
  if (has_error(findings)) return ExitCode::BadInput;
  return limits_of_command().reached() != StopReason::None ? ExitCode::Undecided
                                                           : lowered->code;
}

}  // namespace btcheck
