// SPDX-License-Identifier: MIT
#include "check/questions/witnesses.hpp"

#include <algorithm>

namespace btcheck {
namespace {

// The run has the answer that a suspicion asks for.
bool has_answer(const KeptRun& run, const Consequence& asked) {
  return std::ranges::any_of(run.steps(), [&](const Step& step) {
    return step.edge != kTimeStep &&
           node_entering(run.network(), step.edge, asked.answer) == asked.node;
  });
}

// Those of whom it asks for no status have not been ticked on the run at all; a
// reset takes a status back.
bool is_new_on(const KeptRun& run, const Sighting& sighting) {
  return std::ranges::none_of(sighting.with, [&](const auto& each) {
    return each.second == NodeStatus::NoRetStatus &&
           has_answer(run, {each.first, LocationRole::Tick});
  });
}

}  // namespace

Possibility Evidence::possibility(NodeId node, std::size_t question) const {
  if (!known_.nodes.empty() && known_.nodes[index(node)][question]) {
    return {Verdict::Holds, known_.nodes[index(node)][question]};
  }
  Possibility answer = told(
      [&](const DefaultQuestions& seen) {
        return seen.nodes[index(node)][question];
      },
      [&](const QuestionsAsked& asked) { return asked.has(node, question); });
  const NeverDone& never = known_.never;
  const bool is_never = !never.empty() && never[index(node)][question];
  if (is_never && answer.verdict == Verdict::Undecided) {
    answer.verdict = Verdict::Violated;
  }
  return answer;
}

bool Evidence::has_sighting(std::size_t i) const {
  if (!known_.sighted.empty() && known_.sighted[i]) return true;
  return std::ranges::any_of(seen_, [&](const Seen& each) {
    return each.questions.sightings.found()[i].has_value();
  });
}

std::optional<KeptRun> Evidence::run_to(
    std::size_t sighting, const std::optional<Consequence>& then) const {
  if (!known_.sighted.empty() && known_.sighted[sighting]) {
    const auto& [run, followed] = *known_.sighted[sighting];
    return then ? followed : run;
  }
  for (const auto& [questions, reporter] : seen_) {
    const auto& found = questions.sightings.found()[sighting];
    if (!found) continue;
    auto run = then ? reporter.run_to(*found, *then) : reporter.run_to(*found);
    if (run) return run;
  }
  return std::nullopt;
}

bool Judge::confirm(Suspicion& suspicion) {
  const std::size_t shown = next_;
  const std::size_t cleared = shown + suspicion.shown_by.size();
  next_ = cleared + suspicion.cleared_by.size();
  for (std::size_t i = cleared; i < next_; ++i) {
    if (!is_complete_ || evidence_.has_sighting(i)) return false;
  }
  if (suspicion.shown_by.empty()) return true;
  for (std::size_t i = shown; i < cleared; ++i) {
    auto& run = suspicion.finding.run;
    run = evidence_.run_to(i, suspicion.then);
    const auto& after = suspicion.after;
    const bool is_new = run && is_new_on(*run, suspicion.shown_by[i - shown]);
    if (is_new && (!after || has_answer(*run, *after))) return true;
  }
  return false;
}

}  // namespace btcheck
