// SPDX-License-Identifier: MIT
//
// The figures of TINA's sift: classes (our states), markings, transitions.
#include "check/space/space.hpp"

#include <algorithm>

#include "check/search/searched_network.hpp"
#include "explore/halves/cut.hpp"
#include "explore/halves/interned_system.hpp"
#include "explore/halves/split_network.hpp"
#include "explore/large/disk_breadth_first.hpp"
#include "explore/large/markings.hpp"
#include "explore/large/parallel_breadth_first.hpp"
#include "explore/search/reachability.hpp"
#include "explore/state/step.hpp"

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
    std::ranges::copy(state, words_.begin());
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

template <class Counted>
SpaceReport taken_from(const ParallelResult& result, const Counted& markings) {
  SpaceReport report;
  report.result = result.reachability;
  report.dead_states = markings.dead();
  report.largest_frontier = result.largest_frontier;
  report.bytes = result.peak_bytes;
  report.bytes_on_disk = result.peak_bytes_on_disk;
  return report;
}

template <PairSet Set, PairSystem System>
SpaceReport measured_in(System& system, const SpaceOptions& options,
                        const Limits& limits) {
  PairMarkings<System, Set> markings(system);
  ParallelBreadthFirst<System, Set> search(system, limits, options.threads);
  SpaceReport report = taken_from(search.run(markings), markings);
  report.markings =
      markings.count([&](Word pair) { return search.is_visited(pair); });
  return report;
}

template <PairSystem System>
SpaceReport measured_on_disk(System& system, const SpaceOptions& options,
                             const Limits& limits) {
  const Scratch scratch = options.scratch.within(limits.max_bytes);
  DiskMarkings<System> markings(system, scratch,
                                scratch.words_within(limits.max_bytes / 16));
  DiskBreadthFirst<System> search(system, limits, options.threads, scratch);
  SpaceReport report = taken_from(search.run(markings), markings);
  try {
    report.markings = markings.count(search.visited());
  } catch (const ScratchFault&) {
    report.result.stopped = StopReason::Disk;
    report.result.is_complete = false;
  }
  return report;
}

template <PairSystem System>
SpaceReport measured_in_parallel(System& system, const SpaceOptions& options,
                                 const Limits& limits) {
  const SpaceReport report =
      options.store == StateSetKind::Exact
          ? measured_in<ExactPairSet>(system, options, limits)
          : measured_in<CompressedPairSet>(system, options, limits);
  return report.result.stopped == StopReason::Memory &&
                 !options.scratch.folder.empty()
             ? measured_on_disk(system, options, limits)
             : report;
}

// With nothing to be observed: as far as any search is reduced.
SpaceReport measure_reduced(const Network& network, const SpaceOptions& options,
                            const Limits& limits) {
  const CompiledNetwork system(network);
  const SearchedNetwork searched(system, Observed(network), options.reduce);
  const ReducedNetwork& reduced = searched.system();
  if (options.search == SearchOrder::DepthFirst) {
    DepthFirst search(reduced, limits);
    Markings markings(reduced.network());
    SpaceReport report;
    report.vector_bits = reduced.network().layout().bits;
    report.result = search.run(markings);
    report.markings = markings.count(search.store());
    report.dead_states = markings.dead();
    report.bytes = report.result.progress.bytes - markings.bytes();
    return report;
  }
  InternedSystem interned(reduced, reduced.network());
  SpaceReport report = measured_in_parallel(interned, options, limits);
  report.vector_bits = reduced.network().layout().bits;
  return report;
}

}  // namespace

SpaceReport measure_space(const Network& network, const SpaceOptions& options,
                          const Limits& limits) {
  if (options.search == SearchOrder::DepthFirst ||
      options.reduce != Reduction::None) {
    return measure_reduced(network, options, limits);
  }
  const std::size_t cut = best_cut(CompiledNetwork(network), options.threads);
  const CompiledNetwork system(network, StateLayout(network, cut));
  SplitNetwork split(system);
  SpaceReport report = measured_in_parallel(split, options, limits);
  report.vector_bits = system.layout().bits;
  return report;
}

}  // namespace btcheck
