// SPDX-License-Identifier: MIT
//
// `btcheck tests TREE -o DIR`: scripted runs that reach all that is possible,
// as files of tests.
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "check/check.hpp"
#include "cli/commands.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "report/text/report.hpp"
#include "suites/driven_entries.hpp"
#include "suites/fault_runs.hpp"
#include "suites/formats.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

// A file, seen from the folder of the tests.
std::string seen_from(const fs::path& folder, const std::string& file) {
  std::error_code fault;
  const fs::path path =
      fs::absolute(file, fault).lexically_relative(fs::absolute(folder, fault));
  return path.empty() ? file : path.generic_string();
}

// The command that goes through a run of the tree, read as it was here.
std::vector<std::string> program_of(const Options& options,
                                    const TreeInput& tree,
                                    const fs::path& folder) {
  const bool is_btf = !is_xml(tree.name, tree.text);
  std::vector<std::string> words = {is_btf ? "run" : "simulate",
                                    seen_from(folder, tree.name)};
  if (is_btf) words.emplace_back("--no-wait");
  const auto add = [&](const char* name, const std::string& value) {
    words.emplace_back(name);
    words.push_back(value);
  };
  if (options.profile) {
    add("--profile", std::string(profile_name(*options.profile)));
  }
  for (const auto& file : options.models) {
    add("--models", seen_from(folder, file));
  }
  for (const auto& file : options.leaves) {
    add("--leaves", seen_from(folder, file));
  }
  if (!options.main_tree.empty()) add("--main-tree", options.main_tree);
  if (!options.settings.empty()) {
    add("--config", seen_from(folder, options.settings));
  }
  if (options.ignores_settings) words.emplace_back("--no-config");
  if (options.tick_ms != 100)
    add("--tick-ms", fmt::format("{}", options.tick_ms));
  if (options.loops) words.emplace_back("--loop");
  return words;
}

std::vector<SuiteFile> files_of(const Options& options,
                                const DescribedSuite& described,
                                const BehaviorTree& tree, const Suite& suite,
                                const TreeInput& input,
                                const std::string& contracts) {
  const auto wants = [&](TestForm form) {
    return options.tests.forms.empty() || options.tests.forms.contains(form);
  };
  std::vector<SuiteFile> files;
  if (wants(TestForm::GoogleTest) && described.release != 0) {
    files = googletest_files(described, tree, suite);
  }
  if (wants(TestForm::Pytest)) {
    auto program = program_of(options, input, options.output);
    if (!contracts.empty()) {
      files.push_back({described.name + ".leaves",
                       fmt::format("; {}: entries that the program around the "
                                   "tree decides.\n{}",
                                   kSuiteMark, contracts)});
      program.insert(program.end(), {"--leaves", files.back().name});
    }
    files.push_back(pytest_file(described, tree, suite, program));
  }
  if (wants(TestForm::JsonLines)) {
    files.push_back(jsonl_file(described, tree, suite));
  }
  return files;
}

// Nothing that somebody else has written is replaced.
std::string obstacle(const std::string& file) {
  std::error_code fault;
  if (!fs::exists(fs::symlink_status(file, fault))) return {};
  const auto there = read_file(file);
  if (!there.value) return fmt::format("cannot write `{}`", file);
  constexpr std::size_t kBeginning = 1000;
  const std::string_view text = there.value->text;
  return text.substr(0, kBeginning).find(kSuiteMark) != text.npos
             ? ""
             : fmt::format(
                   "`{}` is there, and not written by `btcheck tests`; "
                   "--force replaces it",
                   file);
}

// All of them, or none.
bool write_files(const Options& options, const std::vector<SuiteFile>& files) {
  const auto path_of = [&](const SuiteFile& file) {
    return (fs::path(options.output) / file.name).string();
  };
  std::string complaint = make_directory(options.output);
  for (const SuiteFile& file : files) {
    if (!complaint.empty()) break;
    if (!options.tests.forces) complaint = obstacle(path_of(file));
  }
  std::vector<std::string> made;
  for (const SuiteFile& file : files) {
    if (!complaint.empty()) break;
    const std::string path = path_of(file);
    std::error_code fault;
    if (!fs::exists(path, fault)) made.push_back(path);
    complaint = replace_file(path, file.text);
  }
  if (complaint.empty()) return true;
  for (const std::string& path : made) {
    std::error_code fault;
    fs::remove(path, fault);
  }
  complain("BT0004", complaint);
  return false;
}

// Half of the time and memory is for what comes after.
class HalfOf final : public SearchMonitor {
 public:
  explicit HalfOf(SearchMonitor& whole) : whole_(whole) {}

  StopReason observe(const SearchProgress& progress) override {
    const StopReason reason = whole_.observe(progress);
    return reason == StopReason::None && !whole_.has_spare()
               ? StopReason::Timeout
               : reason;
  }
  bool may_tell() override { return whole_.may_tell(); }
  bool has_spare() override { return whole_.has_spare(); }

 private:
  SearchMonitor& whole_;
};

// What single faults do, as far as half of what is left is enough for it.
FaultRuns runs_of_faults(const TreeInput& tree, const ForcedNetwork& forced,
                         Watch& watch) {
  const auto input = what_if_input(tree, {});
  if (!input.value) return {};
  HalfOf half(watch.monitor);
  WhatIfOptions how;
  how.ticks = forced.network().ticks;
  how.limits = watch.limits;
  how.limits.monitor = &half;
  const auto result = what_if(*input.value, how);
  if (!result.value) return {};
  return fault_runs(forced, *input.value, *result.value, how.ticks);
}

}  // namespace

ExitCode run_tests(const Options& asked) {
  std::vector<Diagnostic> found;
  auto inputs = read_inputs(asked, found);
  if (!inputs) return ExitCode::BadInput;
  // Tests tick by tickExactlyOnce, whatever the program does.
  inputs->tree.reading.wakes = false;
  const Options& options = inputs->options;
  Watch watch(options);
  CheckOptions how = check_options(options, watch.limits);
  HalfOf half(watch.monitor);
  how.limits.monitor = &half;
  how.tries_repairs = false;
  const CheckResult result = check(inputs->tree, {}, how);
  show(options, result.diagnostics);
  if (result.is_broken || !result.tree || result.files.empty()) {
    return ExitCode::BadInput;
  }
  const BehaviorTree& tree = *result.tree;
  if (tree.roots.size() != 1) {
    complain("BT0001",
             "tests: several trees at once have none; name a file with one");
    return ExitCode::BadInput;
  }
  const Network& network = *result.files.front().network;
  const auto driven = driven_tree(inputs->tree, tree, network.ticks);
  const TreeInput& input = driven ? driven->input : inputs->tree;
  const BehaviorTree& forced_tree = driven ? driven->lowered.tree : tree;
  const CompiledNetwork system(driven ? driven->lowered.network : network);
  const ForcedNetwork forced(forced_tree, system);
  const CompiledNetwork whole(network);
  const ForcedNetwork reported(tree, whole);
  const DefaultReport& defaults = *result.files.front().defaults;
  const FaultRuns faults = runs_of_faults(inputs->tree, forced, watch);
  Suite suite =
      make_suite(forced, reported, defaults, faults.runs, watch.limits);
  watch.monitor.clear();
  const DescribedSuite described = described_suite(input, forced_tree);
  note_scripts(described, forced_tree, system.network(), suite);
  auto files = files_of(options, described, forced_tree, suite, input,
                        driven ? driven->contracts : "");
  if (files.empty()) {
    complain("BT0001",
             "tests: googletest is for trees of BehaviorTree.CPP; --to pytest "
             "and --to jsonl are for all");
    return ExitCode::BadInput;
  }
  if (!write_files(options, files)) return ExitCode::BadInput;
  std::string told = suite_summary(suite, tree) + faults_summary(faults);
  if (!options.is_quiet) {
    for (const SuiteFile& file : files) {
      told +=
          fmt::format("{}\n", (fs::path(options.output) / file.name).string());
    }
  }
  print(told);
  const bool is_whole =
      suite.is_complete && defaults.stopped == StopReason::None;
  if (!is_whole) {
    tell("the search was stopped: what it has not seen is in no test\n");
  }
  return worst_of(is_whole ? ExitCode::Met : ExitCode::Undecided,
                  result.judged.is_denied ? ExitCode::Missed : ExitCode::Met);
}

}  // namespace btcheck
