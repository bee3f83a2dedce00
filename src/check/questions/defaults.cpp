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

#include "check/findings/findings.hpp"
#include "check/findings/words.hpp"
#include "check/questions/answered.hpp"
#include "check/questions/default_questions.hpp"
#include "check/questions/reporter.hpp"
#include "check/questions/samples.hpp"
#include "check/questions/watches.hpp"
#include "check/questions/witnesses.hpp"
#include "check/search/searched_network.hpp"
#include "explore/search/reachability.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

// The first state from which none of the goal can be reached.
FirstState first_that_cannot(const StoredGraph& graph,
                             const std::vector<bool>& goal) {
  const std::vector<bool> can = graph.can_reach(goal);
  for (std::uint32_t s = 0; s < can.size(); ++s) {
    if (!can[s]) return StateId{s};
  }
  return std::nullopt;
}

// The questions of the tree, in the order of TreeQuestion.
void answer_for_tree(DefaultQuestions& questions, bool is_complete,
                     bool has_time, Reporter& reporter,
                     const Evidence& evidence, DefaultReport& report) {
  const auto add = [&](TreeQuestion question, Possibility answer) {
    report.tree.push_back({std::move(answer), question, false});
  };
  // Answered no by what is found.
  const auto never = [&](TreeQuestion question, Possibility answer) {
    if (answer.verdict != Verdict::Undecided) {
      answer.verdict =
          answer.verdict == Verdict::Holds ? Verdict::Violated : Verdict::Holds;
    }
    add(question, std::move(answer));
  };
  add(TreeQuestion::CanSucceed,
      evidence.possibility(&DefaultQuestions::success));
  add(TreeQuestion::CanFail, evidence.possibility(&DefaultQuestions::failure));
  const auto can_always = [&](TreeQuestion question,
                              const std::vector<bool>& goal) {
    if (!is_complete) return add(question, {});
    never(question,
          reporter.possibility(first_that_cannot(questions.graph, goal)));
  };
  can_always(TreeQuestion::CanAlwaysEnd, questions.ended);
  can_always(TreeQuestion::CanAlwaysSucceed, questions.succeeded);
  never(TreeQuestion::NeverStuck,
        evidence.possibility(&DefaultQuestions::stuck));
  never(TreeQuestion::InRange, evidence.possibility(&DefaultQuestions::fault));
  // Where no time passes at all, every loop is a loop without time.
  if (!has_time) return;
  if (!is_complete) return add(TreeQuestion::NoZeroTimeLoop, {});
  const StoredGraph& graph = questions.graph;
  const auto state = graph.on_zero_time_loop();
  reporter.never_loops(state ? graph.zero_time_loop(*state)
                             : std::vector<StateId>());
}

// Only what the replayed runs show is reported.
void report_guards(const BehaviorTree& tree, const Network& network,
                   const std::vector<NodeId>& actions, std::size_t first,
                   const Evidence& evidence, DefaultReport& report) {
  for (const NodeId action : actions) {
    const auto run = evidence.run_to(first++);
    if (!run) continue;
    auto guards = stale_guards(tree, network, action, run->steps());
    if (guards.empty()) continue;
    report.stale_guards.push_back({action, std::move(guards), run});
  }
}

void report_left_running(const LeftRunningWatch& watch, Reporter& reporter,
                         DefaultReport& report) {
  for (const LeftRunningStep& found : watch.found()) {
    const auto run = reporter.run_to(found.step);
    if (!run) continue;
    report.left_running.push_back(
        {found.leaf, found.above, found.decision, run});
  }
}

// The sightings of all suspicions in a row: first those that show one, then
// those that clear it.
std::vector<Sighting> sightings_of(const std::vector<Suspicion>& suspicions) {
  std::vector<Sighting> all;
  for (const Suspicion& each : suspicions) {
    all.insert(all.end(), each.shown_by.begin(), each.shown_by.end());
    all.insert(all.end(), each.cleared_by.begin(), each.cleared_by.end());
  }
  return all;
}

}  // namespace

DefaultReport check_defaults(const BehaviorTree& tree,
                             const CompiledNetwork& system, Reduction reduction,
                             const Limits& limits, Sampling sampling,
                             unsigned threads) {
  DefaultReport report;
  report.reduction = reduction;
  const NormalTree normal(tree);
  std::vector<Suspicion> suspicions = suspicions_of(normal);
  // Behind those of the suspicions: each guarded action, ticked while it runs.
  const std::vector<NodeId> guarded = guarded_actions(tree, system.network());
  std::vector<Sighting> sightings = sightings_of(suspicions);
  for (const NodeId action : guarded) {
    sightings.push_back(
        {action, LocationRole::Tick, {{action, NodeStatus::Running}}});
  }
  const SearchedNetwork searched(
      system, seen_by_default(tree, system.network()),
      kept_for_default(tree, system.network(), sightings), reduction);
  DefaultQuestions questions(tree, searched.system().network(), sightings);
  BreadthFirst search(searched.system(), limits,
                      searched.system().is_reduced() ? threads : 1);
  const Network& network = system.network();
  std::optional<Samples> samples;
  if (sampling == Sampling::WhenLong) {
    questions.pause = [&](std::size_t expanded) {
      if (samples || !are_samples_due(expanded, limits)) return;
      samples.emplace(tree, searched, sightings, network, limits, report,
                      expanded);
      questions.beside = samples->bytes();
      if (limits.monitor != nullptr) {
        limits.monitor->found(samples->told(suspicions));
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
  Evidence evidence;
  evidence.add({questions, reporter});
  if (samples && !result.is_complete) evidence.add(samples->seen());

  if (result.is_complete) questions.graph.close(search.store().size());
  answer_for_tree(questions, result.is_complete,
                  network.ticks != TickSemantics::None, reporter, evidence,
                  report);
  const bool runs_on = is_meant_to_run_on(normal.tree());
  for (TreeReport& answer : report.tree) {
    answer.is_meant =
        runs_on && answer.question <= TreeQuestion::CanAlwaysSucceed;
  }
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    report.nodes.push_back({NodeId{n}, {}});
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      report.nodes.back().answers[q] = evidence.possibility(
          [&](const DefaultQuestions& seen) { return seen.nodes[n][q]; });
    }
  }
  report_guards(tree, network, guarded, sightings.size() - guarded.size(),
                evidence, report);
  report_left_running(questions.left_running, reporter, report);
  report.findings = findings_in(normal, report);
  Judge judge(evidence, result.is_complete);
  for (Suspicion& each : suspicions) {
    if (judge.confirm(each)) report.findings.push_back(std::move(each.finding));
  }
  rank(report.findings, tree);
  put_into_words(tree, report.findings);
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
