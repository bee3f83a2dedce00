// SPDX-License-Identifier: MIT
//
// Many runs of one network, kept together.
//
// The runs that one search finds mostly begin alike, so their steps are the
// branches of one tree: a step that a thousand runs share is kept once. States
// are computed from the nearest of a few that are kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "check/bind/verdict.hpp"
#include "check/replay/replay.hpp"

namespace btcheck {

class RunTree {
 public:
  // Where a run has come to; the start is 0.
  using Place = std::uint32_t;

  // The network must outlive this.
  explicit RunTree(const Network& network);

  // The place one step further. `state` is the one it leads to.
  Place follow(Place from, const Step& step, const Valuation& state);
  // No steps follow any more: what that takes is given back.
  void close();
  // A place of its own; the state is computed where somebody asks.
  Place add(Place from, const Step& step);
  Valuation state(Place place) const;
  // From the start to there, and the units of time that pass on the way.
  std::vector<Step> steps_to(Place place) const;
  // Places are numbered behind those from which they are reached.
  std::size_t size() const { return branches_.size(); }
  // The place before, not of the start, and the step from there.
  Place before(Place place) const { return branches_[place].from; }
  const Step& last_step(Place place) const { return branches_[place].step; }
  int ticks_to(Place place) const { return branches_[place].ticks; }
  std::size_t length_to(Place place) const { return branches_[place].depth; }

  const Network& network() const { return network_; }
  const NetworkInterpreter& interpreter() const { return interpreter_; }

 private:
  struct Branch {
    Place from = 0;
    std::uint32_t depth = 0;
    std::int32_t ticks = 0;
    Step step;
  };

  const Network& network_;
  NetworkInterpreter interpreter_;
  std::vector<Branch> branches_;
  std::unordered_multimap<std::uint64_t, Place> following_;
  std::unordered_map<Place, Valuation> kept_;
};

// A run in such a tree, and what it does for ever then, if anything.
class KeptRun {
 public:
  KeptRun(std::shared_ptr<const RunTree> tree, RunTree::Place end,
          std::vector<Step> loop = {})
      : tree_(std::move(tree)), end_(end), loop_(std::move(loop)) {}

  const Network& network() const { return tree_->network(); }
  const RunTree& tree() const { return *tree_; }
  // Where it has come to before its loop.
  RunTree::Place end() const { return end_; }
  bool is_empty() const { return step_count() == 0; }
  std::size_t step_count() const {
    return tree_->length_to(end_) + loop_.size();
  }
  // Units of time that pass before the loop.
  int ticks() const { return tree_->ticks_to(end_); }
  // The number of the step that the loop begins with, or kNoLoop.
  std::size_t loop() const {
    return loop_.empty() ? kNoLoop : tree_->length_to(end_);
  }
  std::vector<Step> steps() const {
    std::vector<Step> steps = tree_->steps_to(end_);
    steps.insert(steps.end(), loop_.begin(), loop_.end());
    return steps;
  }
  // As Run::walk, with one state at a time: both arguments die with the call.
  template <class Visit>
  void walk(Visit&& visit) const {
    const NetworkInterpreter& interpreter = tree_->interpreter();
    Valuation before = interpreter.initial();
    RunStep next{{}, before};
    const auto take = [&](const Step& step) {
      next.step = step;
      interpreter.take(next.after, step);
      visit(std::as_const(before), std::as_const(next));
      before = next.after;
    };
    for (const Step& step : steps()) take(step);
  }
  // With all its states.
  Run told() const;

 private:
  std::shared_ptr<const RunTree> tree_;
  RunTree::Place end_;
  std::vector<Step> loop_;
};

}  // namespace btcheck
