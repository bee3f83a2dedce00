// SPDX-License-Identifier: MIT
//
// The door for programs: a request becomes what the command line makes of its
// words, and the report of the check is copied out.
#include "btcheck/check.hpp"

#include <algorithm>
#include <utility>

#include "api/call.hpp"
#include "api/told.hpp"
#include "check/repairs/repairs.hpp"
#include "explore/components/component_store.hpp"
#include "explore/state/spent.hpp"
#include "report/codes/codes.hpp"
#include "report/formats/formats.hpp"
#include "report/formats/reported.hpp"
#include "report/text/report.hpp"
#include "text/version.hpp"
#include "trace/run/record.hpp"
#include "trace/viewer/html.hpp"

namespace btcheck::v1 {

struct Report::Whole {
  btcheck::Report report;
  CheckResult result;
  TreeInput input;
};

namespace {

void add_file(const ReportedFile& file, Report& report) {
  report.profile = file.profile;
  for (const ReportedProperty& rule : file.verdicts) {
    report.rules.push_back(rule_of(rule));
  }
  for (const ReportedAnswer& answer : file.answers) {
    report.answers.push_back(answer_of(answer));
  }
  for (const ReportedNode& node : file.nodes) {
    report.nodes.push_back(node_of(node));
  }
}

// What there is to report; `told` is filled with it.
Report told_of(const CheckResult& result, const Request& request, ExitCode code,
               StopReason stopped, const Call& call, ReportedTree& told) {
  told = reported(result, request.tree, code);
  told.seconds = call.seconds();
  Report report;
  report.outcome = static_cast<Outcome>(code);
  report.tree = request.tree;
  report.node_count = told.nodes;
  report.variable_count = told.variables;
  report.states = states_of(told);
  for (const btcheck::Finding& finding : all_findings(told)) {
    report.findings.push_back(finding_of(finding));
  }
  report.allowed = result.judged.allowed;
  for (const CheckedFile& file : result.files) {
    const StopReason reason = stopped_by(file);
    if (reason != StopReason::None) stopped = reason;
  }
  report.stopped = stop_word(stopped);
  for (const ReportedFile& file : told.files) add_file(file, report);
  report.seconds = told.seconds;
  return report;
}

Report report_of(CheckResult made, TreeInput input, const Request& request,
                 ExitCode code, StopReason stopped, const Call& call) {
  const BudgetScope telling(nullptr);
  auto whole = std::make_shared<Report::Whole>();
  whole->result = std::move(made);
  whole->input = std::move(input);
  whole->report.directory = whole->report.root = request.directory;
  whole->report.trees.emplace_back();
  Report report = told_of(whole->result, request, code, stopped, call,
                          whole->report.trees[0]);
  report.whole = std::move(whole);
  return report;
}

// What both calls have in common; `run` checks the inputs.
template <class Run>
Report called(const Request& request, CallSources& sources, Monitor* monitor,
              KnownReports* known, Run run) {
  Call call(request, monitor);
  const BudgetScope budget(&call);
  CheckResult result;
  ExitCode code = ExitCode::BadInput;
  StopReason stopped = StopReason::None;
  std::optional<Inputs> inputs;
  try {
    std::vector<Diagnostic> found;
    inputs = inputs_of(request, sources, found);
    // What is found while reading is not among the inputs.
    if (!found.empty()) known = nullptr;
    if (inputs && known != nullptr) {
      if (auto report = known->find(request, *inputs)) return *report;
    }
    if (inputs) code = run(*inputs, call, result);
    result.diagnostics.insert(result.diagnostics.begin(), found.begin(),
                              found.end());
  } catch (const BudgetSpent& spent) {
    result = {};
    result.diagnostics = {spent_diagnostic(spent, request.tree)};
    code = ExitCode::Undecided;
    stopped = stop_reason(spent.spent());
  }
  // Else a repair may not have been tried.
  const bool is_whole = call.has_spare();
  Report report =
      report_of(std::move(result), inputs ? inputs->tree : TreeInput(), request,
                code, stopped, call);
  if (inputs && known != nullptr && is_whole && report.stopped.empty()) {
    known->keep(request, *inputs, report);
  }
  return report;
}

// --- Pages ------------------------------------------------------------------

// The run of an answer or a finding, and a verdict on it.
struct NamedRun {
  const std::optional<KeptRun>* run = nullptr;
  btcheck::Verdict verdict = btcheck::Verdict::Violated;
};

NamedRun kept_run(const BehaviorTree& tree, const CheckedFile& file,
                  std::string_view name) {
  if (file.defaults) {
    for (const TreeReport& answer : file.defaults->tree) {
      const bool is_named = words_of(answer.question).key == name;
      if (is_named) return {&answer.run, answer.verdict};
      if (trace_name(answer) == name) return {&answer.run};
    }
  }
  const auto names = trace_names(tree, file.findings);
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return {};
  return {&file.findings[static_cast<std::size_t>(found - names.begin())].run};
}

std::string page_of(const Report::Whole& whole, const CheckedFile& file,
                    std::string_view name) {
  const BehaviorTree& tree = *whole.result.tree;
  const auto page = [&](const btcheck::Run& run, RunHeading heading) {
    add_sources(heading, tree, whole.input);
    return html_text(recorded(tree, *file.network, run, heading));
  };
  for (const PropertyVerdict& verdict : file.verdicts) {
    if (verdict.run && verdict.property->name == name) {
      return page(*verdict.run, heading_of(whole.result, file, verdict));
    }
  }
  const NamedRun kept = kept_run(tree, file, name);
  if (kept.run == nullptr || !*kept.run) return {};
  RunHeading heading;
  heading.property = heading.formula = name;
  heading.verdict = verdict_word(kept.verdict);
  return page((*kept.run)->told(), std::move(heading));
}

}  // namespace

std::string Report::html(std::string_view name) const {
  if (!whole || name.empty()) return {};
  for (const CheckedFile& file : whole->result.files) {
    std::string page = page_of(*whole, file, name);
    if (!page.empty()) return page;
  }
  return {};
}

std::string Report::json() const {
  return whole ? json_text(whole->report) : std::string();
}

std::string Report::sarif() const {
  return whole ? sarif_text(whole->report) : std::string();
}

Report checked(const Request& request, CallSources& sources, Monitor* monitor,
               KnownReports* known, const FoundFirst& first) {
  return called(request, sources, monitor, known,
                [&](const Inputs& inputs, Call& call, CheckResult& result) {
                  CheckOptions options = options_of(request, inputs, call);
                  std::optional<Report> last;
                  if (known != nullptr) {
                    options.choices.components = ComponentStore::of_program();
                    last = known->last(request);
                  }
                  if (last && last->whole) {
                    options.earlier = &last->whole->result;
                  }
                  result = btcheck::check(inputs.tree, inputs.rules, options);
                  if (first) {
                    ReportedTree told;
                    first(told_of(result, request, exit_code_of(result),
                                  StopReason::None, call, told));
                  }
                  add_repairs(inputs.tree, inputs.rules, options, result);
                  return exit_code_of(result);
                });
}

Report linted(const Request& request, CallSources& sources, Monitor* monitor,
              KnownReports* known) {
  return called(request, sources, monitor, known,
                [&](const Inputs& inputs, Call&, CheckResult& result) {
                  result =
                      lint_inputs(inputs.tree, inputs.rules, inputs.judgement);
                  return lint_code_of(result);
                });
}

Report check(const Request& request, Sources& sources, Monitor* monitor) {
  AskedSources asked(sources, request.is_one_program);
  return checked(request, asked, monitor);
}

Report lint(const Request& request, Sources& sources, Monitor* monitor) {
  AskedSources asked(sources, request.is_one_program);
  return linted(request, asked, monitor);
}

std::optional<Explanation> explain(std::string_view code) {
  const CodeRow* row = code_named(code);
  if (row == nullptr) return std::nullopt;
  return Explanation{std::string(row->code), std::string(row->summary),
                     std::string(row->description), std::string(row->help)};
}

std::string_view version() { return kVersion; }

}  // namespace btcheck::v1
