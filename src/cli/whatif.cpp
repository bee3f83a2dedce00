// SPDX-License-Identifier: MIT
//
// `btcheck whatif TREE`: what the mission does when something breaks.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check/bind/node_names.hpp"
#include "check/whatif/whatif.hpp"
#include "cli/commands.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/outputs/write_reports.hpp"
#include "model/tree/node_types.hpp"
#include "report/text/report.hpp"
#include "report/whatif/earlier.hpp"
#include "report/whatif/files.hpp"
#include "report/whatif/table.hpp"
#include "text/budget.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// Runs of so many pairs are written, the worst.
constexpr std::size_t kMostPairRuns = 100;

// Why the files that are asked for cannot be written; "" for nothing.
std::string obstacle_before(const Options& options) {
  for (const FaultTarget& target : options.faults.outputs) {
    const std::string obstacle =
        target.file.empty() ? "" : obstacle_to(target.file);
    if (!obstacle.empty()) return obstacle;
  }
  return options.trace_dir.empty() ? "" : make_directory(options.trace_dir);
}

// What --against names; nothing, and shows why, where it cannot be compared.
std::optional<EarlierResult> earlier_of(const Options& options) {
  const FaultPlan& plan = options.faults;
  const auto file = read_file(plan.against);
  show(options, file.diagnostics);
  if (!file.value) return std::nullopt;
  auto read = read_earlier(plan.against, file.value->text);
  const auto refuse = [&](std::string_view name, std::string_view then) {
    read.value.reset();
    read.diagnostics = {file_error(
        "BT1515", plan.against,
        fmt::format("it was made with {} {}: that is another question", name,
                    then))};
  };
  if (read.value) {
    const bool works = plan.choices.others == Others::Work;
    if (read.value->others != (works ? "work" : "contract")) {
      refuse("--others", read.value->others);
    } else if (read.value->late != plan.choices.late) {
      refuse("--late", fmt::format("{}", read.value->late));
    }
  }
  show(options, read.diagnostics);
  return std::move(read.value);
}

// The nodes that --only names; nothing, and shows why, where there are none.
std::optional<std::vector<NodeId>> nodes_of_only(const Options& options,
                                                 const BehaviorTree& tree) {
  const std::string& only = options.faults.only;
  if (only.empty()) return std::vector<NodeId>{};
  const NodeNames names(tree);
  auto found = names.called(only);
  if (!found.empty()) return found;
  Diagnostic diagnostic =
      file_error("BT0001", tree.file,
                 fmt::format("--only {}: no node is called so", only));
  diagnostic.help = names.nearest_help(only);
  show(options, {diagnostic});
  return std::nullopt;
}

// Writes the runs, and notes their files in the report.
std::string write_runs(const Options& options, WhatIfReport& report) {
  const std::string& folder = options.trace_dir;
  if (folder.empty()) return "";
  const std::size_t last = report.result.rows.size() +
                           std::min(report.result.pairs.size(), kMostPairRuns);
  report.runs.resize(last);
  std::string complaint;
  for (std::size_t n = 1; n <= last && complaint.empty(); ++n) {
    const auto run = run_of_row(report, n);
    if (!run) continue;
    const std::string name = run_name(report, n);
    report.runs[n - 1] = trace_page(folder, report.tree().file, name);
    complaint = write_trace(folder, report.tree().file, name, *run);
  }
  const std::size_t rest = row_count(report.result) - last;
  if (rest > 0 && !options.is_quiet) {
    tell(fmt::format("{} not written to {}\n",
                     counted(rest, "run of a pair is", "runs of pairs are"),
                     folder));
  }
  return complaint;
}

std::string text_in(FaultFormat format, const WhatIfReport& report,
                    const std::string& table) {
  switch (format) {
    case FaultFormat::Text:
      return table;
    case FaultFormat::Json:
      return what_if_json(report);
    case FaultFormat::Csv:
      return what_if_csv(report);
    case FaultFormat::Html:
      return what_if_page(report);
    case FaultFormat::Dot:
      return fault_tree_dot(report);
    case FaultFormat::Svg:
      return fault_tree_svg(report);
    case FaultFormat::Opsa:
      return fault_tree_xml(report);
  }
  return {};
}

// Prints and writes all that is asked for. Returns what went wrong, or "".
std::string write_all(const Options& options, const WhatIfReport& report,
                      const std::string& change) {
  const auto& outputs = options.faults.outputs;
  const bool is_kept = std::ranges::any_of(outputs, [](const auto& target) {
    return target.format == FaultFormat::Text && !target.file.empty();
  });
  const TableChoices how{options.is_verbose,
                         is_kept ? kLineWidth : terminal_width()};
  std::string table = what_if_text(report.tree(), report.result, how);
  if (!change.empty()) table += '\n' + change;
  table = harmless(table);
  std::string complaint;
  for (const FaultTarget& target : outputs) {
    const bool is_text = target.format == FaultFormat::Text;
    const std::string text = text_in(target.format, report, table);
    if (target.file.empty()) {
      print_exactly(is_text ? painted(options, text, STDOUT_FILENO) : text);
      if (!is_text && !change.empty()) tell(change);
    } else if (complaint.empty()) {
      complaint = write_file(target.file, text);
    }
  }
  return complaint;
}

ExitCode settled(const Options& options, WhatIfReport& report,
                 const std::optional<EarlierResult>& before) {
  std::optional<WhatIfChange> change;
  if (before) change = change_since(*before, report);
  std::string complaint = write_runs(options, report);
  if (complaint.empty()) {
    complaint = write_all(options, report, change ? change->text : "");
  }
  if (!report.result.error.empty()) {
    complain("BT9002", report.result.error);
  }
  const ExitCode code = change ? exit_code_of(report.result, *change)
                               : exit_code_of(report.result);
  if (complaint.empty()) return code;
  complain("BT0004", complaint);
  return worst_of(code, ExitCode::BadInput);
}

// The trees that a tree has below SubTree nodes.
std::set<std::string> parts_of(const BehaviorTree& tree) {
  std::set<std::string> parts;
  for (const Node& node : tree.nodes) {
    if (node.type == NodeType::SubTree) parts.insert(node.id);
  }
  return parts;
}

// Of a tree that is too large as a whole: how more of it is asked.
void tell_too_large(const Options& options, const std::string& parts) {
  std::string help = "--max-states and --timeout allow more";
  if (!parts.empty()) {
    help +=
        fmt::format("; or ask for one part at a time, --main-tree {}", parts);
  }
  show(options,
       {file_error("BT9003", options.input,
                   "UNDECIDED: the runs without faults are too many to be "
                   "known",
                   help)});
}

// Whether its parts are told instead, one after the other, as text.
bool tells_parts(const Options& options, const WhatIfReport& report) {
  const FaultPlan& plan = options.faults;
  const bool is_text = std::ranges::all_of(plan.outputs, [](const auto& each) {
    return each.format == FaultFormat::Text && each.file.empty();
  });
  return is_text && options.main_tree.empty() && options.properties.empty() &&
         options.rules.empty() && plan.only.empty() && plan.against.empty() &&
         options.trace_dir.empty() && !parts_of(report.tree()).empty() &&
         report.result.healthy.stopped == StopReason::MaxStates;
}

// What has come of one tree; and the parts that are to be told instead.
struct OneTree {
  ExitCode code = ExitCode::BadInput;
  std::set<std::string> parts = {};
};

OneTree told_of(const Options& asked, bool own_leaves = false) {
  Options options = asked;
  const std::string obstacle = obstacle_before(options);
  if (!obstacle.empty()) {
    complain("BT0004", obstacle);
    return {};
  }
  std::vector<Diagnostic> found;
  const auto inputs = read_inputs(options, found);
  if (!inputs) return {};
  options = inputs->options;
  std::optional<EarlierResult> before;
  if (!options.faults.against.empty()) {
    before = earlier_of(options);
    if (!before) return {};
  }
  auto input = what_if_input(inputs->tree, inputs->properties);
  if (!own_leaves) show(options, input.diagnostics);
  if (!input.value) return {};
  const auto below = nodes_of_only(options, input.value->tree);
  if (!below) return {};
  options.faults.choices.below = *below;
  Watch watch(options);
  const TickSemantics ticks = options.ticks.value_or(TickSemantics::Root);
  const WhatIfOptions how{
      options.faults.choices,
      options.faults.order,
      own_leaves ? own_nodes(input.value->tree) : std::vector<bool>(),
      ticks,
      watch.limits,
      threads_to_use(options)};
  auto result = what_if(*input.value, how);
  watch.monitor.clear();
  // What is known is told, however long that takes.
  const BudgetScope telling(nullptr);
  Guard::dismiss();
  show(options, result.diagnostics);
  if (!result.value) return {};
  WhatIfReport report{inputs->tree, *input.value,        *result.value,
                      ticks,        options.faults.only, {}};
  if (report.result.healthy.stopped != StopReason::None) {
    tell_too_large(options,
                   fmt::format("{}", fmt::join(parts_of(report.tree()), ", ")));
  }
  const double seconds = watch.monitor.seconds();
  const ExitCode code = settled(options, report, before);
  if (!options.is_quiet) tell(fmt::format("{:.2f} s\n", seconds));
  if (!tells_parts(options, report)) return {code};
  return {code, parts_of(report.tree())};
}

}  // namespace

ExitCode run_whatif(const Options& options) {
  const auto [code, parts] = told_of(options);
  if (parts.empty()) return code;
  print(
      "\nIts trees instead, one by one. The main tree first: its subtrees are "
      "gone\nthrough and seen from outside, so what happens below them tells "
      "nobody of a\nfault. Then each of these as a mission of its own, "
      "whatever calls it.\n\n--- the main tree ---\n");
  ExitCode worst = worst_of(code, told_of(options, true).code);
  for (const std::string& part : parts) {
    Options one = options;
    one.main_tree = part;
    print(fmt::format("\n--- {} ---\n", part));
    worst = worst_of(worst, told_of(one).code);
  }
  return worst;
}

}  // namespace btcheck
