// SPDX-License-Identifier: MIT
#include "check/questions/inquiry.hpp"

#include <algorithm>
#include <utility>

#include "check/findings/findings.hpp"
#include "check/findings/words.hpp"
#include "check/questions/answered.hpp"

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

void report_left_running(const Seen& seen, DefaultReport& report) {
  for (const LeftRunningStep& found : seen.questions.left_running.found()) {
    const bool is_told = std::ranges::any_of(
        report.left_running, [&](const LeftRunningReport& each) {
          return each.leaf == found.leaf && each.above == found.above;
        });
    if (is_told) continue;
    const auto run = seen.reporter.run_to(found.step);
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

Inquiry::Inquiry(const BehaviorTree& tree, const Network& network)
    : tree_(tree),
      network_(network),
      normal_(tree),
      suspicions_(suspicions_of(normal_)),
      guarded_(guarded_actions(tree, network)),
      sightings_(sightings_of(suspicions_)) {
  for (const GuardedAction& each : guarded_) {
    sightings_.push_back(each.sighting);
  }
}

std::vector<std::optional<Consequence>> Inquiry::consequences() const {
  std::vector<std::optional<Consequence>> all;
  for (const Suspicion& each : suspicions_) {
    all.insert(all.end(), each.shown_by.size(), each.then);
    all.insert(all.end(), each.cleared_by.size(), std::nullopt);
  }
  all.resize(sightings_.size());
  return all;
}

void Inquiry::answer(const Seen& of_tree, bool is_tree_complete,
                     const Evidence& evidence, bool is_complete,
                     DefaultReport& report) && {
  answer_for_tree(of_tree, is_tree_complete, evidence, report);
  const bool runs_on = is_meant_to_run_on(normal_.tree());
  for (TreeReport& answer : report.tree) {
    answer.is_meant =
        runs_on && answer.question <= TreeQuestion::CanAlwaysSucceed;
  }
  for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
    report.nodes.push_back({NodeId{n}, {}});
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      report.nodes.back().answers[q] = evidence.possibility(NodeId{n}, q);
    }
  }
  report_guards(evidence, report);
  for (const Seen& each : evidence.seen()) report_left_running(each, report);
  report.findings = findings_in(normal_, report);
  Judge judge(evidence, is_complete);
  for (Suspicion& each : suspicions_) {
    if (judge.confirm(each)) report.findings.push_back(std::move(each.finding));
  }
  rank(report.findings, tree_);
  put_into_words(tree_, report.findings);
}

// The questions of the tree, in the order of TreeQuestion.
void Inquiry::answer_for_tree(const Seen& seen, bool is_complete,
                              const Evidence& evidence,
                              DefaultReport& report) const {
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
  const StoredGraph& graph = seen.questions.graph;
  const auto can_always = [&](TreeQuestion question,
                              const std::vector<bool>& goal) {
    if (!is_complete) return add(question, {});
    never(question, seen.reporter.possibility(first_that_cannot(graph, goal)));
  };
  can_always(TreeQuestion::CanAlwaysEnd, seen.questions.ended);
  can_always(TreeQuestion::CanAlwaysSucceed, seen.questions.succeeded);
  never(TreeQuestion::NeverStuck,
        evidence.possibility(&DefaultQuestions::stuck));
  never(TreeQuestion::InRange, evidence.possibility(&DefaultQuestions::fault));
  // Where no time passes at all, every loop is a loop without time.
  if (network_.ticks == TickSemantics::None) return;
  if (!is_complete) return add(TreeQuestion::NoZeroTimeLoop, {});
  const auto state = graph.on_zero_time_loop();
  seen.reporter.never_loops(state ? graph.zero_time_loop(*state)
                                  : std::vector<StateId>());
}

// Only what the replayed runs show is reported.
void Inquiry::report_guards(const Evidence& evidence,
                            DefaultReport& report) const {
  std::size_t sighting = sightings_.size() - guarded_.size();
  for (const GuardedAction& each : guarded_) {
    const auto run = evidence.run_to(sighting++);
    if (!run) continue;
    auto guards = stale_guards(network_, each, run->steps());
    if (guards.empty()) continue;
    report.stale_guards.push_back({each.sighting.node, std::move(guards), run});
  }
}

}  // namespace btcheck
