// SPDX-License-Identifier: MIT
//
// Random walks from the initial states. They prove nothing, and come deep at
// once: what a search will find late, or not within its limits, is often seen
// here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "explore/search/reachability.hpp"
#include "explore/state/split_mix.hpp"

namespace btcheck {

// Three kinds of walks take turns. The first looks for what is rare: every
// other step is the one whose edge was taken least often so far. The second
// takes hopeful steps wherever it can, the third does so but now and then: a
// mission that needs forty successes in a row is hardly ever completed by
// chance, and what a single failure does is seen when all else goes well.
// (Walks of several kinds see more than many of one: Holzmann, Joshi, Groce,
// "Swarm verification techniques", IEEE TSE 2011.) They have 64 to 4096 steps,
// of each length as many.
template <TransitionSystem System>
class RandomWalks : public Reachability<System> {
 public:
  // `is_hopeful` says of each edge whether the world does what the system asks
  // it for.
  RandomWalks(const System& system, const Limits& limits,
              std::vector<bool> is_hopeful)
      : Reachability<System>(system, limits),
        is_hopeful_(std::move(is_hopeful)) {}

  // Takes so many steps, fewer where `may_go_on()`, asked now and then, says
  // no. The visitor is shown states and single steps as often as they are
  // passed. To be called once.
  template <class Visitor, class MayGoOn>
  void run(Visitor& visitor, std::size_t steps, MayGoOn may_go_on) {
    std::vector<StateId> starts;
    this->store_initial([&](StateId state) {
      this->tree_.reach(state, state);
      starts.push_back(state);
    });
    std::size_t left = 0;  // of this walk
    StateId at{};
    for (std::size_t walk = 0; steps > 0; --steps) {
      if (steps % kStepsPerPoll == 0 && !may_go_on()) return;
      if (left == 0) {
        at = starts[random_.below(starts.size())];
        left = kShortest << (walk % kLengths);
        kind_ = static_cast<Kind>(walk++ % 3);
      }
      left = take_step(at, visitor) ? left - 1 : 0;
    }
  }

  // Memory held by the walks.
  std::size_t bytes() const {
    return this->store_.bytes() + this->tree_.bytes();
  }

 private:
  using Expansion = typename Reachability<System>::Expansion;
  static constexpr std::size_t kStepsPerPoll = 64;
  static constexpr std::size_t kShortest = 64;
  static constexpr std::size_t kLengths = 7;
  static constexpr std::size_t kHopes = 16;  // to one step that is any

  enum class Kind : std::uint8_t { Rare, Hopeful, MostlyHopeful };

  // False where the walk ends.
  template <class Visitor>
  bool take_step(StateId& at, Visitor& visitor) {
    this->compute(at, expansion_, visitor);
    const auto& successors = expansion_.successors;
    StateId next = at;
    bool is_idle = successors.empty();
    if (!is_idle) {
      const auto& chosen = successors[choice()];
      ++taken_[chosen.step.edge];
      next = this->store_.insert(chosen.key).id;
      this->tree_.reach(next, at);
      is_idle = chosen.step.edge == kTimeStep && next == at;
    }
    visitor.expanded(at, expansion_.words, is_idle && successors.size() < 2);
    at = next;
    return !is_idle;
  }

  std::size_t choice() {
    const std::size_t any = random_.below(expansion_.successors.size());
    if (kind_ == Kind::Rare) return random_.below(2) == 0 ? any : rarest(any);
    if (kind_ == Kind::MostlyHopeful && random_.below(kHopes) == 0) return any;
    return hopeful(any);
  }

  // One of those taken least often, the first behind `any`.
  std::size_t rarest(std::size_t any) {
    const auto& successors = expansion_.successors;
    std::size_t chosen = any;
    for (std::size_t i = 1; i < successors.size(); ++i) {
      const std::size_t next = (any + i) % successors.size();
      if (taken_[successors[next].step.edge] <
          taken_[successors[chosen].step.edge]) {
        chosen = next;
      }
    }
    return chosen;
  }

  // The first that is hopeful from `any` on, else that one.
  std::size_t hopeful(std::size_t any) const {
    const auto& successors = expansion_.successors;
    for (std::size_t i = 0; i < successors.size(); ++i) {
      const std::size_t next = (any + i) % successors.size();
      const std::uint32_t edge = successors[next].step.edge;
      if (edge != kTimeStep && is_hopeful_[edge]) return next;
    }
    return any;
  }

  std::vector<bool> is_hopeful_;  // by edge
  Kind kind_ = Kind::Rare;
  Expansion expansion_;
  // By edge.
  std::unordered_map<std::uint32_t, std::uint32_t> taken_;
  SplitMix64 random_{1};
};

}  // namespace btcheck
