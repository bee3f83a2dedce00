// SPDX-License-Identifier: MIT
#include "check/repairs/problems.hpp"

#include <algorithm>

namespace btcheck {
namespace {

bool has_new_fault(const CheckedFile& before, const CheckedFile& after) {
  if (after.has_faults && !before.has_faults) return true;
  if (!after.defaults) return false;
  const auto was_bad = [&](TreeQuestion question) {
    return std::ranges::any_of(before.defaults->tree, [&](const auto& answer) {
      return answer.question == question && is_bad(answer);
    });
  };
  return std::ranges::any_of(after.defaults->tree, [&](const auto& answer) {
    return is_bad(answer) && !was_bad(answer.question);
  });
}

bool breaks_rule(const CheckedFile& before, const CheckedFile& after) {
  if (before.verdicts.size() != after.verdicts.size()) return true;
  for (std::size_t i = 0; i < before.verdicts.size(); ++i) {
    const PropertyVerdict& was = before.verdicts[i];
    const PropertyVerdict& is = after.verdicts[i];
    if (was.verdict != Verdict::Holds) continue;
    const bool holds = is.verdict == Verdict::Holds && is.error.empty();
    if (!holds || (is.is_vacuous() && !was.is_vacuous())) return true;
  }
  return false;
}

bool is_complete(const CheckedFile& file) {
  if (!file.defaults) return file.findings_are_whole;
  return file.defaults->stopped == StopReason::None &&
         file.defaults->error.empty();
}

}  // namespace

Problem problem_of(const Diagnostic& diagnostic) {
  return {diagnostic.code,
          {diagnostic.file, diagnostic.span.line, diagnostic.span.column},
          diagnostic.severity == Severity::Note};
}

Problem problem_of(const TreeFinding& finding, const BehaviorTree& tree) {
  const SourceSpan& span = tree.node(finding.node).span;
  return {std::string(finding.code),
          {tree.file_of(finding.node), span.line, span.column},
          finding.severity == Severity::Note};
}

std::vector<Problem> problems_of(const CheckResult& result) {
  std::vector<Problem> problems;
  for (const Diagnostic& each : result.diagnostics) {
    problems.push_back(problem_of(each));
  }
  for (const CheckedFile& file : result.files) {
    for (const TreeFinding& each : file.findings) {
      problems.push_back(problem_of(each, *result.tree));
      for (const NodeId node : each.folded) {
        TreeFinding other{
            .code = each.code, .severity = each.severity, .node = node};
        problems.push_back(problem_of(other, *result.tree));
      }
    }
  }
  return problems;
}

std::optional<Problem> moved(const Problem& problem, const EditedFiles& files) {
  if (problem.place.line == 0) return problem;
  const auto place = files.moved(problem.place);
  if (!place) return std::nullopt;
  return Problem{problem.code, *place, problem.is_note};
}

bool is_complete(const CheckResult& result) {
  if (result.files.empty() || has_error(result.diagnostics)) return false;
  // Beside rules, the first of several files has the findings.
  return is_complete(result.files.front());
}

bool breaks_something(const CheckResult& before, const CheckResult& after) {
  if (before.files.size() != after.files.size()) return true;
  for (std::size_t f = 0; f < before.files.size(); ++f) {
    if (has_new_fault(before.files[f], after.files[f]) ||
        breaks_rule(before.files[f], after.files[f])) {
      return true;
    }
  }
  return false;
}

std::uint64_t most_states(const CheckResult& result) {
  std::uint64_t most = 0;
  for (const CheckedFile& file : result.files) {
    if (file.defaults) most = std::max(most, file.defaults->progress.states);
    for (const PropertyVerdict& each : file.verdicts) {
      most = std::max(most, each.progress.states);
    }
  }
  return most;
}

}  // namespace btcheck
