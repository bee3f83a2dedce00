// SPDX-License-Identifier: MIT
#include "batch/watch/changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <tuple>
#include <utility>

#include "batch/report.hpp"
#include "cli/inputs/inputs.hpp"
#include "report/formats/formats.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// The same for the same finding when lines have moved.
using FindingKey = std::tuple<Severity, std::string, std::string, std::string>;

FindingKey key_of(const Finding& finding) {
  return {finding.severity, finding.code, finding.place.file, finding.identity};
}

// Without empty lines around it.
std::string trimmed(std::string text) {
  text.erase(0, text.find_first_not_of('\n'));
  while (text.ends_with('\n')) text.pop_back();
  return text + '\n';
}

// "NO FAULT  dock.xml: no rules, 585 states, 0.01 s".
std::string state_line(const ReportedTree& tree) {
  const std::string head = fmt::format("{}  {}", word_of(outcome_of(tree)),
                                       one_line(title_of(tree)));
  if (tree.files.empty()) return head + '\n';
  const PropertyCounts counts = properties_of(tree);
  const std::string rules =
      has_no_rules(tree)
          ? "no rules"
          : fmt::format("{} of {} met",
                        counts.all - counts.missed - counts.undecided,
                        counted(counts.all, "rule", "rules"));
  return fmt::format("{}: {}, {} states, {:.2f} s\n", head, rules,
                     grouped(states_of(tree)), tree.seconds);
}

}  // namespace

std::string round_heading(const std::string& time,
                          const std::vector<std::string>& files,
                          std::size_t width) {
  constexpr std::size_t kMost = 3;
  std::string text = fmt::format("-- {} ", time);
  for (std::size_t i = 0; i < std::min(kMost, files.size()); ++i) {
    text += (i == 0 ? " " : ", ") + one_line(files[i]);
  }
  if (files.size() > kMost) {
    text += fmt::format(" and {} more", files.size() - kMost);
  }
  const auto length = static_cast<std::size_t>(count_code_points(text)) + 1;
  return fmt::format("\n{} {}\n", text,
                     std::string(width > length ? width - length : 2, '-'));
}

// The findings of an entry beside those that it had.
struct ChangeTeller::Sorted {
  std::vector<Finding> kept;
  std::vector<Finding> fresh;
  std::vector<Finding> gone;
};

// What a check of one tree shows of them.
std::vector<Finding> ChangeTeller::shown(const ReportedTree& tree) const {
  ReportedTree distinct = tree;
  distinct.diagnostics = without_repetitions(tree.diagnostics);
  std::vector<Finding> findings = all_findings(distinct);
  // Told as they were read, and not as programs are told of them.
  for (std::size_t i = 0; i < distinct.diagnostics.size(); ++i) {
    findings[i].told = render(distinct.diagnostics[i]);
  }
  std::erase_if(findings, [&](const Finding& each) {
    return each.severity == Severity::Note && !is_verbose_ &&
           (tree.judged.has_baseline || each.about == Finding::About::Input);
  });
  return findings;
}

ChangeTeller::Sorted ChangeTeller::sorted(const ReportedTree* before,
                                          const ReportedTree& now) const {
  Sorted all;
  std::multimap<FindingKey, Finding> old;
  if (before != nullptr) {
    for (Finding& each : shown(*before)) {
      old.emplace(key_of(each), std::move(each));
    }
  }
  for (Finding& each : shown(now)) {
    const auto same = old.find(key_of(each));
    const bool is_known = same != old.end();
    if (is_known) old.erase(same);
    (is_known ? all.kept : all.fresh).push_back(std::move(each));
  }
  for (auto& [key, finding] : old) all.gone.push_back(std::move(finding));
  return all;
}

bool ChangeTeller::stands_in_saved(const Finding& finding) const {
  return saved_.contains(
      std::filesystem::path(finding.place.file).lexically_normal().string());
}

std::string ChangeTeller::told(const ReportedTree& tree,
                               const Finding& finding) const {
  if (finding.about == Finding::About::Rule) {
    for (const Shortfall& each : missed_rules(tree, OpenRules::Each)) {
      if (each.name == finding.title) {
        return trimmed(shortfall_text(each, layout_.width));
      }
    }
  }
  return trimmed(finding.told.empty()
                     ? finding_line(tree, finding, layout_.width)
                     : finding.told);
}

std::string ChangeTeller::gone_text(const ReportedTree* before,
                                    const Sorted& all) const {
  std::string text;
  for (const Finding& each : all.gone) {
    if (text.empty()) text = "\ngone:\n";
    text += finding_line(*before, each, layout_.width);
  }
  return text;
}

// Those that are wanted, below their label.
template <class IsWanted>
std::string ChangeTeller::part(std::string_view label, const ReportedTree& tree,
                               const std::vector<Finding>& findings,
                               const IsWanted& is_wanted) {
  std::string text;
  for (const Finding& each : findings) {
    std::string one = told(tree, each);
    const bool is_new = told_.insert(one).second;
    if (!is_wanted(each, is_new)) continue;
    if (text.empty()) text = label;
    text += one + '\n';
  }
  if (text.ends_with("\n\n")) text.pop_back();
  return text;
}

std::string ChangeTeller::whole(const ReportedTree* before,
                                const ReportedTree& now) {
  const Sorted all = sorted(before, now);
  const bool is_first = before == nullptr;
  const auto each = [](const Finding&, bool) { return true; };
  return state_line(now) + gone_text(before, all) +
         part("\nas before:\n", now, all.kept, each) +
         part(is_first ? "\n" : "\nnew:\n", now, all.fresh, each);
}

std::string ChangeTeller::difference(const ReportedTree* before,
                                     const ReportedTree& now) {
  if (before == nullptr) return whole(before, now);
  const Sorted all = sorted(before, now);
  const std::string text =
      gone_text(before, all) +
      part("\nas before:\n", now, all.kept,
           [&](const Finding& each, bool is_new) {
             return is_new && stands_in_saved(each);
           }) +
      part("\nnew:\n", now, all.fresh,
           [](const Finding&, bool is_new) { return is_new; });
  const bool is_otherwise = outcome_of(*before) != outcome_of(now);
  if (text.empty() && !is_otherwise) return {};
  return state_line(now) + text;
}

}  // namespace btcheck
