// SPDX-License-Identifier: MIT
//
// The table says of each entry what is wrong with it, and ends with the runs
// that break rules; the page begins with those, and has all entries, folded.
#include "batch/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "cli/options/interface.hpp"
#include "report/formats/escapes.hpp"
#include "report/formats/formats.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"
#include "trace/run/shown_text.hpp"
#include "trace/viewer/html.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kLine = "{:<9}  {:>8}  {:>11}  {:>9}  {}\n";

// "3 of 4" rules are met; "-" where nothing was checked.
std::string rules_text(const ReportedTree& tree) {
  if (has_no_rules(tree)) return "no rules";
  const PropertyCounts counts = properties_of(tree);
  if (counts.all == 0) return "-";
  return fmt::format("{} of {}", counts.all - counts.missed - counts.undecided,
                     counts.all);
}

// --- Below an entry --------------------------------------------------------

// What a line below an entry may tell: verdicts come after the table, errors of
// inputs that could not be read are told before it, and notes on inputs are for
// who asks.
bool is_told_below(const Finding& finding) {
  if (finding.about == Finding::About::Rule) {
    return finding.code == rule::kVacuous;
  }
  return finding.code != rule::kInternal &&
         (finding.about != Finding::About::Input ||
          finding.severity != Severity::Note);
}

// Beside a baseline, of which is asked what is new and may fail, no notes. The
// worst first; of one level what is wrong with the tree before what is
// wrong with its text.
std::vector<Finding> told_below(const ReportedTree& tree) {
  if (tree.files.empty()) return {};
  std::vector<Finding> findings = all_findings(tree);
  std::erase_if(findings, [&](const Finding& each) {
    const bool is_beside =
        tree.judged.has_baseline && each.severity == Severity::Note;
    return is_beside || !is_told_below(each);
  });
  std::ranges::stable_sort(findings, {}, [](const Finding& each) {
    return std::pair(each.severity, each.about == Finding::About::Input);
  });
  return findings;
}

// "line 50", "dock.xml:7" in another file than the tree's, "" for a whole file.
std::string where(const ReportedTree& tree, const Place& place) {
  const std::string file = one_line(place.file);
  if (place.file != tree.file) {
    return place.span.line == 0 ? file
                                : fmt::format("{}:{}", file, place.span.line);
  }
  return place.span.line == 0 ? "" : fmt::format("line {}", place.span.line);
}

}  // namespace

// "  warning[BT2208] line 50: `RecoveryActions` fails although `BackUp` …".
std::string finding_line(const ReportedTree& tree, const Finding& finding,
                         std::size_t width) {
  constexpr std::size_t kIndent = 2;
  std::string head =
      fmt::format("{}[{}]", severity_name(finding.severity), finding.code);
  const std::string place = where(tree, finding.place);
  if (!place.empty()) head += " " + place;
  std::string first =
      one_line(finding.message.substr(0, finding.message.find('\n')));
  if (first.ends_with('.')) first.pop_back();
  return std::string(kIndent, ' ') +
         wrapped(head + ": " + first, 2 * kIndent, width) + '\n';
}

namespace {

// A word of a command line.
std::string shell_word(const std::string& word) {
  const bool is_plain = std::ranges::all_of(word, [](char c) {
    return is_letter(c) || is_digit(c) ||
           std::string_view("_-./=+,:@%").find(c) != std::string_view::npos;
  });
  if (is_plain && !word.empty()) return word;
  std::string text = "'";
  for (const char c : one_line(word)) {
    text += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return text + "'";
}

// The command that tells all of an entry.
std::string command_for(const ReportedTree& tree) {
  std::string command = "btcheck " + shell_word(tree.file);
  if (!tree.main_tree.empty()) {
    command += " --main-tree " + shell_word(tree.main_tree);
  }
  for (const ReportedFile& file : tree.files) {
    if (file.properties.empty()) continue;
    command += " --prop " + shell_word(file.properties);
  }
  return command;
}

std::string findings_below(const ReportedTree& tree, Layout layout) {
  const std::vector<Finding> findings = told_below(tree);
  std::string text;
  if (layout.detail == Detail::EveryStep) {
    for (const Finding& each : findings) {
      if (each.about == Finding::About::Input) continue;  // told before
      text += each.told.empty() ? finding_line(tree, each, layout.width)
                                : each.told;
    }
    return text.empty() ? text : text + '\n';
  }
  const std::size_t count = std::min(findings.size(), kMostBelow);
  for (std::size_t i = 0; i < count; ++i) {
    text += finding_line(tree, findings[i], layout.width);
  }
  if (count < findings.size()) {
    text += fmt::format("  {} more: {}\n", findings.size() - count,
                        command_for(tree));
  }
  return text;
}

// --- After the last entry --------------------------------------------------

}  // namespace

std::string shortfall_text(const Shortfall& found, std::size_t width) {
  constexpr std::size_t kIndent = 11;
  std::string what = one_line(found.name);
  if (!found.text.empty()) {
    what += what.empty() ? found.text : "  (" + found.text + ")";
  }
  if (static_cast<std::size_t>(count_code_points(what)) + kIndent > width) {
    what = wrapped(what, kIndent, width);
  }
  std::string text = fmt::format("{:<9}  {}\n", found.word, what);
  if (!found.title.empty()) text += fmt::format("           {}\n", found.title);
  return text + found.told;
}

namespace {

// Of an entry that was checked; stderr has what is wrong with the others.
std::string shortfalls_text(const ReportedTree& tree, Layout layout) {
  std::string text;
  for (const Shortfall& found : missed_rules(
           tree, layout.detail == Detail::EveryStep ? OpenRules::Each
                                                    : OpenRules::Together)) {
    text += shortfall_text(found, layout.width);
  }
  for (const Finding& each : tree.findings) {
    if (each.about == Finding::About::Mission && each.code == rule::kInternal) {
      text += fmt::format("FAILED     {}\n", each.message);
    }
  }
  if (text.empty()) return {};
  while (text.ends_with("\n\n")) text.pop_back();
  return fmt::format("{}\n{}\n", one_line(title_of(tree)), text);
}

// The class of a word, which gives it its colour.
std::string_view class_of(TreeOutcome outcome) {
  if (is_good(outcome)) return "good";
  if (outcome == TreeOutcome::Undecided) return "open";
  return outcome == TreeOutcome::NotRun ? "plain" : "bad";
}

std::string_view class_of(Verdict verdict, bool is_met) {
  if (verdict == Verdict::Undecided) return "open";
  return is_met ? "good" : "bad";
}

std::string word_html(std::string_view word, std::string_view colour) {
  return fmt::format("<span class=\"word {}\">{}</span>", colour,
                     xml_text(word));
}

std::string outcome_html(TreeOutcome outcome) {
  return word_html(word_of(outcome), class_of(outcome));
}

std::string heading_of(const Report& report) {
  const OutcomeCounts counts = outcomes_of(report);
  const std::size_t met =
      counts[static_cast<std::size_t>(TreeOutcome::Met)] +
      counts[static_cast<std::size_t>(TreeOutcome::NoFault)];
  const std::size_t all = report.trees.size();
  const std::string entries = counted(all, "entry", "entries");
  if (met == all) return fmt::format("{}, as expected", entries);
  return fmt::format("{} of {} not as expected", all - met, entries);
}

std::string sums_html(const Report& report) {
  const OutcomeCounts counts = outcomes_of(report);
  std::string text;
  for (std::size_t i = 0; i < kOutcomeCount; ++i) {
    const auto outcome = static_cast<TreeOutcome>(i);
    if (counts[i] == 0) continue;
    text += fmt::format("<li>{} {}</li>", outcome_html(outcome), counts[i]);
  }
  return text;
}

// What stands between backticks is code.
std::string prose_html(std::string_view text) {
  std::string html;
  while (true) {
    const std::size_t begin = text.find('`');
    const std::size_t end =
        begin == text.npos ? text.npos : text.find('`', begin + 1);
    if (end == text.npos) return html + xml_text(text);
    html += xml_text(text.substr(0, begin)) + "<code>" +
            xml_text(text.substr(begin + 1, end - begin - 1)) + "</code>";
    text.remove_prefix(end + 1);
  }
}

// A message as it is printed; lines of somebody's file, behind a bar, stay.
std::string message_html(std::string_view text) {
  std::string html;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, end);
    const std::size_t bar = line.find_first_not_of(" 0123456789");
    const bool is_source = bar != line.npos && line[bar] == '|';
    html += is_source ? xml_text(line) : prose_html(line);
    text.remove_prefix(end);
  }
  return html;
}

// What follows its first line.
std::string rest_of(const Finding& finding) {
  const std::size_t first = finding.message.find('\n');
  return first == std::string::npos ? ""
                                    : finding.message.substr(first + 1) + '\n';
}

// Its run, a line for each unit of time, and its repair.
std::string evidence_text(const Finding& finding) {
  std::string text;
  if (finding.run) {
    int time = -1;
    for (const ToldStep& step : finding.run->steps) {
      if (step.kind == ToldStep::Kind::Time) continue;
      text += step.time == time ? ", "
                                : fmt::format("\n    {} {:<3} ",
                                              finding.run->unit, step.time);
      text += step.text;
      time = step.time;
    }
    text += '\n';
  }
  if (!finding.repair) return text;
  text += "\nRepair, checked:\n";
  for (const std::string& line : diff_lines(*finding.repair, SIZE_MAX - 1)) {
    text += line + '\n';
  }
  return text;
}

// One row of the table of verdicts.
std::string row(const std::string& verdict, const std::string& name,
                const std::string& how, const std::string& run) {
  return fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                     verdict, name, how, run);
}

class PageWriter {
 public:
  PageWriter(const Report& report, const std::string& file)
      : report_(report),
        folder_((fs::path(report.directory) / file)
                    .lexically_normal()
                    .parent_path()) {
    for (std::size_t i = 0; i < report.trees.size(); ++i) {
      for (const Finding& found : report.trees[i].findings) {
        if (is_of_tree(found)) findings_.push_back({i, &found});
      }
    }
    std::ranges::stable_sort(findings_, {}, [](const Ranked& ranked) {
      return ranked.found->severity;
    });
  }

  std::string attention() const {
    std::string articles;
    for (std::size_t i = 0; i < report_.trees.size(); ++i) {
      articles += article(report_.trees[i], i);
    }
    if (articles.empty()) return {};
    return "<section aria-labelledby=\"attention-title\">\n<div "
           "class=\"title\"><h2 id=\"attention-title\">Not as expected</h2>"
           "</div>\n" +
           articles + "</section>";
  }

  // What there is to be said of trees, the worst first.
  std::string findings() const {
    if (findings_.empty()) return {};
    std::string text =
        "<section aria-labelledby=\"findings-title\">\n<div class=\"title\">"
        "<h2 id=\"findings-title\">Findings</h2></div>\n";
    for (std::size_t i = 0; i < findings_.size(); ++i) {
      text += finding_html(i);
    }
    return text + "</section>";
  }

  std::string entries() const {
    std::string text;
    for (std::size_t i = 0; i < report_.trees.size(); ++i) {
      text += entry(report_.trees[i], i);
    }
    return text;
  }

 private:
  // The path of a file, seen from the page.
  std::string link(const std::string& file) const {
    const fs::path path =
        (fs::path(report_.directory) / file).lexically_normal();
    const fs::path from_page = path.lexically_relative(folder_);
    return uri_of(from_page.empty() ? path.string()
                                    : from_page.generic_string());
  }

  std::string link_html(const std::string& file, std::string_view text) const {
    if (file.empty()) return {};
    return fmt::format("<a href=\"{}\">{}</a>", link(file), xml_text(text));
  }

  std::string article(const ReportedTree& tree, std::size_t number) const {
    const auto found = shortfalls_of(tree);
    if (found.empty()) return {};
    std::string text = fmt::format(
        "<article><h3>{} <a href=\"#entry-{}\">{}</a></h3>\n<ul>",
        outcome_html(outcome_of(tree)), number + 1, xml_text(title_of(tree)));
    for (const Shortfall& one : found) text += shortfall(one);
    return text + "</ul></article>\n";
  }

  std::string shortfall(const Shortfall& found) const {
    const bool is_open = found.word == "UNDECIDED";
    std::string text = fmt::format(
        "<li>{} <b>{}</b> <span class=\"note\">{}</span> {}",
        word_html(found.word, is_open ? "open" : "bad"), xml_text(found.name),
        prose_html(found.text), link_html(found.page, "see the run"));
    if (!found.title.empty()) {
      text += fmt::format("<br>{}", prose_html(found.title));
    }
    if (!found.told.empty()) {
      text += fmt::format(
          "<details><summary>the run as text</summary>"
          "<pre>{}</pre></details>",
          xml_text(found.told));
    }
    return text + "</li>";
  }

  std::string entry(const ReportedTree& tree, std::size_t number) const {
    const TreeOutcome outcome = outcome_of(tree);
    const PropertyCounts counts = properties_of(tree);
    std::string text = fmt::format(
        "<details class=\"entry\" id=\"entry-{}\" data-met=\"{:d}\">"
        "<summary class=\"row\">{}<span class=\"name\">{}</span>",
        number + 1, is_good(outcome), outcome_html(outcome),
        xml_text(title_of(tree)));
    const auto cell = [&](std::string_view name, const std::string& value) {
      text += fmt::format("<span data-name=\"{}\">{}</span>", name, value);
    };
    cell("hold", std::to_string(counts.holds));
    cell("violated", std::to_string(counts.violated));
    cell("undecided", std::to_string(counts.undecided));
    cell("nodes", std::to_string(tree.nodes));
    cell("states", grouped(states_of(tree)));
    cell("time", fmt::format("{:.2f} s", tree.seconds));
    return text + "</summary>\n<div class=\"inside\">" + inside(tree) +
           "</div></details>\n";
  }

  std::string inside(const ReportedTree& tree) const {
    std::string text =
        fmt::format("<p>{}: {}, {}</p>", link_html(tree.file, tree.file),
                    counted(tree.nodes, "node", "nodes"),
                    counted(tree.variables, "variable", "variables"));
    if (!tree.not_run.empty()) {
      text += fmt::format("<p>Not run: {}.</p>", prose_html(tree.not_run));
    }
    for (const ReportedFile& file : tree.files) text += file_html(file);
    for (std::size_t i = 0; i < findings_.size(); ++i) {
      if (&report_.trees[findings_[i].tree] != &tree) continue;
      text += fmt::format("<p>{} <a href=\"#finding-{}\">{}</a></p>\n",
                          level_html(*findings_[i].found), i + 1,
                          sentence_html(*findings_[i].found));
    }
    for (const Diagnostic& found : tree.diagnostics) {
      text += fmt::format("<pre>{}</pre>", message_html(render(found)));
    }
    return text;
  }

  std::string file_html(const ReportedFile& file) const {
    std::string text = fmt::format(
        "<p>{}, tick {}{}</p>\n<table><thead><tr><th>verdict</th><th>{}</th>"
        "<th>how</th><th>run</th></tr></thead><tbody>",
        file.properties.empty() ? "Default report"
                                : link_html(file.properties, file.properties),
        xml_text(file.ticks), assumptions(file),
        file.properties.empty() ? "question" : "property");
    for (const ReportedProperty& property : file.verdicts) {
      text += property_row(property);
    }
    for (const ReportedAnswer& answer : file.answers) {
      text += row(word_html(word_of(answer),
                            class_of(answer.verdict, !answer.is_fault)),
                  prose_html(answer.question), prose_html(answer.answer),
                  link_html(answer.page, "run"));
    }
    return text + "</tbody></table>\n";
  }

  static std::string level_html(const Finding& found) {
    const bool is_error = found.severity == Severity::Error;
    return word_html(
        fmt::format("{} {}", severity_name(found.severity), found.code),
        is_error                              ? "bad"
        : found.severity == Severity::Warning ? "open"
                                              : "plain");
  }

  static std::string sentence_html(const Finding& found) {
    return prose_html(found.message.substr(0, found.message.find('\n')));
  }

  // A click from its run and its repair, and it says that it has them.
  std::string finding_html(std::size_t number) const {
    const Finding& found = *findings_[number].found;
    const std::string_view has = found.run && found.repair ? "run, repair"
                                 : found.run               ? "run"
                                 : found.repair            ? "repair"
                                                           : "";
    return fmt::format(
        "<details class=\"finding\" id=\"finding-{}\"><summary>{} {}: {} <span "
        "class=\"note\">{}</span></summary><pre>{}{}</pre>{}</details>\n",
        number + 1, level_html(found),
        link_html(found.place.file, place_text(found.place)),
        sentence_html(found), has, message_html(rest_of(found)),
        xml_text(evidence_text(found)), link_html(found.page, "see the run"));
  }

  static std::string assumptions(const ReportedFile& file) {
    if (file.assumptions.empty()) return {};
    return xml_text(
        fmt::format(", assuming {}", fmt::join(file.assumptions, ", ")));
  }

  std::string property_row(const ReportedProperty& property) const {
    std::string name = fmt::format("<b>{}</b>", xml_text(property.name));
    const std::string& title =
        property.title.empty() ? property.text : property.title;
    name += "<br>" + prose_html(title);
    if (!property.error.empty()) {
      return row(word_html("FAILED", "bad"), name, prose_html(property.error),
                 "");
    }
    return row(word_html(verdict_word(property.verdict),
                         class_of(property.verdict, property.is_met)),
               name, prose_html(property.note),
               link_html(property.page, "run"));
  }

  struct Ranked {
    std::size_t tree = 0;  // its number
    const Finding* found = nullptr;
  };

  const Report& report_;
  fs::path folder_;  // of the page, absolute
  std::vector<Ranked> findings_;
};

}  // namespace

std::string batch_heading() {
  return fmt::format(kLine, "result", "rules", "states", "time", "entry");
}

std::string batch_lines(const ReportedTree& tree, Layout layout) {
  const bool is_checked = !tree.files.empty();
  return fmt::format(kLine, word_of(outcome_of(tree)), rules_text(tree),
                     is_checked ? grouped(states_of(tree)) : "-",
                     is_checked ? fmt::format("{:.2f} s", tree.seconds) : "-",
                     one_line(title_of(tree))) +
         findings_below(tree, layout);
}

std::string batch_ending(const Report& report, Layout layout) {
  std::string text = "\n";
  for (const ReportedTree& tree : report.trees) {
    text += shortfalls_text(tree, layout);
  }
  return text + sum_of(report) + "\n";
}

std::string batch_text(const Report& report, Layout layout) {
  std::string text = batch_heading();
  for (const ReportedTree& tree : report.trees) {
    text += batch_lines(tree, layout);
  }
  return text + batch_ending(report, layout);
}

std::size_t notes_left_out(const ReportedTree& tree, Layout layout) {
  if (layout.detail == Detail::EveryStep) return 0;
  return static_cast<std::size_t>(std::ranges::count(
      tree.diagnostics, Severity::Note, &Diagnostic::severity));
}

std::string html_report(const Report& report, const std::string& file) {
  const PageWriter writer(report, file);
  const std::string heading = xml_text(heading_of(report));
  const std::string about =
      fmt::format("btcheck {}, {}, {:.1f} s of checking", kVersion,
                  report.started, report.seconds());
  return filled(kBatchPage, {{"{{title}}", "btcheck: " + heading},
                             {"{{style}}", std::string(kBatchStyle)},
                             {"{{heading}}", heading},
                             {"{{about}}", xml_text(about)},
                             {"{{sums}}", sums_html(report)},
                             {"{{attention}}", writer.attention()},
                             {"{{findings}}", writer.findings()},
                             {"{{entries}}", writer.entries()},
                             {"{{script}}", std::string(kBatchScript)}});
}

}  // namespace btcheck
