// SPDX-License-Identifier: MIT
#include "cli/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <variant>
#include <vector>

#include "batch/answer.hpp"
#include "batch/entries/entries.hpp"
#include "batch/leaves.hpp"
#include "check/export/export_model.hpp"
#include "check/space/graph.hpp"
#include "check/space/quotient.hpp"
#include "check/space/space.hpp"
#include "cli/console/console.hpp"
#include "cli/from.hpp"
#include "cli/inputs/component_cache.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/options/tables.hpp"
#include "cli/options/words.hpp"
#include "cli/recordings.hpp"
#include "cli/robots/watch.hpp"
#include "lsp/command.hpp"
#include "pins/words.hpp"
#include "report/formats/formats.hpp"
#include "report/text/report.hpp"
#include "report/text/space_report.hpp"
#include "serve/command.hpp"
#include "text/tables.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// --- space ---------------------------------------------------------------

// Equivalence of --reduce, and what is seen, of all states.
std::optional<SpaceQuotient> quotient_asked(const Options& options,
                                            const Network& network) {
  if (!options.modulo) return std::nullopt;
  Watch watch(options);
  return quotient_of_space(network, *options.modulo,
                           options.seen.value_or(SeenAnswers::OfAll),
                           watch.limits);
}

// The graph of the space or of its quotient, to a file or instead of the
// figures.
ExitCode run_space_graph(const Options& options, const Lowered& lowered,
                         const std::optional<SpaceQuotient>& quotient) {
  Watch watch(options);
  const std::string& tree = lowered.tree.file;
  const auto write_to = [&](const GraphSink& sink) {
    const auto found =
        quotient
            ? write_quotient(*quotient, *options.graph, tree, sink)
            : write_space_graph(lowered.network,
                                {*options.graph, options.reduce, options.seen},
                                watch.limits, tree, sink);
    watch.monitor.clear();
    show(options, found);
    return found.empty();
  };
  if (options.graph_file.empty()) {
    const bool is_written = write_to([](std::string_view text) {
      print_exactly(text);
      return true;
    });
    return is_written ? ExitCode::Met : ExitCode::BadInput;
  }
  WholeFile file(options.graph_file);
  // Nothing is searched for a file that cannot be written.
  if (file.write("") &&
      !write_to([&](std::string_view text) { return file.write(text); })) {
    return ExitCode::BadInput;
  }
  const std::string complaint = file.keep();
  if (!complaint.empty()) complain("BT0004", complaint);
  return complaint.empty() ? ExitCode::Met : ExitCode::BadInput;
}

ExitCode run_space_of_one(const Options& options) {
  auto lowered = read_and_lower(options);
  if (!lowered || !can_use_disk(options)) return ExitCode::BadInput;
  {
    const Watch start(options);
    if (!begin_from(options, lowered->tree, lowered->input, lowered->network,
                    start.limits)) {
      return ExitCode::BadInput;
    }
  }
  std::optional<SpaceQuotient> quotient;
  if (options.graph) {
    quotient = quotient_asked(options, lowered->network);
    const ExitCode code = run_space_graph(options, *lowered, quotient);
    if (code != ExitCode::Met || options.graph_file.empty()) {
      return worst_of(code, lowered->code());
    }
  }
  Watch watch(options);
  const SpaceOptions how{options.search,
                         options.reduce,
                         options.store,
                         threads_to_use(options),
                         {options.scratch_dir}};
  const SpaceReport report = measure_space(lowered->network, how, watch.limits);
  const double seconds = watch.monitor.seconds();
  if (!quotient && report.result.is_complete) {
    quotient = quotient_asked(options, lowered->network);
  }
  const SpaceContext context{lowered->tree.file,
                             lowered->network,
                             how,
                             seconds,
                             peak_bytes(),
                             options.modulo,
                             quotient ? &*quotient : nullptr};
  watch.monitor.clear();
  if (options.statistics == StatisticsFormat::Json) {
    print_exactly(space_json(report, context));
  } else {
    print(space_text(report, context));
  }
  // What makes a space large is found by a second, slower search: only where
  // the space is small enough.
  constexpr std::uint64_t kMostForContributions = 1'000'000;
  if (options.statistics == StatisticsFormat::Table && !options.is_quiet &&
      report.result.is_complete &&
      report.result.progress.states <= kMostForContributions) {
    const auto parts = measure_contributions(lowered->network, watch.limits);
    watch.monitor.clear();
    print(contribution_text(lowered->tree, parts));
  }
  tell_of_disk(options, report.result.stopped);
  const bool is_complete = report.result.is_complete &&
                           (!quotient || quotient->stopped == StopReason::None);
  return worst_of(lowered->code(),
                  is_complete ? ExitCode::Met : ExitCode::Undecided);
}

// `btcheck space TREE`. Of a .btproj all trees that its files name, one after
// the other, unless one is asked for or the output is of one tree only.
ExitCode run_space(const Options& options) {
  const bool is_of_one = !options.main_tree.empty() || options.graph ||
                         !options.from.empty() ||
                         options.statistics == StatisticsFormat::Json;
  if (is_of_one || !is_project_name(options.input)) {
    return run_space_of_one(options);
  }
  Options asked = options;
  asked.batch.sources = {options.input};
  const std::vector<BatchEntry> entries = gather_batch(asked);
  if (entries.size() < 2) return run_space_of_one(options);
  ExitCode code = ExitCode::Met;
  for (const BatchEntry& entry : entries) {
    Options one = applied(options, entry.choices);
    one.input = entry.input;
    one.project = entry.project;
    if (&entry != &entries.front()) print("\n");
    limits_of_command().restart();
    print(fmt::format("{}\n", entry.name));
    code = worst_of(code, run_space_of_one(one));
  }
  return code;
}

// --- export --------------------------------------------------------------

ExitCode run_export(const Options& options) {
  std::vector<Diagnostic> found;
  const auto inputs = read_inputs(options, found);
  if (!inputs) return ExitCode::BadInput;
  auto model = export_model(inputs->tree, inputs->properties,
                            {options.format, options.ticks, options.assume,
                             words_of_export(options.words), options.space});
  const Judged judged =
      judge(inputs->tree, inputs->options.judgement, model.diagnostics);
  show(options, model.diagnostics);
  if (!model.value) return ExitCode::BadInput;
  // Line by line, for a model may be long; `::` is of Promela.
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  for (std::string_view rest = *model.value; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n', kPiece), rest.size() - 1);
    print_exactly(harmless(rest.substr(0, end + 1)));
    rest.remove_prefix(end + 1);
  }
  return judged.is_denied ? ExitCode::Missed : ExitCode::Met;
}

// --- completions ---------------------------------------------------------

ExitCode run_completions(const Options& options) {
  const std::string script = completions_for(options.input);
  if (script.empty()) {
    refuse(fmt::format("completions for `{}`: no such shell; write bash, zsh "
                       "or fish",
                       options.input),
           "");
  }
  print(script);
  return ExitCode::Met;
}

ExitCode run_man(const Options&) {
  print(man_page());
  return ExitCode::Met;
}

// --- watch ---------------------------------------------------------------

ExitCode run_watch(const Options& options) {
  return watch_robots(
      options, reading_of(options),
      [&](const std::string& robot) { return live_rules(options, robot); });
}

// --- The program ---------------------------------------------------------

struct RunOf {
  Command command;
  ExitCode (*run)(const Options&);
};
constexpr auto kRuns = std::to_array<RunOf>({
    {Command::Check, run_check},       {Command::Space, run_space},
    {Command::Export, run_export},     {Command::Trace, run_trace},
    {Command::Simulate, run_simulate}, {Command::Demo, run_demo},
    {Command::Batch, run_several},     {Command::Lint, run_lint},
    {Command::Explain, run_explain},   {Command::Init, run_init},
    {Command::Conform, run_conform},   {Command::Completions, run_completions},
    {Command::Man, run_man},           {Command::Run, run_run},
    {Command::Monitor, run_monitor},   {Command::Leaves, run_leaves},
    {Command::Answer, run_answer},     {Command::Serve, run_serve},
    {Command::Mcp, run_mcp},           {Command::Lsp, run_lsp},
    {Command::Fmt, run_fmt},           {Command::Watch, run_watch},
    {Command::WhatIf, run_whatif},     {Command::Tests, run_tests},
    {Command::Diff, run_diff},
});
static_assert(is_indexed(kRuns, &RunOf::command));

// What is asked for, or why the budget of the command was not enough for it.
ExitCode run_within(const Options& options) {
  try {
    return kRuns[static_cast<std::size_t>(options.command)].run(options);
  } catch (const BudgetSpent& spent) {
    show(options, {spent_diagnostic(spent, options.input)});
    return ExitCode::Undecided;
  }
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  open_standard_files();
  std::signal(SIGXFSZ, SIG_IGN);  // writing fails instead
  try {
    const auto parsed = parse_options(argc, argv);
    if (const auto* answer = std::get_if<Answer>(&parsed)) {
      (answer->code == ExitCode::Met ? print : tell)(answer->text);
      flush_output();
      return static_cast<int>(answer->code);
    }
    const Options& options = std::get<Options>(parsed);
    const InterruptWatch interrupts;
    ProcessLimits& limits = limits_of_command();
    allow(options);
    const BudgetScope budget(&limits);
    const Guard guard(limits);
    const auto cache = open_cache(options);
    if (!cache) return static_cast<int>(ExitCode::BadInput);
    const ExitCode code = run_within(options);
    close_cache(options, *cache);
    flush_output();
    return static_cast<int>(code);
  } catch (const Refusal& refused) {
    tell(refused.answer.text);
    return static_cast<int>(refused.answer.code);
  } catch (const std::system_error& fault) {
    complain("BT0004", fmt::format("cannot write the output: {}",
                                   fault.code().message()));
    return static_cast<int>(ExitCode::BadInput);
  } catch (const std::bad_alloc&) {
    complain("BT9001", "out of memory; --memory sets a limit that is kept");
    return static_cast<int>(ExitCode::Undecided);
  } catch (const std::exception& fault) {
    complain("BT9002", fmt::format("internal error: {}", fault.what()));
    return static_cast<int>(ExitCode::Internal);
  }
}

}  // namespace btcheck
