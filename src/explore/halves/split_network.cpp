// SPDX-License-Identifier: MIT
//
// A half's successors are computed when the first state with that half is
// expanded, so hardly any half is stored that no state has. (The exception: a
// due timer of the other half may forbid the step.) Steps of both halves, and
// steps of time, are computed one by one, for the same reason.
#include "explore/halves/split_network.hpp"

#include <algorithm>
#include <cassert>

namespace btcheck {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 16;  // words of a list block

}  // namespace

// A half's steps, under construction.
struct SplitNetwork::Opened {
  Half half = Half::Low;
  StateVector next;  // the half in its place, to be written to
  std::vector<std::uint32_t> own;
  std::vector<FarMove> far;
  std::uint32_t flags = 0;
};

SplitNetwork::SplitNetwork(const CompiledNetwork& system)
    : system_(system),
      edges_(system.network(), system.layout()),
      is_untimed_(system.network().ticks == TickSemantics::None),
      states_(system.word_count()) {
  const Network& network = system.network();
  if (network.fault) {
    fault_ = system.layout().fields[index(*network.fault)];
  }
}

std::uint32_t SplitNetwork::interned_half(Half half, const Word* state) {
  const std::size_t first = half == Half::Low ? 0 : system_.layout().low_words;
  const std::uint32_t id = states_.half(half).intern(state + first);
  moves_[index(half)].reach(id);
  return id;
}

Word SplitNetwork::interned(StateView state, std::optional<Word> near) {
  const Word pair = near ? states_.intern(state, *near) : states_.intern(state);
  moves_[0].reach(low_of(pair));
  moves_[1].reach(high_of(pair));
  return pair;
}

// Copies a half to its place in the worker's state. The other half's words are
// left as they are: nobody reads them.
void SplitNetwork::load_half(Half half, std::uint32_t id,
                             Worker& worker) const {
  const HalfDictionary& halves = states_.half(half);
  const std::size_t first = half == Half::Low ? 0 : system_.layout().low_words;
  std::copy(halves[id], halves[id] + halves.words(),
            worker.state.begin() + static_cast<std::ptrdiff_t>(first));
}

std::uint32_t SplitNetwork::computed_after(Half half, std::uint32_t id,
                                           std::uint32_t effect,
                                           Worker& worker) {
  load_half(half, id, worker);
  edges_.apply(effect, worker.state.data());
  return interned_half(half, worker.state.data());
}

std::uint32_t SplitNetwork::computed_later(Half half, std::uint32_t id,
                                           Worker& worker) {
  load_half(half, id, worker);
  Word* state = worker.state.data();
  for (const SplitAutomaton& automaton : edges_.automata()) {
    if (automaton.half != half || !automaton.clock) continue;
    const int greatest = automaton.greatest_clock[automaton.present(state)];
    const std::int64_t now = automaton.clock->get(state);
    if (now < greatest) automaton.clock->put(state, now + 1);
  }
  const std::uint32_t later = interned_half(half, state);
  moves_[index(half)][id]->later.store(later + 1, std::memory_order_release);
  return later;
}

std::uint32_t SplitNetwork::computed_clockless(Half half, std::uint32_t id,
                                               Worker& worker) {
  std::atomic<std::uint32_t>& known = moves_[index(half)][id]->clockless;
  const std::uint32_t stored = known.load(std::memory_order_acquire);
  if (stored != 0) return stored - 1;
  load_half(half, id, worker);
  system_.clear_clocks(worker.state);
  const std::uint32_t cleared = interned_half(half, worker.state.data());
  known.store(cleared + 1, std::memory_order_release);
  return cleared;
}

Word SplitNetwork::without_clocks(Word pair, Worker& worker) {
  return pair_of(computed_clockless(Half::Low, low_of(pair), worker),
                 computed_clockless(Half::High, high_of(pair), worker));
}

void SplitNetwork::open(Half half, std::uint32_t id, HalfMoves& moves,
                        Worker& worker) {
  const std::lock_guard<std::mutex> lock(opening_[id % opening_.size()]);
  if (moves.own.load(std::memory_order_acquire) != nullptr) return;
  load_half(half, id, worker);
  const StateVector& state = worker.state;
  Opened opened;
  opened.half = half;
  opened.next = state;
  if (fault_ && system_.layout().half_of(*fault_) == half &&
      fault_->get(state.data()) != 0) {
    opened.flags |= kFault;
  } else if (!open_due_timers(half, state, opened)) {
    for (const SplitAutomaton& automaton : edges_.automata()) {
      if (automaton.half == half) open_edges(automaton, state, opened);
    }
  }
  moves.met = edges_.met(half, state.data());
  keep(opened, moves);
}

bool SplitNetwork::open_due_timers(Half half, const StateVector& state,
                                   Opened& opened) {
  for (const SplitAutomaton& automaton : edges_.automata()) {
    if (automaton.half != half || !automaton.is_timer || !automaton.clock) {
      continue;
    }
    const std::int64_t clock = automaton.clock->get(state.data());
    for (const SplitEdge& edge :
         automaton.edges[automaton.present(state.data())]) {
      if (edge.upper != clock) continue;
      opened.flags |= kDue;
      if (edge.reach != EdgeReach::Own) {
        opened.flags |= kDueFar;
        continue;
      }
      opened.next = state;
      edges_.apply(edge.effect, opened.next.data());
      opened.own.push_back(interned_half(half, opened.next.data()));
    }
  }
  return (opened.flags & kDue) != 0;
}

void SplitNetwork::open_edges(const SplitAutomaton& automaton,
                              const StateVector& state, Opened& opened) {
  if (automaton.gate && automaton.gate->get(state.data()) == 0) return;
  const std::size_t here = automaton.present(state.data());
  const std::int64_t clock = automaton.greatest_clock[here] > 0
                                 ? automaton.clock->get(state.data())
                                 : 0;
  for (const SplitEdge& edge : automaton.edges[here]) {
    if (!edges_.holds(edge, state.data()) || clock < edge.lower) continue;
    const bool is_urgent = clock == edge.upper;
    switch (edge.reach) {
      case EdgeReach::Own:
        opened.next = state;
        edges_.apply(edge.effect, opened.next.data());
        opened.own.push_back(interned_half(opened.half, opened.next.data()));
        if (is_urgent) opened.flags |= kUrgent;
        break;
      case EdgeReach::Both:
        opened.far.push_back({edge.effect, edge.far_effect,
                              static_cast<std::uint16_t>(edge.far_guard),
                              is_urgent});
        break;
      case EdgeReach::Mixed:
        opened.flags |= kMixed;
        break;
    }
  }
}

// One list: own moves, then those of both halves. Told to others last.
void SplitNetwork::keep(const Opened& opened, HalfMoves& moves) {
  constexpr std::size_t kPerMove = sizeof(FarMove) / sizeof(std::uint32_t);
  static_assert(alignof(FarMove) == alignof(std::uint32_t));
  const std::size_t length = opened.own.size() + opened.far.size() * kPerMove;
  std::uint32_t* list = nullptr;
  {
    const std::lock_guard<std::mutex> lock(keeping_);
    if (blocks_.empty() || block_used_ + length > kBlock) {
      blocks_.push_back(
          std::make_unique<std::uint32_t[]>(std::max(kBlock, length)));
      block_used_ = 0;
    }
    list = blocks_.back().get() + block_used_;
    block_used_ += length;
  }
  std::uint32_t* end = std::copy(opened.own.begin(), opened.own.end(), list);
  std::copy(opened.far.begin(), opened.far.end(),
            reinterpret_cast<FarMove*>(end));
  moves.own_count = static_cast<std::uint16_t>(opened.own.size());
  moves.far_count = static_cast<std::uint16_t>(opened.far.size());
  moves.flags = opened.flags;
  moves.own.store(list, std::memory_order_release);
}

std::size_t SplitNetwork::bytes() const {
  const HalfCounts counts = states_.counts();
  return states_.bytes() + moves_[0].bytes(counts.low) +
         moves_[1].bytes(counts.high) +
         blocks_.size() * kBlock * sizeof(std::uint32_t);
}

}  // namespace btcheck
