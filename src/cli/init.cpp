// SPDX-License-Identifier: MIT
//
// `btcheck init TREE`: a file of rules to begin with. What is proposed is
// checked: what holds stands as a rule, what does not as a question, with the
// run that raises it.
#include "check/init/proposals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "cli/commands.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"
#include "trace/formats/text.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

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

// Where rules that are kept in `output` find the tree.
std::string tree_seen_from(const std::string& output, const std::string& tree) {
  if (output.empty()) return tree;
  std::error_code fault;
  const fs::path folder = fs::absolute(output, fault).parent_path();
  const fs::path path = fs::absolute(tree, fault).lexically_relative(folder);
  return path.empty() ? tree : path.generic_string();
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
    text += marked(
        "#", brief_text(recorded(*result.tree, *file.network, *verdict.run, {}),
                        verdict.subjects.nodes, kLineWidth));
  }
  return text + marked("#", rule);
}

}  // namespace

ExitCode run_init(const Options& asked) {
  std::vector<Diagnostic> found;
  const auto inputs = read_inputs(asked, found);
  if (!inputs) return ExitCode::BadInput;
  const Options& options = inputs->options;
  auto read =
      read_tree(inputs->tree.name, inputs->tree.text, inputs->tree.reading);
  show(options, read.diagnostics);
  if (!read.value) return ExitCode::BadInput;
  std::vector<Proposal> proposals = proposals_for(*read.value);
  Watch watch(options);
  const CheckResult result =
      checked(inputs->tree, proposals, check_options(options, watch.limits));
  watch.monitor.clear();
  if (result.files.empty() && !proposals.empty()) {
    show(options, result.diagnostics);
    return ExitCode::BadInput;
  }
  std::string text =
      "# Rules to begin with, by `btcheck init`. What stands as a rule holds; "
      "what is\n# commented out does not, and is a question: should it?\n";
  if (!is_given(inputs->tree.name)) {
    text += fmt::format("tree \"{}\"\n",
                        tree_seen_from(options.output, inputs->tree.name));
  }
  ExitCode code = ExitCode::Met;
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    const CheckedFile& file = result.files[0];
    const PropertyVerdict& verdict = file.verdicts[i];
    text += proposed_text(result, file, verdict, proposals[i]);
    if (!verdict.error.empty()) code = ExitCode::Internal;
    if (verdict.verdict == Verdict::Undecided) {
      code = worst_of(code, ExitCode::Undecided);
    }
  }
  return worst_of(code, write_output(options.output, harmless(text)));
}

}  // namespace btcheck
