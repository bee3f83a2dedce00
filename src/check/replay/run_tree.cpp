// SPDX-License-Identifier: MIT
#include "check/replay/run_tree.hpp"

#include <algorithm>
#include <utility>

namespace btcheck {
namespace {

// A state is kept wherever so many steps lie behind it: of the first branches
// more, since small trees are looked up most, for their size.
constexpr std::uint32_t kApart = 64;
constexpr std::uint32_t kNear = 4;
constexpr std::size_t kFirst = 4096;

}  // namespace

RunTree::RunTree(const Network& network)
    : network_(network), interpreter_(network) {
  branches_.push_back({});
  kept_.emplace(0, interpreter_.initial());
}

RunTree::Place RunTree::follow(Place from, const Step& step,
                               const Valuation& state) {
  const std::uint64_t key = std::uint64_t{from} << 32 | step.edge;
  const auto [first, last] = following_.equal_range(key);
  for (auto at = first; at != last; ++at) {
    if (branches_[at->second].step == step) return at->second;
  }
  const Place made = add(from, step);
  following_.emplace(key, made);
  const std::uint32_t apart = branches_.size() < kFirst ? kNear : kApart;
  if (branches_[made].depth % apart == 0) kept_.emplace(made, state);
  return made;
}

void RunTree::close() {
  following_ = {};
  Valuation initial = std::move(kept_.at(0));
  kept_ = {};
  kept_.emplace(0, std::move(initial));
  branches_.shrink_to_fit();
}

RunTree::Place RunTree::add(Place from, const Step& step) {
  branches_.push_back({from, branches_[from].depth + 1,
                       branches_[from].ticks + step.elapsed, step});
  return static_cast<Place>(branches_.size() - 1);
}

Valuation RunTree::state(Place place) const {
  std::vector<Step> rest;
  while (!kept_.contains(place)) {
    rest.push_back(branches_[place].step);
    place = branches_[place].from;
  }
  Valuation here = kept_.at(place);
  for (auto step = rest.rbegin(); step != rest.rend(); ++step) {
    interpreter_.take(here, *step);
  }
  return here;
}

std::vector<Step> RunTree::steps_to(Place place) const {
  std::vector<Step> steps(branches_[place].depth);
  for (std::size_t i = steps.size(); i > 0; place = branches_[place].from) {
    steps[--i] = branches_[place].step;
  }
  return steps;
}

Run KeptRun::told() const {
  Run run;
  run.initial = tree_->interpreter().initial();
  run.loop = loop();
  walk([&](const Valuation&, const RunStep& step) {
    run.steps.push_back(step);
  });
  return run;
}

}  // namespace btcheck
