// SPDX-License-Identifier: MIT
#include "batch/watch/view.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "cli/inputs/files.hpp"
#include "report/formats/formats.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

// How long the end waits for those who look on.
constexpr std::chrono::milliseconds kPatience{500};

// The run of what is wrong that the report tells first; "" for none. What only
// asks is not wrong.
std::string page_of(const ReportedTree& tree) {
  for (const ReportedFile& file : tree.files) {
    for (const ReportedProperty& each : file.verdicts) {
      if (!each.is_met && !each.page.empty()) return each.page;
    }
    for (const ReportedAnswer& each : file.answers) {
      if (each.is_fault && !each.page.empty()) return each.page;
    }
  }
  for (const Severity severity : {Severity::Error, Severity::Warning}) {
    for (const Finding& each : tree.findings) {
      if (each.severity == severity && !each.page.empty()) return each.page;
    }
  }
  return {};
}

// A page without a run: a heading, and the file.
RecordedRun heading_alone(const std::string& file, std::string verdict,
                          std::string words, std::string why = {}) {
  RecordedRun run;
  run.tree = file;
  run.ticks = "root";
  run.verdict = std::move(verdict);
  run.property = std::move(words);
  run.why = std::move(why);
  const auto read = read_file(file);
  if (read.value) run.source = read.value->text;
  run.states.emplace_back();
  return run;
}

RecordedRun without_run(const ReportedTree& tree) {
  const std::string word(word_of(outcome_of(tree)));
  const auto all = all_findings(tree);
  const auto worst = std::ranges::min_element(
      all, {}, [](const Finding& each) { return each.severity; });
  if (worst == all.end() || worst->severity == Severity::Note) {
    return heading_alone(tree.file, word, "nothing is wrong");
  }
  return heading_alone(tree.file, word, "no run shows what is wrong",
                       worst->message.substr(0, worst->message.find('\n')));
}

std::optional<RecordedRun> kept_run(const std::string& page) {
  constexpr std::string_view kPage = ".html";
  const auto read =
      read_file(page.substr(0, page.size() - kPage.size()) + ".itf.json");
  if (!read.value) return std::nullopt;
  return read_itf(read.value->name, read.value->text).value;
}

}  // namespace

CheckView::CheckView(Options& options)
    : run_(heading_alone("", "", "being checked"), LiveRun::Kind::Replaced),
      server_(run_) {
  if (!options.trace_dir.empty()) return;
  own_folder_ = fs::temp_directory_path() / "btcheck-watch-XXXXXX";
  if (::mkdtemp(own_folder_.data()) == nullptr) {
    throw std::system_error(errno, std::generic_category());
  }
  options.trace_dir = own_folder_;
}

CheckView::~CheckView() {
  std::error_code ignored;
  if (!own_folder_.empty()) fs::remove_all(own_folder_, ignored);
}

bool CheckView::has_run(const ReportedTree& tree) {
  return !page_of(tree).empty();
}

void CheckView::show(const ReportedTree& tree) {
  const std::string page = page_of(tree);
  auto run = page.empty() ? std::nullopt : kept_run(page);
  run_.begin_anew(run ? std::move(*run) : without_run(tree));
}

void CheckView::end() {
  run_.end("");
  server_.finish(kPatience);
}

}  // namespace btcheck
