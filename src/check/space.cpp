// SPDX-License-Identifier: MIT
//
// The figures of TINA's sift: classes (our states), markings, transitions.
#include "check/space.hpp"

#include "explore/breadth_first.hpp"
#include "explore/depth_first.hpp"
#include "explore/step.hpp"

namespace btcheck {
namespace {

// Counts the states that differ in more than their clocks. A state whose
// clocks are all 0 is its own marking; only the markings of the others, which
// are few, are kept.
class Markings : public ReachabilityVisitor {
 public:
  explicit Markings(const CompiledNetwork& system)
      : system_(system),
        cleared_(system.word_count()),
        words_(system.word_count()) {}

  GoOn expanded(StateId, StateView state, bool is_dead) {
    dead_ += is_dead;
    std::copy(state.begin(), state.end(), words_.begin());
    system_.clear_clocks(words_);
    if (std::equal(state.begin(), state.end(), words_.begin())) {
      ++clockless_;
    } else {
      cleared_.insert(words_);
    }
    return GoOn::Yes;
  }
  std::size_t bytes() const { return cleared_.bytes(); }
  std::uint64_t dead() const { return dead_; }

  // To be asked when the search is over.
  std::uint64_t count(const StateStore& store) {
    std::uint64_t markings = clockless_;
    for (std::uint32_t i = 0; i < cleared_.size(); ++i) {
      cleared_.load(StateId{i}, words_);
      markings += !store.find(words_).has_value();
    }
    return markings;
  }

 private:
  const CompiledNetwork& system_;
  StateStore cleared_;
  StateVector words_;
  std::uint64_t clockless_ = 0;
  std::uint64_t dead_ = 0;
};

template <class Search>
SpaceReport measured(const CompiledNetwork& system, Search&& search) {
  Markings markings(system);
  SpaceReport report;
  report.result = search.run(markings);
  report.markings = markings.count(search.store());
  report.dead_states = markings.dead();
  report.vector_bits = system.layout().bits;
  report.bytes = report.result.progress.bytes - markings.bytes();
  return report;
}

}  // namespace

SpaceReport measure_space(const Network& network, SearchOrder order,
                          const Limits& limits) {
  const CompiledNetwork system(network);
  return order == SearchOrder::DepthFirst
             ? measured(system, DepthFirst(system, limits))
             : measured(system, BreadthFirst(system, limits));
}

}  // namespace btcheck
