// SPDX-License-Identifier: MIT
//
// Verdicts go to stdout; diagnostics, progress and statistics to stderr. An
// error in any input ends a command before anything is searched.
#include "cli/commands.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <system_error>

#include "check/check.hpp"
#include "check/export_model.hpp"
#include "check/space.hpp"
#include "check/space_graph.hpp"
#include "cli/contribution_text.hpp"
#include "cli/demo.hpp"
#include "cli/files.hpp"
#include "cli/progress.hpp"
#include "cli/report.hpp"
#include "cli/space_report.hpp"
#include "cli/trace_files.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostDiagnostics = 20;

bool wants_color(const Options& options, int descriptor) {
  if (options.color != When::Auto) return options.color == When::Always;
  const char* no_color = std::getenv("NO_COLOR");
  return (no_color == nullptr || *no_color == '\0') &&
         ::isatty(descriptor) != 0;
}

// Findings that say the same become one that names the other lines as well.
std::vector<Diagnostic> without_repetitions(
    const std::vector<Diagnostic>& diagnostics) {
  std::vector<Diagnostic> distinct;
  for (const Diagnostic& diagnostic : diagnostics) {
    auto same = std::find_if(distinct.begin(), distinct.end(),
                             [&](const Diagnostic& known) {
                               return known.severity != Severity::Error &&
                                      known.code == diagnostic.code &&
                                      known.file == diagnostic.file &&
                                      known.message == diagnostic.message;
                             });
    if (same == distinct.end()) {
      distinct.push_back(diagnostic);
    } else {
      same->label += fmt::format(
          "{}line {}",
          same->label.find("line ") == std::string::npos ? "; also on " : ", ",
          diagnostic.span.line);
    }
  }
  return distinct;
}

// The errors, then the warnings, the first twenty of each.
void show(const Options& options, const std::vector<Diagnostic>& diagnostics) {
  const Color color =
      wants_color(options, STDERR_FILENO) ? Color::Always : Color::Never;
  for (const Severity severity :
       {Severity::Error, Severity::Warning, Severity::Note}) {
    std::size_t shown = 0;
    for (const Diagnostic& diagnostic : without_repetitions(diagnostics)) {
      if (diagnostic.severity != severity) continue;
      if (shown++ < kMostDiagnostics) {
        fmt::print(stderr, "{}\n", render(diagnostic, color));
      }
    }
    if (shown > kMostDiagnostics) {
      fmt::print(stderr, "and {} more\n\n", shown - kMostDiagnostics);
    }
  }
}

void complain(std::string_view code, std::string_view message) {
  fmt::print(stderr, "error[{}]: {}\n", code, message);
}

std::uint64_t memory_limit(const Options& options) {
  if (options.max_bytes != 0) return options.max_bytes;
  const std::uint64_t pages =
      static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
  const std::uint64_t page =
      static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return pages * page / 4 * 3;
}

ProgressStyle progress_style(const Options& options) {
  if (options.is_quiet) return ProgressStyle::Silent;
  return ::isatty(STDERR_FILENO) != 0 ? ProgressStyle::Rewritten
                                      : ProgressStyle::Lines;
}

Scratch scratch_of(const Options& options) {
  Scratch scratch;
  scratch.folder = options.scratch_dir;
  return scratch;
}

// Limits with a monitor behind them.
struct Watch {
  explicit Watch(const Options& options)
      : monitor(progress_style(options), options.timeout,
                memory_limit(options)),
        limits{options.max_states, memory_limit(options), &monitor} {}

  Monitor monitor;
  Limits limits;
};

// The files that a command line names: the tree, and the properties.
struct Inputs {
  InputFile tree;
  std::vector<InputFile> properties;
};

bool is_property_file(const std::string& name) {
  return name.ends_with(".ltl") || name.ends_with(".btp");
}

// `btcheck rules.ltl`: the tree is the one that the file names.
std::optional<std::string> tree_named_by(const Options& options,
                                         const InputFile& properties) {
  const Result<std::string> named = tree_of_properties(properties);
  if (!named.value) {
    show(options, named.diagnostics);
    return std::nullopt;
  }
  if (!named.value->empty()) return path_beside(properties.name, *named.value);
  complain("BT0003",
           fmt::format("`{}` names no tree; write btcheck TREE.btf --prop {}",
                       properties.name, properties.name));
  return std::nullopt;
}

// Reads the files in order; nothing when one of them cannot be read.
std::optional<Inputs> read_inputs(const Options& options) {
  Inputs inputs;
  std::string tree = options.input;
  std::vector<std::string> names = options.properties;
  if (is_property_file(tree)) names.insert(names.begin(), tree);
  bool is_readable = true;
  for (const std::string& name : names) {
    auto read = read_file(name);
    show(options, read.diagnostics);
    is_readable &= read.value.has_value();
    if (read.value) inputs.properties.push_back(std::move(*read.value));
  }
  if (!is_readable) return std::nullopt;
  if (is_property_file(tree)) {
    auto named = tree_named_by(options, inputs.properties[0]);
    if (!named) return std::nullopt;
    tree = *named;
  }
  auto read = read_file(tree);
  show(options, read.diagnostics);
  if (!read.value) return std::nullopt;
  inputs.tree = std::move(*read.value);
  return inputs;
}

void print_statistics(const Options& options, const CheckedFile& file,
                      double seconds) {
  if (options.is_quiet) return;
  std::uint64_t states = 0;
  for (const PropertyVerdict& verdict : file.verdicts) {
    states = std::max(states, verdict.progress.states);
  }
  if (file.defaults) states = file.defaults->progress.states;
  fmt::print(stderr, "explored up to {} states in {:.2f} s\n", grouped(states),
             seconds);
}

ExitCode print_results(const Options& options, const CheckResult& result) {
  ExitCode code = ExitCode::Met;
  for (const CheckedFile& file : result.files) {
    fmt::print("{}", heading_text(result, file));
    const Detail detail =
        options.is_verbose ? Detail::EveryStep : Detail::Events;
    fmt::print("{}", file.defaults ? defaults_text(result, file, detail)
                                   : verdicts_text(result, file, detail));
    code = worst_of(code, exit_code_of(file));
    if (options.trace_dir.empty()) continue;
    const std::string complaint =
        write_traces(options.trace_dir, *result.tree, file);
    if (complaint.empty()) continue;
    complain("BT0004", complaint);
    code = worst_of(code, ExitCode::BadInput);
  }
  return code;
}

// Found out before anything is checked, not after.
bool can_write_traces(const Options& options) {
  if (options.trace_dir.empty()) return true;
  const std::string complaint = make_directory(options.trace_dir);
  if (!complaint.empty()) complain("BT0004", complaint);
  return complaint.empty();
}
bool can_use_disk(const Options& options) {
  const std::string& folder = options.scratch_dir;
  if (folder.empty()) return true;
  std::string complaint = make_directory(folder);
  try {
    if (complaint.empty()) ScratchFile trial(folder);
  } catch (const ScratchFault& fault) {
    complaint = fmt::format("--on-disk: {}", fault.what());
  }
  if (!complaint.empty()) complain("BT0004", complaint);
  return complaint.empty();
}

ExitCode run_check(const Options& options) {
  const auto inputs = read_inputs(options);
  if (!inputs || !can_write_traces(options) || !can_use_disk(options)) {
    return ExitCode::BadInput;
  }
  if (inputs->properties.empty() && options.assume != ExtraAssumption::None) {
    fmt::print(stderr,
               "warning: --assume changes nothing in the default report: it "
               "asks what can happen\n\n");
  }
  Watch watch(options);
  const CheckResult result = check(
      inputs->tree, inputs->properties,
      {options.ticks,
       {options.search, options.reduce, options.threads, scratch_of(options)},
       options.assume,
       watch.limits});
  watch.monitor.clear();
  show(options, result.diagnostics);
  if (result.files.empty()) return ExitCode::BadInput;
  const ExitCode code = print_results(options, result);
  std::fflush(stdout);
  print_statistics(options, result.files.back(), watch.monitor.seconds());
  return code;
}

// Reads one tree and lowers it, or shows what is wrong with it.
struct Lowered {
  BehaviorTree tree;
  Network network;
};
std::optional<Lowered> read_and_lower(const Options& options) {
  auto file = read_file(options.input);
  show(options, file.diagnostics);
  if (!file.value) return std::nullopt;
  auto read = read_btf(file.value->name, file.value->text);
  show(options, read.diagnostics);
  if (!read.value) return std::nullopt;
  Lowered lowered{std::move(*read.value), {}};
  lowered.network =
      lower(lowered.tree, options.ticks.value_or(TickSemantics::Root));
  return lowered;
}

// The most memory the process has held so far.
std::uint64_t peak_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// The graph of a small space, to a file or instead of its figures.
ExitCode run_space_graph(const Options& options, const Lowered& lowered) {
  Watch watch(options);
  const auto graph = space_graph(lowered.network, *options.graph, watch.limits,
                                 lowered.tree.file);
  watch.monitor.clear();
  show(options, graph.diagnostics);
  if (!graph.value) return ExitCode::BadInput;
  if (options.graph_file.empty()) {
    fmt::print("{}", *graph.value);
    return ExitCode::Met;
  }
  const std::string complaint = write_file(options.graph_file, *graph.value);
  if (!complaint.empty()) complain("BT0004", complaint);
  return complaint.empty() ? ExitCode::Met : ExitCode::BadInput;
}

// Of larger spaces it is not told what makes them large: that takes a second,
// slower search.
constexpr std::uint64_t kMostForContributions = 1'000'000;

ExitCode run_space(const Options& options) {
  const auto lowered = read_and_lower(options);
  if (!lowered || !can_use_disk(options)) return ExitCode::BadInput;
  if (options.graph) {
    const ExitCode code = run_space_graph(options, *lowered);
    if (code != ExitCode::Met || options.graph_file.empty()) return code;
  }
  Watch watch(options);
  const SpaceReport report =
      measure_space(lowered->network,
                    {options.search, options.reduce, options.store,
                     options.threads, scratch_of(options)},
                    watch.limits);
  const SpaceContext context{lowered->tree.file, lowered->network, options,
                             watch.monitor.seconds(), peak_bytes()};
  watch.monitor.clear();
  fmt::print("{}", options.statistics == StatisticsFormat::Json
                       ? space_json(report, context)
                       : space_text(report, context));
  if (options.statistics == StatisticsFormat::Table && !options.is_quiet &&
      report.result.is_complete &&
      report.result.progress.states <= kMostForContributions) {
    const auto parts = measure_contributions(lowered->network, watch.limits);
    watch.monitor.clear();
    fmt::print("{}", contribution_text(lowered->tree, parts));
  }
  return report.result.is_complete ? ExitCode::Met : ExitCode::Undecided;
}

ExitCode run_export(const Options& options) {
  const auto inputs = read_inputs(options);
  if (!inputs) return ExitCode::BadInput;
  const auto model =
      export_model(inputs->tree, inputs->properties,
                   {options.format, options.ticks, options.assume});
  show(options, model.diagnostics);
  if (!model.value) return ExitCode::BadInput;
  fmt::print("{}", *model.value);
  return ExitCode::Met;
}

ExitCode run_demo(const Options& options) {
  Watch watch(options);
  const InputFile rules{"demo.ltl", std::string(kDemoProperties)};
  const CheckOptions how{
      options.ticks,
      {options.search, options.reduce, options.threads, scratch_of(options)},
      options.assume,
      watch.limits};
  const CheckResult found =
      check({"drone3.btf", std::string(kDemoTree)}, {rules}, how);
  const CheckResult fixed =
      check({"drone3-fixed.btf", std::string(kDemoFixedTree)}, {rules}, how);
  watch.monitor.clear();
  if (found.files.empty() || fixed.files.empty()) {
    show(options, found.diagnostics);
    show(options, fixed.diagnostics);
    return ExitCode::Internal;
  }
  fmt::print("{}", kDemoBegin);
  print_results(options, found);
  fmt::print("{}", kDemoFinding);
  print_results(options, fixed);
  fmt::print("{}", kDemoEnd);
  const bool is_ours = exit_code_of(found.files[0]) == ExitCode::Internal ||
                       exit_code_of(fixed.files[0]) == ExitCode::Internal;
  return is_ours ? ExitCode::Internal : ExitCode::Met;
}

ExitCode run_command(const Options& options) {
  switch (options.command) {
    case Command::Check:
      return run_check(options);
    case Command::Space:
      return run_space(options);
    case Command::Export:
      return run_export(options);
    case Command::Demo:
      return run_demo(options);
  }
  return ExitCode::Internal;
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  try {
    const auto parsed = parse_options(argc, argv);
    if (const auto* answer = std::get_if<Answer>(&parsed)) {
      fmt::print(answer->code == ExitCode::Met ? stdout : stderr, "{}",
                 answer->text);
      return static_cast<int>(answer->code);
    }
    const ExitCode code = run_command(std::get<Options>(parsed));
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      throw std::system_error(errno, std::generic_category());
    }
    return static_cast<int>(code);
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
