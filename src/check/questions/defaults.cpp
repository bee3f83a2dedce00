// SPDX-License-Identifier: MIT
//
// The paper's default properties (section 4.1) and what a mission's author asks
// next, all answered by one breadth-first search. Only "can it still end?",
// "can it still succeed?" and "does a tick never return?" need the steps once
// more; they are kept in a graph while there is memory for it. A search that
// takes long is interrupted for random walks: what they see is told at once,
// and stands where the search does not come to it.
#include "check/questions/defaults.hpp"

#include <optional>
#include <utility>

#include "check/questions/default_questions.hpp"
#include "check/questions/inquiry.hpp"
#include "check/questions/reporter.hpp"
#include "check/questions/samples.hpp"
#include "check/search/searched_network.hpp"
#include "explore/search/reachability.hpp"
#include "text/budget.hpp"

namespace btcheck {

DefaultReport check_defaults(const BehaviorTree& tree,
                             const CompiledNetwork& system, Reduction reduction,
                             const Limits& limits, Sampling sampling,
                             unsigned threads) {
  DefaultReport report;
  report.reduction = reduction;
  const Network& network = system.network();
  Inquiry inquiry(tree, network);
  const std::vector<Sighting>& sightings = inquiry.sightings();
  const SearchedNetwork searched(system, seen_by_default(tree, network),
                                 kept_for_default(tree, network, sightings),
                                 reduction);
  DefaultQuestions questions(tree, searched.system().network(), sightings);
  BreadthFirst search(searched.system(), limits,
                      searched.system().is_reduced() ? threads : 1);
  std::optional<Samples> samples;
  if (sampling == Sampling::WhenLong) {
    questions.pause = [&](std::size_t expanded) {
      if (samples || !are_samples_due(expanded, limits)) return;
      samples.emplace(tree, searched, sightings, network, limits, report,
                      expanded);
      questions.beside = samples->bytes();
      if (limits.monitor != nullptr) {
        limits.monitor->found(samples->told(inquiry.suspicions()));
      }
    };
  }
  const ReachabilityResult result = search.run(questions);
  // What has been found is told.
  const BudgetScope telling(nullptr);
  report.progress = result.progress;
  report.stopped = result.stopped;
  Reporter reporter(searched, search, result.is_complete, network, limits,
                    report);
  reporter.look_up(questions.found_from());
  const Seen seen{questions, reporter};
  Evidence evidence;
  evidence.add(seen);
  if (samples && !result.is_complete) evidence.add(samples->seen());
  if (result.is_complete) questions.graph.close(search.store().size());
  std::move(inquiry).answer(seen, result.is_complete, evidence,
                            result.is_complete, report);
  return report;
}

Severity severity_of(const TreeReport& report) {
  if (report.severity) return *report.severity;
  return report.question == TreeQuestion::CanSucceed ? Severity::Warning
                                                     : Severity::Error;
}

bool is_bad(const TreeReport& report) {
  return report.verdict == Verdict::Violated && !report.is_meant &&
         !code_of(report.question).empty();
}

bool is_fault(const TreeReport& report) {
  return is_bad(report) && severity_of(report) == Severity::Error;
}

std::string_view code_of(TreeQuestion question) {
  switch (question) {
    case TreeQuestion::CanSucceed:
      return "BT2105";
    case TreeQuestion::CanAlwaysEnd:
      return "BT2104";
    case TreeQuestion::NeverStuck:
      return "BT2103";
    case TreeQuestion::InRange:
      return "BT2101";
    case TreeQuestion::NoZeroTimeLoop:
      return "BT2102";
    case TreeQuestion::CanFail:
    case TreeQuestion::CanAlwaysSucceed:
      return "";
  }
  return "";
}

}  // namespace btcheck
