// SPDX-License-Identifier: MIT
#include "cli/space_command.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "check/space/space.hpp"
#include "cli/inputs/complaints.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "report/text/contribution_text.hpp"
#include "report/text/space_report.hpp"

namespace btcheck {
namespace {

// The graph of a small space, to a file or instead of its figures.
ExitCode run_space_graph(const Options& options, const Lowered& lowered) {
  Watch watch(options);
  const auto graph = space_graph(lowered.network, *options.graph, watch.limits,
                                 lowered.tree.file);
  watch.monitor.clear();
  show(options, graph.diagnostics);
  if (!graph.value) return ExitCode::BadInput;
  return write_output(options.graph_file, *graph.value);
}

// Of larger spaces it is not told what makes them large: that takes a second,
// slower search.
constexpr std::uint64_t kMostForContributions = 1'000'000;

}  // namespace

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

}  // namespace btcheck
