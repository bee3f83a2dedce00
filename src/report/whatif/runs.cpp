// SPDX-License-Identifier: MIT
#include "report/whatif/runs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "check/replay/executed.hpp"
#include "report/whatif/words.hpp"
#include "trace/run/record.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// The steps of a row, executed; one that ends where it has been before goes
// round.
std::optional<Run> executed(const RowNetwork& made, const FaultRow& row) {
  std::optional<Run> run = executed(made.network, row.steps);
  if (!run || row.harm != Harm::NeverEnds) return run;
  const Valuation& last = run->state(run->steps.size());
  for (std::size_t i = 0; i + 1 < run->state_count(); ++i) {
    if (!(run->state(i) == last)) continue;
    run->loop = i;
    break;
  }
  return run;
}

// The state in which all faults have struck.
std::optional<std::size_t> struck_at(const RowNetwork& made,
                                     const FaultRow& row, const Run& run) {
  std::vector<VariableId> phases;
  for (const InjectedFault& fault : row.faults) {
    const auto phase = fault_phase(made.network, fault.leaf);
    if (phase) phases.push_back(*phase);
  }
  for (std::size_t i = 0; i < run.state_count(); ++i) {
    const bool have_all = std::ranges::all_of(phases, [&](VariableId phase) {
      return run.state(i).variables[static_cast<std::size_t>(phase)] !=
             static_cast<int>(FaultPhase::NotYet);
    });
    if (have_all) return i;
  }
  return std::nullopt;
}

}  // namespace

std::size_t row_count(const WhatIf& result) {
  return result.rows.size() + result.pairs.size();
}

const FaultRow& row_numbered(const WhatIf& result, std::size_t number) {
  return number <= result.rows.size()
             ? result.rows[number - 1]
             : result.pairs[number - 1 - result.rows.size()];
}

std::optional<RecordedRun> run_of_row(const WhatIfReport& report,
                                      std::size_t number) {
  const BehaviorTree& tree = report.tree();
  const FaultRow& row = row_numbered(report.result, number);
  if (row.steps.empty()) return std::nullopt;
  const RowNetwork made =
      network_of(report.input, report.result, row, report.ticks);
  const auto run = executed(made, row);
  if (!run) return std::nullopt;
  RunHeading heading;
  heading.property = fmt::format("{}: {}", number, faults_text(tree, row));
  heading.formula = fmt::format("{}: the mission {}", facts_of(row.harm).word,
                                harm_text(tree, report.result, row));
  heading.verdict = row.harm < Harm::Survives ? "VIOLATED" : "HOLDS";
  if (row.notice) {
    heading.why = fmt::format("noticed: {}", notice_text(tree, row));
  }
  const std::string recovery = recovery_text(tree, row);
  if (!recovery.empty()) {
    heading.why += (heading.why.empty() ? "" : "; ") + recovery;
  }
  heading.trigger = struck_at(made, row, *run);
  heading.trigger_words = row.faults.size() == 1 ? "the fault strikes here"
                                                 : "both faults have struck";
  add_sources(heading, made.tree, report.file);
  return recorded(made.tree, made.network, *run, heading);
}

std::string run_name(const WhatIfReport& report, std::size_t number) {
  const FaultRow& row = row_numbered(report.result, number);
  std::string name = fmt::format("{}", number);
  for (const InjectedFault& fault : row.faults) {
    name += fmt::format(
        ".{}.{}",
        shortened(plain_word(report.tree().node(fault.leaf).name, "-"), 40),
        facts_of(fault.fault.kind).word);
  }
  return name;
}

}  // namespace btcheck
