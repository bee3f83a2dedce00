// SPDX-License-Identifier: MIT
//
// A line is written as soon as its tick is over, so a long run can be watched
// and a pipe can be read while it goes on.
#include "cli/simulate.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <ostream>
#include <utility>
#include <vector>

#include "check/simulate/course.hpp"
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

// The lines of ticks are printed as they end.
Course course_of(const SimulationPlan& plan, TickLines& lines,
                 std::ostream& out) {
  return {plan.ticks,
          [] { return limits_of_command().reached() == StopReason::None; },
          [&](const Valuation&, const RunStep& step) {
            const std::string line = lines.take(step);
            if (!line.empty()) out << line << std::endl;
          }};
}

}  // namespace

Result<Simulation> simulate(const SimulatedTree& simulated,
                            const SimulationPlan& plan, std::ostream& out) {
  TickLines lines(simulated.tree, simulated.network);
  const Course course = course_of(plan, lines, out);
  const auto ended = [&](Result<Simulation> run) {
    if (run.value) out << lines.rest(run.value->state()) << std::flush;
    return run;
  };
  if (plan.seed) {
    return ended(simulated_at_random(simulated.tree, simulated.network,
                                     *plan.seed, course));
  }
  const auto file = read_file(plan.script);
  if (!file.value) return {std::nullopt, file.diagnostics};
  return ended(simulated_by_script(simulated.tree, simulated.network,
                                   {file.value->name, file.value->text},
                                   course));
}

std::string simulated_itf(const SimulatedTree& simulated, const Run& run,
                          const std::string& how) {
  return itf_text(recorded_simulation(simulated.tree, simulated.network,
                                      simulated.input, run, how));
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
    return lowered->code();
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
                                                           : lowered->code();
}

}  // namespace btcheck
