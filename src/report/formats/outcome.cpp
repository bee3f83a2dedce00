// SPDX-License-Identifier: MIT
//
// What a report comes to in a line: one outcome for each tree, how many there
// are of each, and what is missing where a rule was left open.
#include "report/formats/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "report/text/report.hpp"

namespace btcheck {
namespace {

struct OutcomeWords {
  std::string_view word;
  std::string_view counted;  // behind a number
};
constexpr std::array<OutcomeWords, kOutcomeCount> kWords = {
    {{"MET", "met"},
     {"MISSED", "missed"},
     {"BROKEN", "broken"},
     {"UNDECIDED", "undecided"},
     {"FAILED", "failed"},
     {"NOT RUN", "not run"},
     {"NO FAULT", "without a fault"},
     {"FAULT", "with a fault"}}};
// As they are counted: what is good first, then what somebody should look at.
constexpr std::array<TreeOutcome, kOutcomeCount> kInOrder = {
    TreeOutcome::Met,    TreeOutcome::NoFault, TreeOutcome::Missed,
    TreeOutcome::Fault,  TreeOutcome::Broken,  TreeOutcome::Undecided,
    TreeOutcome::Failed, TreeOutcome::NotRun};

void count(PropertyCounts& counts, Verdict verdict, bool is_met) {
  ++counts.all;
  counts.holds += verdict == Verdict::Holds;
  counts.violated += verdict == Verdict::Violated;
  counts.undecided += verdict == Verdict::Undecided;
  counts.missed += !is_met;
}

// "the limit of --timeout; allow more", of "after 12 states: the limit of …".
std::string limit_of(const ReportedProperty& property) {
  const std::string& note = property.note;
  const std::size_t colon = note.find(": ");
  return note.starts_with("after ") && colon != note.npos
             ? note.substr(colon + 2)
             : note;
}

// Of properties that the same limit has left open.
Shortfall left_open(const std::vector<const ReportedProperty*>& open) {
  constexpr std::size_t kMostNames = 3;
  Shortfall made{.word = "UNDECIDED"};
  for (std::size_t i = 0; i < std::min(open.size(), kMostNames); ++i) {
    made.name += (i == 0 ? "" : ", ") + open[i]->name;
  }
  if (open.size() > kMostNames) {
    made.name += fmt::format(" and {} more", open.size() - kMostNames);
  }
  made.text = open.size() == 1 ? open[0]->note : limit_of(*open[0]);
  return made;
}

void add_missed(std::vector<Shortfall>& to, const ReportedFile& file,
                OpenRules how) {
  std::map<std::string, std::vector<const ReportedProperty*>> open;
  for (const ReportedProperty& property : file.verdicts) {
    if (!property.error.empty()) {
      to.push_back(
          {"FAILED", property.name, "internal error: " + property.error});
    } else if (!property.is_met || (how == OpenRules::Each &&
                                    property.verdict == Verdict::Undecided)) {
      to.push_back({std::string(verdict_word(property.verdict)), property.name,
                    property.note, property.title,
                    property.is_met ? "" : property.told, property.page});
    } else if (property.verdict == Verdict::Undecided) {
      open[limit_of(property)].push_back(&property);
    }
  }
  for (const auto& [limit, properties] : open) {
    to.push_back(left_open(properties));
  }
}

void add_answers(std::vector<Shortfall>& to, const ReportedTree& tree,
                 const ReportedFile& file) {
  for (const ReportedAnswer& answer : file.answers) {
    if (!answer.is_fault) continue;
    to.push_back({.word = std::string(word_of(answer)),
                  .name = answer.question,
                  .text = answer.answer,
                  .page = answer.page});
  }
  for (const Finding& each : tree.findings) {
    if (each.about != Finding::About::Mission) continue;
    if (each.code == rule::kUndecided) {
      to.push_back({.word = "UNDECIDED", .text = each.message});
    }
  }
  if (file.error.empty()) return;
  to.push_back({.word = "FAILED", .text = "internal error: " + file.error});
}

}  // namespace

std::string_view word_of(TreeOutcome outcome) {
  return kWords[static_cast<std::size_t>(outcome)].word;
}

bool is_good(TreeOutcome outcome) {
  return outcome == TreeOutcome::Met || outcome == TreeOutcome::NoFault;
}

bool has_no_rules(const ReportedTree& tree) {
  return tree.files.size() == 1 && tree.files[0].properties.empty();
}

std::string_view word_of(const ReportedAnswer& answer) {
  if (answer.verdict == Verdict::Undecided) return "UNDECIDED";
  return answer.is_fault ? "FAULT" : "FINE";
}

TreeOutcome outcome_of(const ReportedTree& tree) {
  if (!tree.not_run.empty()) return TreeOutcome::NotRun;
  if (has_no_rules(tree) && tree.code == ExitCode::Met) {
    return TreeOutcome::NoFault;
  }
  if (has_no_rules(tree) && tree.code == ExitCode::Missed) {
    return TreeOutcome::Fault;
  }
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

std::string levels_text(const std::vector<Finding>& findings) {
  std::string text;
  for (const Severity severity :
       {Severity::Error, Severity::Warning, Severity::Note}) {
    const auto count = static_cast<std::size_t>(
        std::ranges::count(findings, severity, &Finding::severity));
    if (count == 0) continue;
    const std::string_view word = severity_name(severity);
    text += (text.empty() ? "" : ", ") +
            counted(count, word, fmt::format("{}s", word));
  }
  return text;
}

std::string sum_of(const Report& report) {
  const OutcomeCounts counts = outcomes_of(report);
  std::string text = counted(report.trees.size(), "entry", "entries");
  std::string_view before = ": ";
  const bool has_good = std::ranges::any_of(
      report.trees,
      [](const ReportedTree& tree) { return is_good(outcome_of(tree)); });
  for (const TreeOutcome outcome : kInOrder) {
    const auto i = static_cast<std::size_t>(outcome);
    const bool says_none = outcome == TreeOutcome::Met && !has_good;
    if (counts[i] == 0 && !says_none) continue;
    text += fmt::format("{}{} {}", before, counts[i], kWords[i].counted);
    before = ", ";
  }
  std::vector<Finding> findings;
  for (const ReportedTree& tree : report.trees) {
    if (!tree.not_run.empty()) continue;
    std::ranges::move(all_findings(tree), std::back_inserter(findings));
  }
  // What is undecided was counted by entries.
  std::erase_if(findings, [](const Finding& each) {
    return each.code == rule::kUndecided;
  });
  const std::string levels = levels_text(findings);
  const std::string judged = judged_text(count_of(report));
  if (levels.empty() && judged.empty()) return text;
  return fmt::format("{}; {}{}", text, levels.empty() ? "no findings" : levels,
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
  for (const ReportedFile& file : tree.files) {
    add_missed(found, file, OpenRules::Together);
    add_answers(found, tree, file);
  }
  return found;
}

std::vector<Shortfall> missed_rules(const ReportedTree& tree, OpenRules open) {
  std::vector<Shortfall> found;
  for (const ReportedFile& file : tree.files) add_missed(found, file, open);
  return found;
}

}  // namespace btcheck
