// SPDX-License-Identifier: MIT
//
// P leadsto Q within [from, to] on toy systems, naively.
//
// Each reachable state with P is taken in turn. From it, the graph of states
// and ages is written out in full, without the points where an answer is in
// time; what is left are the ways not to answer. They matter if age to + 1 is
// reached in it, or if a run goes on in it for ever.
#include "reference/late_response.hpp"

#include <algorithm>
#include <vector>

#include "reference/fair_graph.hpp"

namespace btcheck::reference {

namespace {

constexpr std::size_t kFar = SIZE_MAX;

class Unanswered {
 public:
  Unanswered(const ToySystem& system, const TimedPattern& response)
      : system_(system),
        response_(response),
        ages_(static_cast<std::size_t>(response.to) + 2) {
    graph_.all_sets = 1;
    graph_.steps.resize(system.size() * ages_);
    for (std::size_t point = 0; point < graph_.steps.size(); ++point) {
      add_steps(point);
    }
    fair_ = states_with_fair_run(graph_);
  }

  bool is_answered(std::size_t state, std::size_t age) const {
    return age >= static_cast<std::size_t>(response_.from) &&
           age <= static_cast<std::size_t>(response_.to) &&
           (system_.label_of(state) & response_.answer) != 0;
  }
  bool goes_on(std::size_t state) const { return fair_[state * ages_]; }

  // Steps from a state at age 0 to each point, kFar for none.
  std::vector<std::size_t> distances(std::size_t state) const {
    std::vector<std::size_t> distance(graph_.steps.size(), kFar);
    std::vector<std::size_t> queue;
    if (!is_answered(state, 0)) {
      queue.push_back(state * ages_);
      distance[queue[0]] = 0;
    }
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const FairGraph::Step& step : graph_.steps[queue[i]]) {
        if (distance[step.target] != kFar) continue;
        distance[step.target] = distance[queue[i]] + 1;
        queue.push_back(step.target);
      }
    }
    return distance;
  }

  std::size_t steps_to_late(std::size_t state) const {
    const std::vector<std::size_t> distance = distances(state);
    std::size_t fewest = kFar;
    for (std::size_t s = 0; s < system_.size(); ++s) {
      fewest = std::min(fewest, distance[s * ages_ + ages_ - 1]);
    }
    return fewest;
  }

  int longest_answer(std::size_t state) const {
    if (is_answered(state, 0)) return 0;
    const std::vector<std::size_t> distance = distances(state);
    int longest = -1;
    for (std::size_t point = 0; point < distance.size(); ++point) {
      if (distance[point] == kFar) continue;
      for (const ToySystem::ToyStep& step : system_.steps(point / ages_)) {
        const std::size_t age = point % ages_ + step.step.elapsed;
        if (is_answered(step.target, age)) {
          longest = std::max(longest, static_cast<int>(age));
        }
      }
    }
    return longest;
  }

 private:
  void add_steps(std::size_t point) {
    const std::size_t age = point % ages_;
    if (age == ages_ - 1) {
      graph_.steps[point].push_back({point, 1});
      return;
    }
    if (is_answered(point / ages_, age)) return;
    for (const ToySystem::ToyStep& step : system_.steps(point / ages_)) {
      const std::size_t there = age + step.step.elapsed;
      if (is_answered(step.target, there)) continue;
      graph_.steps[point].push_back(
          {step.target * ages_ + there, step.step.progress ? 1u : 0u});
    }
  }

  const ToySystem& system_;
  const TimedPattern response_;
  const std::size_t ages_;  // 0 to `to` + 1
  FairGraph graph_;
  std::vector<bool> fair_;
};

std::vector<std::size_t> distances_from_initial(const ToySystem& system) {
  std::vector<std::size_t> distance(system.size(), kFar);
  std::vector<std::size_t> queue(system.initial().begin(),
                                 system.initial().end());
  for (const std::size_t state : queue) distance[state] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const ToySystem::ToyStep& step : system.steps(queue[i])) {
      if (distance[step.target] != kFar) continue;
      distance[step.target] = distance[queue[i]] + 1;
      queue.push_back(step.target);
    }
  }
  return distance;
}

}  // namespace

LateResponse late_response(const ToySystem& system,
                           const TimedPattern& response) {
  const Unanswered unanswered(system, response);
  const std::vector<std::size_t> distance = distances_from_initial(system);
  LateResponse result;
  for (std::size_t state = 0; state < system.size(); ++state) {
    if (distance[state] == kFar ||
        (system.label_of(state) & response.trigger) == 0) {
      continue;
    }
    ++result.triggers;
    result.longest_answer =
        std::max(result.longest_answer, unanswered.longest_answer(state));
    if (unanswered.is_answered(state, 0)) continue;
    result.exists = result.exists || unanswered.goes_on(state);
    const std::size_t late = unanswered.steps_to_late(state);
    if (late == kFar) continue;
    result.fewest_steps =
        std::min(result.fewest_steps.value_or(kFar), distance[state] + late);
  }
  return result;
}

bool misses_response(const ToySystem& system, const TimedPattern& response,
                     const Lasso& lasso, std::size_t trigger) {
  std::vector<RunState> run = lasso.prefix;
  run.insert(run.end(), lasso.cycle.begin(), lasso.cycle.end());
  if (trigger >= run.size()) return false;
  if ((system.label(run[trigger].state) & response.trigger) == 0) return false;
  int age = 0;
  for (std::size_t i = trigger; i < run.size(); ++i) {
    if (i > trigger) age += run[i].step.elapsed;
    if (age > response.to) return i + 1 == run.size() && lasso.cycle.empty();
    if (age >= response.from &&
        (system.label(run[i].state) & response.answer) != 0) {
      return false;
    }
  }
  if (lasso.cycle.empty() || lasso.closing.elapsed != 0) return false;
  return std::all_of(
      lasso.cycle.begin() + 1, lasso.cycle.end(),
      [](const RunState& next) { return next.step.elapsed == 0; });
}

}  // namespace btcheck::reference
