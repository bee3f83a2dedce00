// SPDX-License-Identifier: MIT
//
// One tree of a batch, checked in the process of a worker: the check, what the
// manifest expects of it, and its runs written to files.
#include "batch/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "batch/results/seal.hpp"
#include "check/repairs/repairs.hpp"
#include "cli/inputs/build.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/options/interface.hpp"
#include "cli/outputs/write_reports.hpp"
#include "project/content.hpp"
#include "report/text/report.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// The expectations of the manifest for properties that do not exist.
std::vector<Diagnostic> unmatched(const BatchEntry& entry,
                                  const Inputs& inputs) {
  std::vector<std::string> names;
  for (const InputFile& file : inputs.properties) {
    const auto read = names_of_properties(file);
    if (!read.value) return {};  // the check says why
    names.insert(names.end(), read.value->begin(), read.value->end());
  }
  std::vector<Diagnostic> found;
  for (const ExpectedVerdict& expected : entry.expected) {
    const std::string& name = expected.property;
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    found.push_back(expected.place);
    found.back().message =
        fmt::format("no property is called `{}`", one_line(name));
    found.back().help = did_you_mean(
        name, names, fmt::format("there are: {}", fmt::join(names, ", ")));
  }
  return found;
}

void expect(CheckResult& result, const std::vector<ExpectedVerdict>& expected) {
  for (CheckedFile& file : result.files) {
    if (!file.properties) continue;
    for (Property& property : file.properties->properties) {
      for (const ExpectedVerdict& one : expected) {
        if (one.property != property.name) continue;
        property.expectation = one.expectation;
      }
    }
  }
}

// Where the runs of an entry go; "" for nowhere.
std::string trace_dir(const BatchEntry& entry, const Options& options) {
  if (options.trace_dir.empty() || entry.folder.empty()) {
    return options.trace_dir;
  }
  return fmt::format("{}/{}", options.trace_dir, entry.folder);
}

// Writes the runs, and notes where they are and what is left out. Returns what
// went wrong, or "".
std::string write_pages(const CheckResult& result, const Inputs& inputs,
                        const std::string& directory, const Limits& limits,
                        ReportedTree& tree) {
  WrittenTraces all;
  for (const CheckedFile& file : result.files) {
    all.add(write_traces(directory, result, file, inputs.tree, limits));
    if (!all.complaint.empty()) return std::move(all.complaint);
  }
  const auto link = [&](auto& told, const std::string& name) {
    if (std::ranges::find(all.names, name) == all.names.end()) return;
    told.page = trace_page(directory, inputs.tree.name, name);
  };
  for (ReportedFile& file : tree.files) {
    for (ReportedProperty& each : file.verdicts) link(each, each.name);
    for (ReportedAnswer& each : file.answers) link(each, each.trace);
  }
  for (Finding& each : tree.findings) link(each, each.trace);
  tree.left_out = all.omissions(directory);
  return {};
}

// What is said of findings, with files as they are seen from here.
template <class Add>
void add_judgement(const Judgement& said, const Add& add) {
  const auto from_here = [&](const std::string& file) {
    return std::filesystem::path(file)
        .lexically_relative(said.directory)
        .string();
  };
  for (const LevelRule& rule : said.levels) {
    add(fmt::format("level {} {} {} {}", rule.code,
                    static_cast<int>(rule.level), from_here(rule.folder),
                    rule.pattern));
  }
  for (const std::string& code : said.denied) add("deny " + code);
  add(fmt::format("baseline {}", said.has_baseline));
  for (const KnownFinding& known : said.baseline) {
    for (const std::string& part :
         {known.code, from_here(known.file), known.node, known.text}) {
      add(part);
    }
    add(std::to_string(known.count));
  }
}

}  // namespace

ReportedTree broken_tree(const BatchEntry& entry,
                         std::vector<Diagnostic> diagnostics) {
  ReportedTree tree;
  tree.entry = entry.name;
  tree.file = tree.root.file = entry.input;
  tree.diagnostics = std::move(diagnostics);
  tree.code = ExitCode::BadInput;
  return tree;
}

ReportedTree unrun_tree(const BatchEntry& entry, std::string reason) {
  ReportedTree tree = broken_tree(entry, {});
  tree.not_run = std::move(reason);
  tree.code = ExitCode::Undecided;
  return tree;
}

std::string key_of(const BatchEntry& entry, const Inputs& inputs,
                   const Options& options) {
  Content all;
  const auto add = [&](std::string_view part) { all.add(part); };
  add(build_identity());
  add(entry.name);
  all.add(inputs.tree);
  all.add(inputs.properties);
  for (const ExpectedVerdict& expected : entry.expected) {
    add(fmt::format("expect {} {}", static_cast<int>(expected.expectation),
                    expected.property));
  }
  add(fmt::format(
      "tick {} search {} reduce {} assume {} states {} time {}",
      options.ticks ? tick_name(*options.ticks) : "",
      static_cast<int>(options.search), static_cast<int>(options.reduce),
      static_cast<int>(options.assume), options.max_states, options.timeout));
  add(options.tries_repairs ? "repairs" : "");
  add(options.any_count ? "any-count" : "");
  add(options.scratch_dir);
  add_judgement(options.judgement, add);
  add(trace_dir(entry, options));
  return content_hash(all.text());
}

ReportedTree checked_tree(const BatchEntry& entry, const Inputs& inputs,
                          const Options& options, const Limits& limits) {
  const auto complaints = unmatched(entry, inputs);
  if (!complaints.empty()) return broken_tree(entry, complaints);
  CheckResult result = check_and_repair(inputs.tree, inputs.properties,
                                        check_options(options, limits));
  expect(result, entry.expected);
  ReportedTree tree = reported(result, inputs.tree.name, exit_code_of(result));
  tree.entry = entry.name;
  tree.main_tree = options.main_tree;
  const std::string directory = trace_dir(entry, options);
  if (directory.empty()) return tree;
  const std::string complaint =
      write_pages(result, inputs, directory, limits, tree);
  if (complaint.empty()) return tree;
  tree.diagnostics.push_back(file_error("BT0004", "", complaint));
  tree.code = worst_of(tree.code, ExitCode::BadInput);
  return tree;
}

}  // namespace btcheck
