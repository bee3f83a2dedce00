// SPDX-License-Identifier: MIT
#include "batch/text.hpp"

#include <fmt/format.h>

#include "report/formats/outcome.hpp"
#include "report/text/report.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kLine = "{:<9}  {:>10}  {:>13}  {:>9}  {}\n";

// As many as are met, of all; nothing where nothing was asked.
std::string properties_text(const ReportedTree& tree) {
  const PropertyCounts counts = properties_of(tree);
  if (counts.all == 0) return "-";
  return fmt::format("{} of {}", counts.all - counts.missed - counts.undecided,
                     counts.all);
}

std::string shortfall_text(const Shortfall& found) {
  std::string text = fmt::format("{:<9}  {}", found.word, one_line(found.name));
  if (!found.text.empty()) {
    text += found.name.empty() ? found.text : "  (" + found.text + ")";
  }
  text += '\n';
  if (!found.title.empty()) text += fmt::format("           {}\n", found.title);
  return text + found.told;
}

// Of an entry that was checked; stderr has what is wrong with the others.
std::string shortfalls_text(const ReportedTree& tree) {
  if (tree.files.empty()) return {};
  std::string text;
  for (const Shortfall& found : shortfalls_of(tree)) {
    text += shortfall_text(found);
  }
  if (text.empty()) return {};
  while (text.ends_with("\n\n")) text.pop_back();
  return fmt::format("{}\n{}\n", one_line(title_of(tree)), text);
}

}  // namespace

std::string batch_heading() {
  return fmt::format(kLine, "result", "properties", "states", "time", "entry");
}

std::string batch_line(const ReportedTree& tree) {
  const bool is_checked = !tree.files.empty();
  return fmt::format(kLine, word_of(outcome_of(tree)), properties_text(tree),
                     is_checked ? grouped(states_of(tree)) : "-",
                     is_checked ? fmt::format("{:.2f} s", tree.seconds) : "-",
                     one_line(title_of(tree)));
}

std::string batch_ending(const Report& report) {
  std::string text = "\n";
  for (const ReportedTree& tree : report.trees) text += shortfalls_text(tree);
  return text + sum_of(report) + "\n";
}

std::string batch_text(const Report& report) {
  std::string text = batch_heading();
  for (const ReportedTree& tree : report.trees) text += batch_line(tree);
  return text + batch_ending(report);
}

}  // namespace btcheck
