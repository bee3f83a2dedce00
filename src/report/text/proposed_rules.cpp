// SPDX-License-Identifier: MIT
//
// What is proposed is checked: what holds stands as a rule, what does not as a
// question, with the run that raises it.
#include "report/text/proposed_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "check/init/proposals.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"
#include "trace/formats/text.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kRulesName = "rules.ltl";

// Each on a line of its own.
std::string text_of(const std::vector<Proposal>& proposals) {
  std::string text;
  for (const Proposal& each : proposals) {
    text += fmt::format("property {}: {}\n", each.name, each.body);
  }
  return text;
}

// A tree may have names that no rule can say: those rules are left out.
void leave_out_broken(const std::vector<Diagnostic>& diagnostics,
                      std::vector<Proposal>& proposals) {
  std::vector<Proposal> kept;
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    const bool is_broken =
        std::ranges::any_of(diagnostics, [&](const Diagnostic& found) {
          return found.severity == Severity::Error &&
                 found.file == kRulesName &&
                 found.span.line == static_cast<int>(i) + 1;
        });
    if (!is_broken) kept.push_back(std::move(proposals[i]));
  }
  proposals = std::move(kept);
}

CheckResult checked(const TreeInput& tree, std::vector<Proposal>& proposals,
                    const CheckOptions& options) {
  while (!proposals.empty()) {
    CheckResult result =
        check(tree, {{std::string(kRulesName), text_of(proposals)}}, options);
    const std::size_t before = proposals.size();
    if (!result.files.empty()) return result;
    leave_out_broken(result.diagnostics, proposals);
    if (proposals.size() == before) return result;
  }
  return {};
}

// Each line behind the mark.
std::string marked(std::string_view mark, const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    result += mark;
    if (end > at) result += ' ' + text.substr(at, end - at);
    result += '\n';
    at = end + 1;
  }
  return result;
}

std::string rule_text(const Proposal& proposal) {
  return fmt::format("property {}:\n    {}\n", proposal.name,
                     wrapped(proposal.body, 4));
}

// "" for what holds for another reason than it seems.
std::string proposed_text(const CheckResult& result, const CheckedFile& file,
                          const PropertyVerdict& verdict,
                          const Proposal& proposal) {
  const std::string rule = rule_text(proposal);
  if (verdict.verdict == Verdict::Holds) {
    if (verdict.is_vacuous()) return {};
    return '\n' + marked("##", wrapped(proposal.title, 0, 76)) + rule;
  }
  std::string text = "\n";
  if (verdict.verdict == Verdict::Undecided) {
    text += marked("#", wrapped("Not known: " + proposal.title + " " +
                                    note_of(file, verdict),
                                0, 78));
    return text + marked("#", rule);
  }
  text += marked("#", wrapped("Not so, is it meant? " + proposal.title, 0, 78));
  if (verdict.run) {
    text += marked("#", brief_text(recorded_steps(*result.tree, *file.network,
                                                  *verdict.run),
                                   verdict.subjects.nodes, kLineWidth));
  }
  return text + marked("#", rule);
}

}  // namespace

ProposedRules proposed_rules(const TreeInput& tree, const std::string& named,
                             const CheckOptions& options) {
  ProposedRules proposed;
  auto read = read_tree(tree.name, tree.text, tree.reading);
  proposed.diagnostics = std::move(read.diagnostics);
  if (!read.value) return proposed;
  std::vector<Proposal> proposals = proposals_for(*read.value);
  const CheckResult result = checked(tree, proposals, options);
  if (result.files.empty() && !proposals.empty()) {
    proposed.diagnostics = result.diagnostics;
    return proposed;
  }
  std::string& text = proposed.text;
  text =
      "# Rules to begin with, by `btcheck init`. What stands as a rule holds; "
      "what is\n# commented out does not, and is a question: should it?\n";
  if (!named.empty()) text += fmt::format("tree \"{}\"\n", named);
  proposed.code = ExitCode::Met;
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    const CheckedFile& file = result.files[0];
    const PropertyVerdict& verdict = file.verdicts[i];
    text += proposed_text(result, file, verdict, proposals[i]);
    if (!verdict.error.empty()) proposed.code = ExitCode::Internal;
    if (verdict.verdict == Verdict::Undecided) {
      proposed.code = worst_of(proposed.code, ExitCode::Undecided);
    }
  }
  text = harmless(text);
  return proposed;
}

}  // namespace btcheck
