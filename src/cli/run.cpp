// SPDX-License-Identifier: MIT
//
// `btcheck run TREE`: a tree executed, with leaves that answer in a process, by
// a script or at random. A line is written for each tick, as `simulate` writes
// them; breaches and broken rules are told on stderr as they happen. What is
// kept of the run is written when it is over.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "check/simulate/script.hpp"
#include "cli/commands.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/outputs/open_view.hpp"
#include "cli/outputs/record_files.hpp"
#include "report/text/report.hpp"
#include "run/engine/tick_clock.hpp"
#include "run/engine/tree_engine.hpp"
#include "run/leaves/scripted_leaves.hpp"
#include "run/process/process_leaves.hpp"
#include "run/record/recorder.hpp"
#include "run/record/rule_watch.hpp"
#include "run/view/server.hpp"
#include "run/view/view_teller.hpp"
#include "trace/live/live_run.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/run/itf.hpp"
#include "trace/watch/watched_run.hpp"

namespace btcheck {
namespace {

// Tells of breaches where they stand in the tree.
class BreachTeller : public EngineObserver {
 public:
  BreachTeller(const Lowered& lowered, const Options& options)
      : lowered_(lowered),
        options_(options),
        source_(lowered.input.name, lowered.input.text) {}

  void breached(const Breach& breach) override {
    const bool is_fatal = options_.run.on_breach == OnBreach::Stop;
    const Severity severity = is_fatal ? Severity::Error : Severity::Warning;
    std::string text = fmt::format("contract breached in tick {}: {}",
                                   breach.tick, breach.text);
    Diagnostic found = file_error("BT1703", "", text);
    if (breach.node) {
      const Node& node = lowered_.tree.node(*breach.node);
      found = source_.diagnostic(severity, "BT1703", node.span, std::move(text),
                                 std::string(breach_name(breach.kind)));
    }
    found.severity = severity;
    tell_exactly(shown({found}));
  }

  void stopped(NodeId node) override {
    if (options_.is_quiet) return;
    tell(
        fmt::format("`{}` is told to stop\n", short_name(lowered_.tree, node)));
  }

 private:
  const Lowered& lowered_;
  const Options& options_;
  SourceText source_;
};

// The leaves that the command line asks for, and what they are made of.
struct ChosenLeaves {
  std::optional<SimulationScript> script;
  std::unique_ptr<Leaves> leaves;
  ProcessLeaves* process = nullptr;
};

// Nothing, once it is said why, where they cannot be had.
std::optional<ChosenLeaves> leaves_for(const Options& options,
                                       const Lowered& lowered,
                                       const CompiledNetwork& system) {
  ChosenLeaves chosen;
  const SimulationPlan& plan = options.simulation;
  if (!options.run.leaves.empty()) {
    auto process = std::make_unique<ProcessLeaves>(
        lowered.tree, system,
        ProcessPlan{options.run.leaves,
                    std::chrono::milliseconds(options.run.answer_ms),
                    lowered.input.reading.tick_ms, plan.seed});
    chosen.process = process.get();
    chosen.leaves = std::move(process);
    return chosen;
  }
  if (plan.seed) {
    chosen.leaves =
        std::make_unique<RandomLeaves>(lowered.tree, system, *plan.seed);
    return chosen;
  }
  const auto file = read_file(plan.script);
  show(options, file.diagnostics);
  if (!file.value) return std::nullopt;
  auto script = read_simulation_script(lowered.tree, lowered.network,
                                       file.value->name, file.value->text);
  show(options, script.diagnostics);
  if (!script.value) return std::nullopt;
  chosen.script = std::move(*script.value);
  chosen.leaves =
      std::make_unique<ScriptedLeaves>(lowered.tree, *chosen.script);
  return chosen;
}

// Why such a tree is not run; nothing where it is.
std::optional<Diagnostic> refusal(const Lowered& lowered) {
  if (is_engine(lowered.tree.profile)) {
    return file_error(
        "BT1701", lowered.tree.file,
        "a tree for BehaviorTree.CPP keeps its own executor",
        "BehaviorTree.CPP runs it; `btcheck simulate` goes through its runs, "
        "and `btcheck trace` reads its logs");
  }
  if (lowered.network.ticks != TickSemantics::Root) {
    return file_error("BT1702", lowered.tree.file,
                      fmt::format("the rules say `tick {}`, and a run ticks "
                                  "the root",
                                  tick_name(lowered.network.ticks)),
                      "name the tree itself");
  }
  return std::nullopt;
}

// Ticks until the run is over.
void drive(TreeEngine& engine, TickClock& clock, int most_ticks) {
  const auto is_over = [&] {
    return limits_of_command().reached() != StopReason::None;
  };
  engine.begin();
  while (engine.state() == EngineState::Ready &&
         (most_ticks == 0 || engine.ticks() < most_ticks) &&
         clock.wait(is_over)) {
    clock.begin_tick();
    engine.tick();
    clock.end_tick();
  }
}

bool is_kept(const Options& options) {
  return !options.output.empty() || !options.run.btlog.empty();
}

// Writes what is kept of the run. False, once it is said why, where it cannot.
bool keep(const Options& options, const Lowered& lowered,
          const RunRecorder& recorder, const std::string& how) {
  if (!is_kept(options)) return true;
  const auto run =
      kept_run(lowered.tree, lowered.network, lowered.input, recorder, how);
  if (!run) throw std::logic_error("a step cannot be executed again");
  if (run->states.size() <= recorder.steps().size()) {
    tell(
        fmt::format("of {} steps the first {} are kept: more `trace` could "
                    "not read\n",
                    recorder.steps().size(), run->states.size() - 1));
  }
  std::vector<Diagnostic> findings;
  const auto write = [&](const std::string& file, const std::string& text) {
    const std::string complaint = write_file(file, text);
    if (!complaint.empty()) {
      findings.push_back(file_error("BT0004", "", complaint));
    }
  };
  if (!options.output.empty()) write(options.output, itf_text(*run));
  if (!options.run.btlog.empty()) {
    write(options.run.btlog, btlog_bytes(*run, 1));
  }
  show(options, findings);
  return findings.empty();
}

std::string how_it_ran(const Options& options) {
  const SimulationPlan& plan = options.simulation;
  if (!options.run.leaves.empty()) return "run with " + options.run.leaves;
  if (plan.seed) return fmt::format("run with seed {}", *plan.seed);
  return "run with script " + plan.script;
}

std::string ending_of(const TreeEngine& engine, const TickClock& clock,
                      int tick_ms) {
  std::string text = engine_end_text(engine);
  if (engine.breaches() > 0) {
    text += "; " + counted(engine.breaches(), "breach", "breaches");
  }
  if (clock.overruns() > 0) {
    text += fmt::format("; {} took longer than {} ms",
                        counted(clock.overruns(), "tick", "ticks"), tick_ms);
  }
  return text;
}

ExitCode code_of(const TreeEngine& engine) {
  if (engine.breaches() > 0 || engine.state() == EngineState::Fault ||
      engine.state() == EngineState::Stuck) {
    return ExitCode::Missed;
  }
  return engine.state() == EngineState::Ready &&
                 limits_of_command().reached() != StopReason::None
             ? ExitCode::Undecided
             : ExitCode::Met;
}

// Whether the files of the run are its own.
bool claim(const Options& options, ClaimedFiles& files) {
  for (const std::string& name : {options.output, options.run.btlog}) {
    const std::string complaint = files.claim(name);
    if (complaint.empty()) continue;
    complain("BT0004", complaint);
    return false;
  }
  return true;
}

// A run that is shown while it goes on.
struct RunView {
  RunView(const Options& options, const Lowered& lowered)
      : run(beginning_of_run(lowered.tree, lowered.network, lowered.input,
                             how_it_ran(options))),
        server(run),
        steps(lowered.tree, lowered.network, run) {}

  void finish(const std::string& ending) {
    steps.finish(ending, server.is_watched() ? kViewPatience
                                             : std::chrono::milliseconds(0));
    server.finish(kViewPatience);
  }

  LiveRun run;
  LiveServer server;
  ViewTeller steps;
};

// A rule that has just been broken, where it stands.
void tell_broken(const RunRules& rules, std::size_t rule, int tick) {
  const Property& broken = *rules.monitors()[rule].rule->property;
  const bool is_expected = broken.expectation == Expectation::Violated;
  tell_exactly(shown({rules.source(rule).diagnostic(
      is_expected ? Severity::Note : Severity::Error, "BT1706", broken.span,
      fmt::format("`{}` is violated in tick {}", broken.name, tick),
      is_expected ? "as expected" : "")}));
}

// What the rules have come to.
WatchReport watched(const Options& options, const RunRules& rules,
                    const TreeEngine& engine, const RuleWatch& watch) {
  WatchReport report;
  report.heading = fmt::format(
      "{}: {}", options.input,
      counted(static_cast<std::uint64_t>(engine.ticks()), "tick", "ticks"));
  for (std::size_t i = 0; i < rules.monitors().size(); ++i) {
    report.rules.push_back(
        watched_rule(*rules.monitors()[i].rule, watch.outlook(i)));
    report.rules.back().tick = watch.decided(i);
  }
  return report;
}

// Runs the tree, with lines, breaches and broken rules told as they come.
ExitCode execute(const Options& options, const Lowered& lowered,
                 const RunRules& rules, const CompiledNetwork& system,
                 ChosenLeaves& chosen, RunView* view) {
  const auto out = printing_stream();
  const int tick_ms = lowered.input.reading.tick_ms;
  TreeEngine engine(lowered.tree, system, *chosen.leaves,
                    options.run.on_breach);
  TickClock clock(
      options.run.is_at_once ? TickPace::AtOnce : TickPace::RealTime,
      std::chrono::milliseconds(tick_ms));
  RunRecorder recorder;
  TickTeller lines(lowered.tree, system,
                   [&](const std::string& line) { *out << line << std::endl; });
  BreachTeller breaches(lowered, options);
  RuleWatch watch(engine, rules, [&](std::size_t rule, int tick) {
    tell_broken(rules, rule, tick);
  });
  if (is_kept(options)) engine.add(recorder);
  if (view != nullptr) engine.add(view->steps);
  engine.add(lines);
  engine.add(breaches);
  if (!rules.monitors().empty()) engine.add(watch);
  drive(engine, clock, options.simulation.ticks);
  *out << lines.rest() << std::flush;
  engine.stop();
  const std::string ending = ending_of(engine, clock, tick_ms);
  if (chosen.process != nullptr) chosen.process->end(ending);
  if (view != nullptr) view->finish(ending);
  if (!options.is_quiet) tell(ending + '\n');
  const WatchReport report = watched(options, rules, engine, watch);
  if (!report.rules.empty()) *out << '\n' << watch_text(report) << std::flush;
  if (!keep(options, lowered, recorder, how_it_ran(options))) {
    return ExitCode::BadInput;
  }
  return is_broken(report) ? ExitCode::Missed : code_of(engine);
}

}  // namespace

ExitCode run_run(const Options& options) {
  std::vector<Diagnostic> found;
  auto inputs = read_inputs(options, found);
  if (!inputs) return ExitCode::BadInput;
  const std::vector<InputFile> properties = std::move(inputs->properties);
  auto lowered = lowered_from(std::move(*inputs), options);
  if (!lowered) return ExitCode::BadInput;
  if (const auto refused = refusal(*lowered)) {
    show(options, {*refused});
    return ExitCode::BadInput;
  }
  const auto rules =
      RunRules::make(lowered->tree, lowered->network, properties);
  show(options, rules.diagnostics);
  if (!rules.value) return ExitCode::BadInput;
  const CompiledNetwork system(lowered->network);
  // It ends between two ticks, once its leaves have been told.
  allow(options);
  Guard::dismiss();
  const BudgetScope own_way(nullptr);
  ClaimedFiles files;
  auto chosen = leaves_for(options, *lowered, system);
  if (!chosen || !claim(options, files)) return ExitCode::BadInput;
  std::optional<RunView> view;
  if (options.view) {
    view.emplace(options, *lowered);
    if (!open_view(options, view->server)) return ExitCode::BadInput;
  }
  const std::string complaint =
      chosen->process != nullptr ? chosen->process->begin() : "";
  if (!complaint.empty()) {
    complain("BT1704", complaint);
    return ExitCode::Missed;
  }
  return worst_of(execute(options, *lowered, *rules.value, system, *chosen,
                          view ? &*view : nullptr),
                  lowered->code());
}

}  // namespace btcheck
