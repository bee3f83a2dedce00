// SPDX-License-Identifier: MIT
//
// Rules for the program that runs the tree: nothing is searched.
#include <utility>

#include "api/call.hpp"
#include "api/told.hpp"
#include "check/export/export_model.hpp"
#include "report/text/report.hpp"

namespace btcheck::v1 {

RuleTable monitor_table(const Request& request, Sources& sources,
                        Monitor* monitor) {
  AskedSources asked(sources, request.is_one_program);
  Call call(request, monitor);
  const BudgetScope budget(&call);
  RuleTable table;
  table.outcome = Outcome::BadInput;
  std::vector<Diagnostic> found;
  try {
    if (const auto inputs = inputs_of(request, asked, found)) {
      auto made = export_model(
          inputs->tree, inputs->rules,
          {.format = ExportFormat::Monitor, .ticks = inputs->ticks});
      judge(inputs->tree, inputs->judgement, made.diagnostics);
      std::ranges::move(made.diagnostics, std::back_inserter(found));
      if (made.value) {
        table.text = std::move(*made.value);
        table.outcome = Outcome::Met;
      }
    }
  } catch (const BudgetSpent& spent) {
    table.outcome = Outcome::Undecided;
    found = {spent_diagnostic(spent, request.tree)};
  }
  const BudgetScope telling(nullptr);
  for (const Diagnostic& each : found) {
    table.findings.push_back(finding_of(btcheck::finding_of(each)));
  }
  return table;
}

}  // namespace btcheck::v1
