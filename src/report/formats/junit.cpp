// SPDX-License-Identifier: MIT
//
// JUnit XML has no standard; the elements and their order are those of
// testmoapp/junitxml, which the usual readers agree on.
#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

#include "report/codes/codes.hpp"
#include "report/formats/escapes.hpp"
#include "report/formats/formats.hpp"
#include "report/text/report.hpp"

namespace btcheck {
namespace {

enum class Outcome : std::uint8_t { Passed, Failed, Error, Skipped };

using Properties = std::vector<std::pair<std::string, std::string>>;

struct Case {
  std::string name;
  Place place;
  Properties properties;
  Outcome outcome = Outcome::Passed;
  std::string type;     // of what went wrong
  std::string message;  // the same in a line
  std::string text;     // and in full
  std::string output;
};

// How many cases ended how, by Outcome.
using Counts = std::array<std::size_t, 4>;

std::string attribute(std::string_view name, std::string_view value) {
  return fmt::format(" {}=\"{}\"", name, xml_attribute(value));
}

std::string attributes(const Counts& counts, double seconds) {
  const auto [passed, failed, errors, skipped] = counts;
  return fmt::format(
      " tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" "
      "time=\"{:.3f}\"",
      passed + failed + errors + skipped, failed, errors, skipped, seconds);
}

// "BT2001 PropertyViolated".
std::string type_of(std::string_view code) {
  return fmt::format("{} {}", code, code_named(code)->name);
}

// Of `[safety, req=SR-12]`: tag="safety" and req="SR-12".
Properties tag_properties(const std::vector<std::string>& tags) {
  Properties properties;
  for (const std::string& tag : tags) {
    const std::size_t sign = tag.find('=');
    if (sign == tag.npos) {
      properties.emplace_back("tag", tag);
    } else {
      properties.emplace_back(tag.substr(0, sign), tag.substr(sign + 1));
    }
  }
  return properties;
}

Case case_of(const ReportedProperty& property) {
  Case made;
  made.name = property.name;
  made.place = property.place;
  made.properties = tag_properties(property.tags);
  made.text = property.told.empty() ? property.text + "\n" : property.told;
  made.message = verdict_word(property.verdict);
  if (!property.note.empty()) {
    made.message += fmt::format(" ({})", property.note);
  }
  if (!property.error.empty()) {
    made.outcome = Outcome::Error;
    made.type = type_of(rule::kInternal);
    made.message = made.text = "internal error: " + property.error;
  } else if (property.verdict == Verdict::Undecided) {
    made.outcome = Outcome::Skipped;
  } else if (!property.is_met) {
    const bool holds = property.verdict == Verdict::Holds;
    made.outcome = Outcome::Failed;
    made.type = type_of(holds ? rule::kHolds : rule::kViolated);
  } else {
    made.output =
        fmt::format("{}  {}\n", made.message,
                    property.title.empty() ? property.text : property.title);
  }
  return made;
}

// A run as plain lines.
std::string lines_of(const ToldRun& run) {
  std::string text;
  for (const ToldStep& step : run.steps) {
    const bool is_event = step.kind == ToldStep::Kind::Event;
    text += fmt::format("{}{}{}\n", is_event ? "    " : "-- ", step.text,
                        step.is_chosen ? "  (chosen)" : "");
  }
  return text;
}

Case case_of(const ReportedAnswer& answer, const ReportedTree& tree) {
  Case made;
  made.name = answer.question;
  made.place = tree.root;
  if (answer.verdict == Verdict::Undecided) {
    made.outcome = Outcome::Skipped;
    made.message = answer.answer;
  } else if (answer.is_fault) {
    made.outcome = Outcome::Failed;
    made.type = type_of(answer.code);
    made.message = code_named(answer.code)->summary;
    if (answer.run) made.text = lines_of(*answer.run);
  } else {
    made.output = answer.answer + "\n";
  }
  return made;
}

// Of a finding that no property and no answer stands for.
Case case_of(const Finding& finding, const ReportedTree& tree) {
  const std::string first =
      finding.message.substr(0, finding.message.find('\n'));
  Case made;
  made.name = fmt::format("{} {}", finding.code, first);
  made.place = finding.place;
  const std::string level(severity_name(finding.severity));
  const std::string text =
      finding.told.empty()
          ? fmt::format("{}[{}] {}: {}\n", level, finding.code,
                        place_text(finding.place), finding.message)
          : finding.told.substr(1);
  const CodeRow* row = code_named(finding.code);
  if (finding.severity == Severity::Error) {
    // What has no level was not denied: it went wrong.
    const bool is_judged =
        tree.code == ExitCode::Missed || (row != nullptr && has_level(*row));
    made.outcome = is_judged ? Outcome::Failed : Outcome::Error;
    made.type = finding.code;
    made.message = level + ": " + first;
    made.text = text;
  } else {
    made.output = text;
  }
  return made;
}

// What is wrong with the inputs of a tree, or why it was not checked.
Case unchecked(const ReportedTree& tree) {
  Case made;
  made.name = "inputs";
  made.place = tree.root;
  if (!tree.not_run.empty()) {
    made.outcome = Outcome::Skipped;
    made.message = "not run: " + tree.not_run;
    return made;
  }
  made.outcome =
      tree.code == ExitCode::Undecided ? Outcome::Skipped : Outcome::Error;
  for (const Diagnostic& diagnostic : tree.diagnostics) {
    if (diagnostic.severity != Severity::Error) continue;
    if (made.message.empty()) {
      made.type = diagnostic.code;
      made.message = diagnostic.message;
      made.place = {diagnostic.file, diagnostic.span};
      if (made.place.file.empty()) made.place = tree.root;
    }
    made.text += render(diagnostic) + "\n";
  }
  return made;
}

void add_findings(std::vector<Case>& cases, const ReportedTree& tree) {
  for (const Finding& finding : all_findings(tree)) {
    const bool has_case = finding.about == Finding::About::Rule ||
                          finding.about == Finding::About::Mission;
    if (!has_case) cases.push_back(case_of(finding, tree));
  }
}

std::vector<Case> cases_of(const ReportedTree& tree) {
  if (!tree.not_run.empty() || tree.files.empty()) return {unchecked(tree)};
  std::vector<Case> cases;
  for (const ReportedFile& file : tree.files) {
    for (const ReportedProperty& property : file.verdicts) {
      cases.push_back(case_of(property));
    }
    for (const ReportedAnswer& answer : file.answers) {
      cases.push_back(case_of(answer, tree));
    }
    if (file.error.empty()) continue;
    Case& made = cases.emplace_back();
    made.name = "replay";
    made.place = tree.root;
    made.outcome = Outcome::Error;
    made.type = type_of(rule::kInternal);
    made.message = made.text = file.error;
  }
  add_findings(cases, tree);
  return cases;
}

std::string properties_xml(const Properties& properties,
                           std::string_view indent) {
  if (properties.empty()) return {};
  std::string text = fmt::format("{}<properties>\n", indent);
  for (const auto& [name, value] : properties) {
    text += fmt::format("{}  <property{}{}/>\n", indent,
                        attribute("name", name), attribute("value", value));
  }
  return text + fmt::format("{}</properties>\n", indent);
}

std::string outcome_xml(const Case& made) {
  if (made.outcome == Outcome::Passed) return {};
  if (made.outcome == Outcome::Skipped) {
    return fmt::format("      <skipped{}/>\n",
                       attribute("message", made.message));
  }
  const char* element = made.outcome == Outcome::Failed ? "failure" : "error";
  return fmt::format("      <{0}{1}{2}>{3}</{0}>\n", element,
                     attribute("message", made.message),
                     attribute("type", made.type), xml_text(made.text));
}

std::string element_xml(std::string_view element, const std::string& text,
                        std::string_view indent) {
  if (text.empty()) return {};
  return fmt::format("{0}<{1}>{2}</{1}>\n", indent, element, xml_text(text));
}

std::string case_xml(const Case& made, const std::string& class_name,
                     double seconds) {
  std::string text = fmt::format("    <testcase{}{} time=\"{:.3f}\"{}",
                                 attribute("name", made.name),
                                 attribute("classname", class_name), seconds,
                                 attribute("file", made.place.file));
  if (made.place.span.line > 0) {
    text += fmt::format(" line=\"{}\"", made.place.span.line);
  }
  return text + ">\n" + properties_xml(made.properties, "      ") +
         outcome_xml(made) + element_xml("system-out", made.output, "      ") +
         "    </testcase>\n";
}

Properties suite_properties(const ReportedTree& tree) {
  Properties properties;
  if (tree.nodes > 0) {
    properties = {{"nodes", std::to_string(tree.nodes)},
                  {"variables", std::to_string(tree.variables)}};
  }
  if (tree.files.empty()) return properties;
  properties.emplace_back("profile", tree.files[0].profile);
  properties.emplace_back("tick", tree.files[0].ticks);
  for (const std::string& assumption : tree.files[0].assumptions) {
    properties.emplace_back("assumption", assumption);
  }
  properties.emplace_back("states", std::to_string(states_of(tree)));
  properties.emplace_back("peak_bytes", std::to_string(tree.peak_bytes));
  return properties;
}

std::string suite_xml(const ReportedTree& tree, const std::vector<Case>& cases,
                      const Counts& counts, const std::string& started) {
  std::string text = fmt::format(
      "  <testsuite{}{}{}{}>\n", attribute("name", title_of(tree)),
      attributes(counts, tree.seconds), attribute("timestamp", started),
      attribute("file", tree.file));
  text += properties_xml(suite_properties(tree), "    ");
  const double share = tree.seconds / static_cast<double>(cases.size());
  for (const Case& made : cases) {
    // The name of a test class has no ending.
    text += case_xml(made, without_ending(title_of(tree)), share);
  }
  return text + "  </testsuite>\n";
}

}  // namespace

std::string junit_text(const Report& report) {
  Counts total{};
  std::string suites;
  for (const ReportedTree& tree : report.trees) {
    const std::vector<Case> cases = cases_of(tree);
    Counts counts{};
    for (const Case& made : cases) {
      ++counts[static_cast<std::size_t>(made.outcome)];
      ++total[static_cast<std::size_t>(made.outcome)];
    }
    suites += suite_xml(tree, cases, counts, report.started);
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites name=\"btcheck\"{}>\n{}</testsuites>\n",
      attributes(total, report.seconds()), suites);
}

}  // namespace btcheck
