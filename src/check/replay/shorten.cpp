// SPDX-License-Identifier: MIT
//
// In a shortest lasso the weather may change a dozen times where it never
// matters. What can be left out is left out, one thing after the other, as in
// Zeller and Hildebrandt's delta debugging (2002), but with candidates that
// have a chance:
//
//   - moves of one free variable from one of them on up to where the variable
//     has its old value again, or up to the last one;
//   - what lies between two ticks of the same node;
//   - the end of the stem, where it is the end of the loop as well.
#include "check/replay/shorten.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <vector>

#include "check/replay/replay.hpp"

namespace btcheck {
namespace {

constexpr int kMostCandidates = 2000;
// What bounds the time for long runs: a step takes some microseconds.
constexpr std::size_t kMostSteps = 300'000;
constexpr std::size_t kMostLength = 20'000;

class Shortener {
 public:
  Shortener(const Network& network, Run run,
            const std::function<bool(const Run&)>& still_shows)
      : network_(network),
        interpreter_(network),
        run_(std::move(run)),
        still_shows_(still_shows) {}

  Run shorten() {
    for (bool grows_shorter = true; grows_shorter;) {
      const std::size_t before = run_.steps.size();
      drop_free_moves();
      drop_rounds();
      turn_loop();
      grows_shorter = run_.steps.size() < before && may_go_on();
    }
    return std::move(run_);
  }

 private:
  bool may_go_on() const {
    return candidates_ < kMostCandidates && executed_ < kMostSteps;
  }

  bool has_loop() const { return run_.loop != kNoLoop; }

  // The variable that moves by itself in this step, if one does.
  const Automaton* free_mover(std::size_t step) const {
    const std::uint32_t edge = run_.steps[step].step.edge;
    if (edge == kTimeStep) return nullptr;
    const Automaton& owner = network_.owner_of_edge(edge);
    return owner.kind == AutomatonKind::StateVariable ? &owner : nullptr;
  }

  int value(std::size_t state, const Automaton& variable) const {
    const VariableId held =
        network_.state_variable[index(variable.state_variable)];
    return run_.state(state).variables[index(held)];
  }

  // From the end, so that what hangs on nothing any more goes first.
  void drop_free_moves() {
    for (std::size_t i = run_.steps.size(); i > 0 && may_go_on(); --i) {
      // A step back may have shortened the run by more than one.
      if (i > run_.steps.size()) i = run_.steps.size();
      if (i == 0) break;
      const Automaton* variable = free_mover(i - 1);
      if (variable) drop_moves_from(i - 1, *variable);
    }
  }

  // Tries to leave out the moves of a variable from this one on: as few as
  // bring its old value back, then all.
  void drop_moves_from(std::size_t first, const Automaton& variable) {
    std::vector<std::size_t> moves;
    bool is_back = false;
    for (std::size_t i = first; i < run_.steps.size() && !is_back; ++i) {
      if (free_mover(i) != &variable) continue;
      moves.push_back(i);
      is_back = value(i + 1, variable) == value(first, variable);
      if (moves.size() == 1 || is_back) {
        if (leave_out(moves)) return;
      }
    }
    if (moves.size() > 1 && !is_back) leave_out(moves);
  }

  // The steps from one tick of a node to a later one of the same node; the
  // longest first.
  void drop_rounds() {
    for (std::size_t from = 0; from < run_.steps.size(); ++from) {
      if (!begins_round(from)) continue;
      for (std::size_t to = run_.steps.size(); to > from + 1;) {
        if (!may_go_on()) return;
        --to;
        if (!(run_.steps[to].step == run_.steps[from].step)) continue;
        std::vector<std::size_t> round(to - from);
        std::iota(round.begin(), round.end(), from);
        if (leave_out(round)) to = run_.steps.size();
      }
    }
  }

  // Time passes, or a node is ticked.
  bool begins_round(std::size_t step) const {
    const std::uint32_t edge = run_.steps[step].step.edge;
    return edge == kTimeStep ||
           node_entering(network_, edge, LocationRole::Tick).has_value();
  }

  // The loop begins earlier where the stem ends as the loop does.
  void turn_loop() {
    while (has_loop() && run_.loop > 0 && may_go_on()) {
      const std::size_t stem = run_.loop - 1;
      const std::size_t last = run_.steps.size() - 1;
      if (!(run_.steps[stem].step == run_.steps[last].step) ||
          run_.state(stem) != run_.state(last)) {
        return;
      }
      Run turned = run_;
      turned.steps.pop_back();
      --turned.loop;
      ++candidates_;
      if (!still_shows_(turned)) return;
      run_ = std::move(turned);
    }
  }

  // Of executing an edge: scripts over many values are long expressions.
  std::size_t effort_of(std::uint32_t edge) const {
    constexpr std::size_t kTermsOfStep = 16;
    if (edge == kTimeStep) return 1;
    std::size_t terms = network_.edge(edge).guard.terms().size();
    for (const Assignment& update : network_.edge(edge).updates) {
      terms += update.value.terms().size();
    }
    return 1 + terms / kTermsOfStep;
  }

  // The run without these steps, in ascending order, if it is one and shows
  // what it should; then it is the run from now on.
  bool leave_out(const std::vector<std::size_t>& steps) {
    ++candidates_;
    const std::size_t first = steps.front();
    std::size_t loop = run_.loop;
    std::vector<RunStep> rest;
    rest.reserve(run_.steps.size() - first);
    auto left_out = steps.begin();
    for (std::size_t i = first; i < run_.steps.size(); ++i) {
      if (i == run_.loop) loop = first + rest.size();
      if (left_out != steps.end() && *left_out == i) {
        ++left_out;
        continue;
      }
      executed_ += effort_of(run_.steps[i].step.edge);
      const Step& step = run_.steps[i].step;
      auto next = interpreter_.taken(
          rest.empty() ? run_.state(first) : rest.back().after, step);
      if (!next) return false;
      rest.push_back({step, std::move(*next)});
    }
    Run candidate{run_.initial, {}, loop};
    candidate.steps.assign(
        run_.steps.begin(),
        run_.steps.begin() + static_cast<std::ptrdiff_t>(first));
    std::ranges::move(rest, std::back_inserter(candidate.steps));
    if (!closes(candidate) || !still_shows_(candidate)) return false;
    run_ = std::move(candidate);
    return true;
  }

  bool closes(const Run& run) const {
    if (!has_loop()) return true;
    return run.loop < run.steps.size() &&
           run.state(run.loop) == run.state(run.steps.size()) &&
           std::ranges::any_of(run.loop_steps(), [](const RunStep& step) {
             return step.step.progress;
           });
  }

  const Network& network_;
  NetworkInterpreter interpreter_;
  Run run_;
  const std::function<bool(const Run&)>& still_shows_;
  int candidates_ = 0;
  std::size_t executed_ = 0;
};

// Every step is possible and leads to the state that stands behind it.
bool can_be_executed(const Network& network, const Run& run) {
  const NetworkInterpreter interpreter(network);
  if (run.initial != interpreter.initial()) return false;
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    if (interpreter.taken(run.state(i), run.steps[i].step) !=
        run.steps[i].after) {
      return false;
    }
  }
  return run.loop == kNoLoop ||
         run.state(run.loop) == run.state(run.steps.size());
}

}  // namespace

Run shortened(const Network& network, Run run,
              const std::function<bool(const Run&)>& still_shows) {
  if (run.steps.size() > kMostLength) return run;
  Run shorter = Shortener(network, run, still_shows).shorten();
  const bool is_sound =
      can_be_executed(network, shorter) && still_shows(shorter);
  assert(is_sound);
  return is_sound ? shorter : run;
}

}  // namespace btcheck
