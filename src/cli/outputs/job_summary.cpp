// SPDX-License-Identifier: MIT
//
// The page that GitHub shows of a job, to which other steps write as well. It
// draws Mermaid: of runs that were kept as files, the first wrong ones are
// pictures there.
#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/outputs/write_reports.hpp"
#include "report/formats/escapes.hpp"
#include "report/formats/formats.hpp"
#include "trace/pictures/pictures.hpp"
#include "trace/run/itf.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostPictures = 5;
// About as many nodes as somebody can look at, eighty.
constexpr std::size_t kMostOfPicture = 8000;

// The state that counts of the run with this page; "" where it is too large.
std::string mermaid_of(const std::string& page) {
  const auto file = read_file(without_ending(page) + ".itf.json");
  if (!file.value) return {};
  const auto run = read_itf(file.value->name, file.value->text);
  if (!run.value) return {};
  const std::string text = mermaid_text(*run.value, shown_state(*run.value));
  return text.size() > kMostOfPicture ? std::string() : harmless(text);
}

class Pictures {
 public:
  void add(const ReportedTree& tree, const std::string& page,
           const std::string& what) {
    if (count_ == kMostPictures || page.empty()) return;
    const std::string picture = mermaid_of(page);
    if (picture.empty()) return;
    ++count_;
    const std::string title = fmt::format("{}: {}", title_of(tree), what);
    text_ += fmt::format(
        "<details><summary>{}</summary>\n\n```mermaid\n{}```\n\n</details>\n\n",
        markdown_text(title), picture);
  }

  std::string take() { return std::move(text_); }

 private:
  std::size_t count_ = 0;
  std::string text_;
};

std::string pictures(const Report& report) {
  Pictures made;
  for (const ReportedTree& tree : report.trees) {
    for (const Shortfall& each : shortfalls_of(tree)) {
      made.add(tree, each.page, fmt::format("{} {}", each.word, each.name));
    }
  }
  for (const Severity level : {Severity::Error, Severity::Warning}) {
    for (const ReportedTree& tree : report.trees) {
      for (const Finding& each : tree.findings) {
        if (each.severity != level || !is_of_tree(each)) continue;
        made.add(tree, each.page,
                 each.message.substr(0, each.message.find('\n')));
      }
    }
  }
  return made.take();
}

}  // namespace

std::string add_job_summary(const Report& report) {
  const char* file = std::getenv("GITHUB_STEP_SUMMARY");
  if (file == nullptr || *file == '\0') return {};
  return append_file(file, job_summary_text(report) + pictures(report));
}

}  // namespace btcheck
