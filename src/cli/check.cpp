// SPDX-License-Identifier: MIT
//
// `btcheck TREE`, `btcheck demo` and `btcheck lint`.
#include "cli/commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "batch/command.hpp"
#include "batch/entries/entries.hpp"
#include "batch/watch/watch.hpp"
#include "check/check.hpp"
#include "check/repairs/repairs.hpp"
#include "cli/console/console.hpp"
#include "cli/demo.hpp"
#include "cli/from.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/outputs/keep_baseline.hpp"
#include "cli/outputs/write_reports.hpp"
#include "model/tree_file.hpp"
#include "project/sources.hpp"
#include "report/formats/formats.hpp"
#include "report/formats/reported.hpp"
#include "report/text/differences.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

void print_statistics(const Options& options, const CheckedFile& file,
                      double seconds) {
  if (options.is_quiet) return;
  std::uint64_t states = 0;
  for (const PropertyVerdict& verdict : file.verdicts) {
    states = std::max(states, verdict.progress.states);
  }
  if (file.defaults) states = file.defaults->progress.states;
  if (file.defaults && file.defaults->searches > 0) {
    tell(fmt::format("asked part by part, in {} searches\n",
                     grouped(file.defaults->searches)));
  }
  tell(fmt::format("explored up to {} states in {:.2f} s\n", grouped(states),
                   seconds));
}

// The code, made worse by a complaint that an output could not be written.
// Shows the complaint; "" is none.
ExitCode unless_failed(ExitCode code, const std::string& complaint) {
  if (complaint.empty()) return code;
  complain("BT0004", complaint);
  return worst_of(code, ExitCode::BadInput);
}

// Writes the runs of the results to --trace-dir and returns the exit code of
// the results. That they cannot be written is a result, too.
ExitCode settle(const Options& options, CheckResult& result,
                const TreeInput& input, const Limits& limits) {
  const ExitCode code = exit_code_of(result);
  if (options.trace_dir.empty()) return code;
  WrittenTraces all;
  for (const CheckedFile& file : result.files) {
    all.add(write_traces(options.trace_dir, result, file, input, limits));
    if (!all.complaint.empty()) break;
  }
  if (!options.is_quiet) tell(all.omissions(options.trace_dir));
  if (!all.complaint.empty()) {
    result.diagnostics.push_back(file_error("BT0004", "", all.complaint));
  }
  return unless_failed(code, all.complaint);
}

// Writes the results in every format that was asked for.
ExitCode told(const Options& options, const CheckResult& result,
              const std::string& tree, ExitCode code, double seconds) {
  return unless_failed(code,
                       write_reports(options, result, layout_of(options),
                                     {tree, code, seconds, peak_bytes()}));
}

// What is otherwise under --against.
ExitCode run_against(const Options& options, const Inputs& inputs) {
  Watch watch(options);
  const CheckOptions how = check_options(options, watch.limits);
  TreeInput other = inputs.tree;
  other.reading.profile = options.against;
  const CheckResult before =
      check_and_repair(inputs.tree, inputs.properties, how);
  const CheckResult after = check_and_repair(other, inputs.properties, how);
  watch.monitor.clear();
  if (before.files.empty() || after.files.empty()) {
    const bool both = before.files.empty() && after.files.empty();
    const CheckResult& refused = before.files.empty() ? before : after;
    show(options, refused.diagnostics);
    const bool is_of_rules = before.tree && after.tree;
    if (both || is_of_rules || !is_xml(inputs.tree.name, inputs.tree.text)) {
      return ExitCode::BadInput;
    }
    print(fmt::format(
        "{}: only `{}` takes it\n", inputs.tree.name,
        profile_name((before.files.empty() ? after : before).tree->profile)));
    return ExitCode::Missed;
  }
  const std::string text = differences_text(before, after, layout_of(options));
  const std::string heading = fmt::format(
      "{}: {} beside {}\n", inputs.tree.name,
      profile_name(before.tree->profile), profile_name(after.tree->profile));
  const bool is_whole = stopped_by(before.files.back()) == StopReason::None &&
                        stopped_by(after.files.back()) == StopReason::None;
  const std::string_view ending =
      !is_whole      ? "\nwithin the limits; more time may show more\n"
      : text.empty() ? "\nno verdict, finding or answer of a node differs\n"
                     : "";
  print_exactly(
      painted(options, heading + text + std::string(ending), STDOUT_FILENO));
  if (!text.empty()) return ExitCode::Missed;
  return is_whole ? ExitCode::Met : ExitCode::Undecided;
}

}  // namespace

namespace {

// Several trees, of which the file does not say which one runs.
bool has_several(const std::string& file) {
  const auto read = read_file(file);
  const auto outline = outline_of(read.value ? read.value->text : "");
  return outline && !outline->main && outline->trees.size() > 1;
}

// A file with several trees that no other uses, or a .btproj whose files name
// several, where no option asks for one.
bool names_several(const Options& options) {
  const bool asks_for_one =
      !options.main_tree.empty() || options.against || !options.from.empty() ||
      !options.properties.empty() || !options.rules.empty();
  if (asks_for_one) return false;
  const bool may_be =
      is_project_name(options.input) ||
      (is_xml_name(options.input) && has_several(options.input));
  return may_be && gather_batch(options).size() > 1;
}

ExitCode check_one(const Options& asked) {
  Options options = asked;
  if (!take_baseline(options)) return ExitCode::BadInput;
  CheckResult result;
  const auto inputs = read_inputs(options, result.diagnostics);
  if (inputs) options = inputs->options;
  // Whether outputs can be written is tried before anything is checked.
  ExitCode code = unless_failed(ExitCode::Met, obstacle_to(options));
  if (code != ExitCode::Met) return code;
  if (inputs && options.against) return run_against(options, *inputs);
  if (!inputs) {
    std::vector<std::string> names = options.properties;
    if (!options.rules.empty())
      names.push_back(typed_rules(options.rules).name);
    print_start(options.reports, options.input, names);
    return told(options, result, options.input, ExitCode::BadInput, 0);
  }
  if (!options.trace_dir.empty()) {
    code = unless_failed(code, make_directory(options.trace_dir));
  }
  if (code != ExitCode::Met || !can_use_disk(options)) {
    return ExitCode::BadInput;
  }
  if (inputs->properties.empty() && options.assume != ExtraAssumption::None) {
    tell(
        "warning: --assume changes nothing in the default report: it asks what "
        "can happen\n\n");
  }
  if (inputs->properties.empty() && options.any_count) {
    tell("warning: --any-count changes nothing without rules\n\n");
  }
  std::vector<std::string> names;
  for (const InputFile& file : inputs->properties) names.push_back(file.name);
  print_start(options.reports, inputs->tree.name, names);
  Watch watch(options);
  if (prints_lines(options.reports)) watch.monitor.tell(print_progress);
  const CheckOptions how = check_options(options, watch.limits);
  if (options.from.empty()) {
    result = check_and_repair(inputs->tree, inputs->properties, how);
  } else {
    auto found = check_from(options, inputs->tree, inputs->properties, how);
    if (!found) return ExitCode::BadInput;
    result = std::move(*found);
  }
  watch.monitor.clear();
  // What is known is told, however long that takes.
  const BudgetScope telling(nullptr);
  Guard::dismiss();
  show(options, result.diagnostics);
  const double seconds = watch.monitor.seconds();
  code = result.files.empty()
             ? ExitCode::BadInput
             : settle(options, result, inputs->tree, watch.limits);
  code = told(options, result, inputs->tree.name, code, seconds);
  flush_output();
  code = worst_of(code, keep_baseline(options, {&result.judged}));
  if (result.files.empty()) return code;
  tell_of_disk(options, stopped_by(result.files.back()));
  print_statistics(options, result.files.back(), seconds);
  return code;
}

// The report of a check that the limits have ended before it had anything to
// tell.
ExitCode told_spent(const Options& options, const std::string& tree,
                    const BudgetSpent& spent) {
  const BudgetScope telling(nullptr);
  CheckResult result;
  result.diagnostics = {spent_diagnostic(spent, tree)};
  show(options, result.diagnostics);
  return told(options, result, tree, ExitCode::Undecided,
              limits_of_command().seconds());
}

}  // namespace

ExitCode run_several(const Options& options) {
  return options.watches ? run_watch(options) : run_batch(options);
}

ExitCode run_check(const Options& asked) {
  if (names_several(asked)) return run_several(as_batch(asked));
  if (asked.watches) return run_watch(asked);
  try {
    return check_one(asked);
  } catch (const BudgetSpent& spent) {
    return told_spent(asked, asked.input, spent);
  }
}

ExitCode run_demo(const Options& options) {
  Watch watch(options);
  const InputFile rules{"demo.ltl", std::string(kDemoProperties)};
  const CheckOptions how = check_options(options, watch.limits);
  const TreeInput tree("drone3.btf", std::string(kDemoTree));
  const TreeInput fixed_tree("drone3-fixed.btf", std::string(kDemoFixedTree));
  CheckResult found = check(tree, {rules}, how);
  CheckResult fixed = check(fixed_tree, {rules}, how);
  watch.monitor.clear();
  if (found.files.empty() || fixed.files.empty()) {
    show(options, found.diagnostics);
    show(options, fixed.diagnostics);
    return ExitCode::Internal;
  }
  const auto tell_result = [&](const CheckResult& result) {
    const std::string text = text_report(result, layout_of(options));
    print_exactly(painted(options, text, STDOUT_FILENO));
  };
  print(kDemoBegin);
  tell_result(found);
  settle(options, found, tree, watch.limits);
  print(kDemoFinding);
  tell_result(fixed);
  settle(options, fixed, fixed_tree, watch.limits);
  print(kDemoEnd);
  const bool is_ours = exit_code_of(found.files[0]) == ExitCode::Internal ||
                       exit_code_of(fixed.files[0]) == ExitCode::Internal;
  return is_ours ? ExitCode::Internal : ExitCode::Met;
}

// --- Lint ----------------------------------------------------------------

namespace {

// Errors of reading are told on stderr; what is found in a tree that can be
// read, on stdout.
bool is_told_apart(const ReportedTree& tree, const Diagnostic& diagnostic) {
  return tree.code >= ExitCode::BadInput &&
         diagnostic.severity == Severity::Error;
}

// A tree, and those that a folder or a .btproj stands for.
std::vector<BatchEntry> entries_for(const Options& options,
                                    const std::string& input) {
  if (is_folder(input) || is_project_name(input)) {
    Options alone = options;
    alone.batch.sources = {input};
    return gather_batch(alone);
  }
  BatchEntry entry;
  entry.input = input;
  return {entry};
}

// A tree read with all the rules that are named. Where it cannot be read, the
// other trees are read all the same.
ReportedTree linted(const Options& all, const BatchEntry& entry) {
  CheckResult result;
  std::string file = entry.input;
  std::vector<Diagnostic> found = entry.diagnostics;
  Options options = applied(all, entry.choices);
  options.project = entry.project;
  std::vector<std::string> properties = entry.properties;
  properties.insert(properties.end(), options.properties.begin(),
                    options.properties.end());
  limits_of_command().restart();
  bool is_spent = false;
  try {
    const auto inputs =
        has_error(found)
            ? std::nullopt
            : gather_inputs(entry.input, properties, options, found);
    if (inputs) {
      file = inputs->tree.name;
      tell_settings(options, file);
      result = lint_inputs(inputs->tree, inputs->properties,
                           inputs->options.judgement);
    } else {
      result.is_broken = true;
    }
  } catch (const BudgetSpent& spent) {
    if (spent.spent() == Spent::Interrupted) throw;
    is_spent = true;
    found = {spent_diagnostic(spent, file)};
    result.is_broken = true;
  }
  const BudgetScope telling(nullptr);
  result.diagnostics.insert(result.diagnostics.begin(), found.begin(),
                            found.end());
  ReportedTree tree = reported(
      result, file, is_spent ? ExitCode::Undecided : lint_code_of(result));
  std::erase_if(result.diagnostics, [&](const Diagnostic& one) {
    return !is_told_apart(tree, one);
  });
  show(options, result.diagnostics);
  return tree;
}

// The findings and their number, without the errors, which were shown before.
std::string findings_text(const Options& options, const Report& report) {
  std::string text;
  std::size_t count = 0;
  for (const ReportedTree& tree : report.trees) {
    std::vector<Diagnostic> findings = tree.diagnostics;
    std::erase_if(findings, [&](const Diagnostic& one) {
      return is_told_apart(tree, one);
    });
    count += findings.size();
    text += shown(findings);
  }
  if (options.is_quiet) return text;
  return text + fmt::format("{}, {}{}\n",
                            counted(report.trees.size(), "tree", "trees"),
                            counted(count, "finding", "findings"),
                            judged_text(count_of(report)));
}

}  // namespace

ExitCode run_lint(const Options& asked) {
  Options options = asked;
  const std::string obstacle = obstacle_to(options);
  if (!obstacle.empty()) return unless_failed(ExitCode::BadInput, obstacle);
  if (!take_baseline(options)) return ExitCode::BadInput;
  Report report = new_report(0);
  for (const std::string& input : options.inputs) {
    for (const BatchEntry& entry : entries_for(options, input)) {
      report.trees.push_back(linted(options, entry));
    }
  }
  const std::string complaint = write_report(options, options.reports, report,
                                             findings_text(options, report));
  return worst_of(unless_failed(report.code(), complaint),
                  keep_baseline(options, judged_of(report)));
}

}  // namespace btcheck
