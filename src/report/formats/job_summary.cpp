// SPDX-License-Identifier: MIT
//
// Who opens a job's page wants to know what is wrong: that comes first, and all
// the rest is folded away.
#include "report/formats/job_summary.hpp"

#include <fmt/format.h>

#include "report/formats/escapes.hpp"
#include "report/formats/outcome.hpp"
#include "report/text/report.hpp"

namespace btcheck {
namespace {

// GitHub takes a mebibyte for a step; what is wrong rarely needs more.
constexpr std::size_t kMostShortfalls = 200;

std::string row(const ReportedTree& tree) {
  const PropertyCounts counts = properties_of(tree);
  return fmt::format("| {} | {} | {} | {} | {} | {} | {:.2f} s |\n",
                     word_of(outcome_of(tree)), markdown_text(title_of(tree)),
                     counts.holds, counts.violated, counts.undecided,
                     grouped(states_of(tree)), tree.seconds);
}

std::string shortfall_rows(const ReportedTree& tree, std::size_t& left) {
  std::string text;
  for (const Shortfall& found : shortfalls_of(tree)) {
    if (left == 0) return text;
    --left;
    std::string what = markdown_text(found.name);
    if (!found.text.empty()) {
      what += fmt::format("{}{}", what.empty() ? "" : ": ",
                          markdown_text(found.text));
    }
    if (!found.title.empty()) what += "<br>" + markdown_text(found.title);
    text += fmt::format("| {} | {} | {} |\n", markdown_text(title_of(tree)),
                        markdown_text(found.word), what);
  }
  return text;
}

std::string shortfalls_table(const Report& report) {
  std::size_t left = kMostShortfalls;
  std::string rows;
  for (const ReportedTree& tree : report.trees) {
    rows += shortfall_rows(tree, left);
  }
  if (rows.empty()) return {};
  return "| tree | | what |\n|---|---|---|\n" + rows +
         (left == 0 ? "\nOthers are left out here.\n\n" : "\n");
}

}  // namespace

std::string job_summary_text(const Report& report) {
  std::string text = fmt::format("### btcheck: {}\n\n", sum_of(report));
  text += shortfalls_table(report);
  text += fmt::format(
      "<details><summary>every tree</summary>\n\n"
      "| result | tree | hold | violated | undecided | states | time |\n"
      "|---|---|--:|--:|--:|--:|--:|\n");
  for (const ReportedTree& tree : report.trees) text += row(tree);
  return text + "\n</details>\n\n";
}

}  // namespace btcheck
