// SPDX-License-Identifier: MIT
//
// `btcheck diff TREE TREE`: whether two trees do the same.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "batch/entries/entries.hpp"
#include "check/check.hpp"
#include "check/diff/diff.hpp"
#include "check/whatif/whatif.hpp"
#include "cli/commands.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/revision.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/outputs/write_reports.hpp"
#include "report/diff/told.hpp"
#include "report/text/report.hpp"
#include "text/budget.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

// One of the two trees: how it is read, and what it is called.
struct ComparedTree {
  std::string input;
  Options options;
  std::string name;
};

struct ReadTree {
  Inputs inputs;
  WhatIfInput read;
};

// With the names that files have in their revision, where there is one.
void show(const Options& options, const Revision* revision,
          std::vector<Diagnostic> found) {
  for (Diagnostic& each : found) {
    if (revision != nullptr) each.file = revision->shown(each.file);
  }
  show(options, found);
}

// Reads it, or shows what is wrong with it.
std::optional<ReadTree> read_of(const ComparedTree& tree,
                                const Revision* revision) {
  std::vector<Diagnostic> found;
  auto inputs =
      gather_inputs(tree.input, tree.options.properties, tree.options, found);
  if (!inputs) {
    show(tree.options, revision, std::move(found));
    return std::nullopt;
  }
  tell_settings(inputs->options, inputs->tree.name);
  auto read = what_if_input(inputs->tree, inputs->properties);
  found.insert(found.end(), read.diagnostics.begin(), read.diagnostics.end());
  show(inputs->options, revision, std::move(found));
  if (!read.value) return std::nullopt;
  return ReadTree{std::move(*inputs), std::move(*read.value)};
}

// What checks of both find; nothing where one of them says an error.
std::optional<std::vector<DiffChange>> changes_of(const ReadTree& one,
                                                  const ReadTree& other,
                                                  const Limits& limits) {
  std::vector<CheckResult> results;
  for (const ReadTree* tree : {&one, &other}) {
    const Inputs& inputs = tree->inputs;
    CheckOptions how = check_options(inputs.options, limits);
    how.tries_repairs = false;
    results.push_back(check(inputs.tree, inputs.properties, how));
    if (results.back().files.empty()) {
      show(inputs.options, results.back().diagnostics);
      return std::nullopt;
    }
  }
  return changes_between(results[0], results[1]);
}

std::string text_in(DiffFormat format, const DiffReport& report,
                    std::size_t width) {
  switch (format) {
    case DiffFormat::Text:
      return harmless(diff_text(report, width));
    case DiffFormat::Json:
      return diff_json(report);
    case DiffFormat::Markdown:
      return diff_markdown(report);
    case DiffFormat::Html:
      return diff_page(report);
  }
  return {};
}

// Standard output at once, files with what has been told for them before.
using Written = std::map<std::string, std::string>;
void tell_all(const Options& options, const DiffReport& report,
              Written& written) {
  for (const DiffTarget& target : options.diff.outputs) {
    const bool is_text = target.format == DiffFormat::Text;
    const bool is_shown = target.file.empty();
    const std::string text = text_in(target.format, report,
                                     is_shown ? terminal_width() : kLineWidth);
    if (!is_shown) {
      written[target.file] += text;
    } else {
      print_exactly(is_text ? painted(options, text, STDOUT_FILENO) : text);
    }
  }
}

ExitCode compare_two(const ComparedTree& one, const ComparedTree& other,
                     const Revision* revision, Written& written) {
  const auto first = read_of(one, revision);
  const auto second = read_of(other, revision);
  if (!first || !second) return ExitCode::BadInput;
  const Options& options = first->inputs.options;
  Watch watch(options);
  const DiffOptions how{options.ticks.value_or(TickSemantics::Root),
                        options.diff.caller, options.diff.observe,
                        watch.limits};
  auto compared = compare_trees({first->read.tree, first->read.source},
                                {second->read.tree, second->read.source}, how);
  watch.monitor.clear();
  show(options, compared.diagnostics);
  if (!compared.value) return ExitCode::BadInput;
  const auto changes = changes_of(*first, *second, watch.limits);
  watch.monitor.clear();
  if (!changes) return ExitCode::BadInput;
  // What is known is told, however long that takes.
  const BudgetScope telling(nullptr);
  Guard::dismiss();
  DiffReport report{*compared.value,
                    {one.name, other.name},
                    how.caller,
                    how.observe,
                    {&first->inputs.tree, &second->inputs.tree},
                    *changes};
  for (std::size_t side = 0; options.against && side < 2; ++side) {
    const std::string profile(
        profile_name(compared.value->sides[side].tree.profile));
    if (one.name == other.name) report.profiles[side] = profile;
    report.names[side] += " (" + profile + ")";
  }
  if (revision != nullptr) {
    for (DiffChange& each : *report.changes) {
      each.file = revision->shown(each.file);
    }
  }
  tell_all(options, report, written);
  if (!report.diff.error.empty()) complain("BT9002", report.diff.error);
  if (!options.is_quiet) {
    tell(fmt::format("{:.2f} s\n", watch.monitor.seconds()));
  }
  return report.code();
}

// The trees of a folder, by their names in it.
std::map<std::string, ComparedTree> trees_in(const ComparedTree& folder,
                                             const Revision* revision) {
  std::map<std::string, ComparedTree> trees;
  Options options = folder.options;
  options.batch.sources = {folder.input};
  for (const BatchEntry& entry : gather_batch(options)) {
    show(options, revision, entry.diagnostics);
    if (has_error(entry.diagnostics) || !names_tree(entry.input)) continue;
    std::error_code fault;
    std::string name =
        std::filesystem::proximate(entry.input, folder.input, fault).string();
    ComparedTree tree{entry.input, applied(options, entry.choices),
                      folder.name + '/' + name};
    tree.options.input = entry.input;
    tree.options.project = entry.project;
    if (!tree.options.main_tree.empty()) name += ' ' + tree.options.main_tree;
    trees.emplace(std::move(name), std::move(tree));
  }
  return trees;
}

ExitCode compare_folders(const ComparedTree& one, const ComparedTree& other,
                         const Revision* revision, Written& written) {
  const auto before = trees_in(one, revision);
  const auto now = trees_in(other, revision);
  ExitCode worst = ExitCode::Met;
  std::size_t compared = 0;
  const auto alone = [&](const std::string& name, const std::string& where) {
    worst = worst_of(worst, ExitCode::Missed);
    const std::string line = fmt::format("{}: in {} only\n", name, where);
    for (const DiffTarget& target : one.options.diff.outputs) {
      if (target.file.empty()) {
        print(line);
      } else {
        written[target.file] += line;
      }
    }
  };
  for (const auto& [name, tree] : before) {
    const auto partner = now.find(name);
    if (partner == now.end()) {
      alone(name, one.name);
      continue;
    }
    if (compared++ > 0) print("\n");
    limits_of_command().restart();
    worst =
        worst_of(worst, compare_two(tree, partner->second, revision, written));
  }
  for (const auto& [name, tree] : now) {
    if (!before.contains(name)) alone(name, other.name);
  }
  if (before.empty() && now.empty()) {
    complain("BT0003",
             fmt::format("no trees in `{}` and `{}`", one.name, other.name));
    return ExitCode::BadInput;
  }
  return worst;
}

ExitCode compare(const ComparedTree& one, const ComparedTree& other,
                 const Revision* revision) {
  Written written;
  const bool are_folders = is_folder(one.input) && is_folder(other.input);
  const auto has_page = std::ranges::any_of(
      one.options.diff.outputs, [](const DiffTarget& target) {
        return target.format == DiffFormat::Json ||
               target.format == DiffFormat::Html;
      });
  if (are_folders && has_page) {
    complain("BT0001",
             "two folders are compared in text or Markdown: JSON and pages are "
             "of two trees");
    return ExitCode::BadInput;
  }
  for (const DiffTarget& target : one.options.diff.outputs) {
    const std::string obstacle =
        target.file.empty() ? "" : obstacle_to(target.file);
    if (obstacle.empty()) continue;
    complain("BT0004", obstacle);
    return ExitCode::BadInput;
  }
  const auto compared = are_folders ? compare_folders : compare_two;
  ExitCode code = compared(one, other, revision, written);
  for (const auto& [file, text] : written) {
    const std::string complaint = write_file(file, text);
    if (complaint.empty()) continue;
    complain("BT0004", complaint);
    code = worst_of(code, ExitCode::BadInput);
  }
  return code;
}

}  // namespace

ExitCode run_diff(const Options& options) {
  const std::string& input = options.inputs[0];
  ComparedTree now{options.inputs.back(), options, options.inputs.back()};
  now.options.input = now.input;
  if (options.against) now.options.profile = options.against;
  const std::string& revision = options.diff.revision;
  if (revision.empty()) return compare({input, options, input}, now, nullptr);
  const auto then = Revision::with(revision, input);
  show(options, then.diagnostics);
  if (!then.value) return ExitCode::BadInput;
  ComparedTree before{then.value->input(), options, revision + ':' + input};
  before.options.input = before.input;
  before.options.roots = {then.value->folder()};
  return compare(before, now, &*then.value);
}

}  // namespace btcheck
