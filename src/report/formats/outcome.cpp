// SPDX-License-Identifier: MIT
#include "report/formats/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "report/text/report.hpp"

namespace btcheck {
namespace {

constexpr std::array<std::string_view, kOutcomeCount> kWords = {
    "MET", "MISSED", "BROKEN", "UNDECIDED", "FAILED", "NOT RUN"};
constexpr std::array<std::string_view, kOutcomeCount> kLower = {
    "met", "missed", "broken", "undecided", "failed", "not run"};

void count(PropertyCounts& counts, Verdict verdict, bool is_met) {
  ++counts.all;
  counts.holds += verdict == Verdict::Holds;
  counts.violated += verdict == Verdict::Violated;
  counts.undecided += verdict == Verdict::Undecided;
  counts.missed += !is_met;
}

void add_shortfalls(std::vector<Shortfall>& to, const ReportedFile& file) {
  for (const ReportedProperty& property : file.verdicts) {
    if (!property.error.empty()) {
      to.push_back(
          {"FAILED", property.name, "internal error: " + property.error});
    } else if (!property.is_met || property.verdict == Verdict::Undecided) {
      to.push_back({std::string(verdict_word(property.verdict)), property.name,
                    property.note, property.title,
                    property.is_met ? "" : property.told, property.page});
    }
  }
  for (const ReportedAnswer& answer : file.answers) {
    if (!answer.is_fault && answer.verdict != Verdict::Undecided) continue;
    to.push_back({.word = std::string(word_of(answer)),
                  .name = answer.question,
                  .text = answer.answer,
                  .page = answer.page});
  }
  if (file.error.empty()) return;
  to.push_back({.word = "FAILED", .text = "internal error: " + file.error});
}

}  // namespace

std::string_view word_of(TreeOutcome outcome) {
  return kWords[static_cast<std::size_t>(outcome)];
}

std::string_view word_of(const ReportedAnswer& answer) {
  if (answer.verdict == Verdict::Undecided) return "UNDECIDED";
  return answer.is_fault ? "FAULT" : "FINE";
}

TreeOutcome outcome_of(const ReportedTree& tree) {
  if (!tree.not_run.empty()) return TreeOutcome::NotRun;
  return static_cast<TreeOutcome>(tree.code);
}

PropertyCounts properties_of(const ReportedTree& tree) {
  PropertyCounts counts;
  for (const ReportedFile& file : tree.files) {
    for (const ReportedProperty& property : file.verdicts) {
      count(counts, property.verdict, property.is_met);
    }
    for (const ReportedAnswer& answer : file.answers) {
      const bool is_open = answer.verdict == Verdict::Undecided;
      count(counts,
            is_open           ? Verdict::Undecided
            : answer.is_fault ? Verdict::Violated
                              : Verdict::Holds,
            !answer.is_fault);
    }
  }
  return counts;
}

OutcomeCounts outcomes_of(const Report& report) {
  OutcomeCounts counts{};
  for (const ReportedTree& tree : report.trees) {
    ++counts[static_cast<std::size_t>(outcome_of(tree))];
  }
  return counts;
}

std::vector<const Judged*> judged_of(const Report& report) {
  std::vector<const Judged*> judged;
  for (const ReportedTree& tree : report.trees) judged.push_back(&tree.judged);
  return judged;
}

JudgedCount count_of(const Report& report) {
  JudgedCount sum;
  for (const Judged* judged : judged_of(report)) {
    const JudgedCount count = count_of(*judged);
    sum.allowed += count.allowed;
    sum.known += count.known;
  }
  return sum;
}

std::string sum_of(const Report& report) {
  const OutcomeCounts counts = outcomes_of(report);
  std::string text =
      fmt::format("{}: {} met",
                  counted(report.trees.size(), "entry", "entries"), counts[0]);
  for (std::size_t i = 1; i < kOutcomeCount; ++i) {
    if (counts[i] > 0) text += fmt::format(", {} {}", counts[i], kLower[i]);
  }
  std::size_t findings = 0;
  for (const ReportedTree& tree : report.trees) {
    findings += static_cast<std::size_t>(
        std::ranges::count_if(tree.findings, is_of_tree));
  }
  const std::string judged = judged_text(count_of(report));
  if (findings == 0 && judged.empty()) return text;
  return fmt::format("{}; {}{}", text, counted(findings, "finding", "findings"),
                     judged);
}

std::vector<Shortfall> shortfalls_of(const ReportedTree& tree) {
  std::vector<Shortfall> found;
  for (const Diagnostic& diagnostic : tree.diagnostics) {
    if (diagnostic.severity != Severity::Error) continue;
    std::string place = place_text({diagnostic.file, diagnostic.span});
    if (!place.empty()) place += ": ";
    found.push_back({.word = fmt::format("error[{}]", diagnostic.code),
                     .text = place + diagnostic.message,
                     .title = diagnostic.help});
  }
  for (const Finding& each : tree.findings) {
    if (each.severity != Severity::Error || !is_of_tree(each)) continue;
    found.push_back({.word = fmt::format("error[{}]", each.code),
                     .text = place_text(each.place) + ": " +
                             each.message.substr(0, each.message.find('\n'))});
  }
  for (const ReportedFile& file : tree.files) add_shortfalls(found, file);
  return found;
}

}  // namespace btcheck
