// SPDX-License-Identifier: MIT
//
// A network whose successors are looked up half by half.
//
// Most edges read and write one half of the state vector, so what they do is
// computed once for each half, not for each state, and halves are a hundred
// times fewer: the successors of a state are the successors of its low half
// beside its high one, and the other way round. An edge that reads or writes
// both halves is split (split_edge.hpp): each half knows which of its own such
// edges are open and, as bits, which conditions of the other's it meets. Time
// passes in both halves at once. (The idea is LTSmin's, which caches next-state
// calls by the variables they depend on: Blom, van de Pol, Weber 2010; here the
// parts are two, fixed, and numbered, and a state is the pair of its numbers.)
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "explore/halves/half_dictionary.hpp"
#include "explore/halves/split_edge.hpp"
#include "explore/state/step.hpp"

namespace btcheck {

// The network of `system` over pairs of half numbers (pair_coding.hpp). May be
// used by several threads, each with a Worker of its own. The system must
// outlive it.
class SplitNetwork {
 public:
  explicit SplitNetwork(const CompiledNetwork& system);

  // What a thread needs for itself: a state under construction, and effects
  // on halves that it has computed lately.
  struct Worker {
    explicit Worker(const SplitNetwork& network)
        : state(network.word_count()), effects(kEffects) {}

    static constexpr std::size_t kEffects = std::size_t{1} << 14;
    struct KnownEffect {
      Word key = 0;  // the effect and the half's number
      std::uint32_t target = 0;
    };
    StateVector state;
    std::vector<KnownEffect> effects;
  };

  std::size_t word_count() const { return states_.word_count(); }
  const CompiledNetwork& system() const { return system_; }

  template <class Found>
  void initial_states(Worker&, Found&& found) {
    system_.initial_states(
        [&](StateView state) { found(interned(state, std::nullopt)); });
  }

  // Calls stepped(target) for each step of CompiledNetwork::successors but the
  // idle one that leads back.
  template <class Stepped>
  void successors(Word pair, Worker& worker, Stepped&& stepped) {
    const HalfMoves& low = moves_of(Half::Low, low_of(pair), worker);
    const HalfMoves& high = moves_of(Half::High, high_of(pair), worker);
    const std::uint32_t flags = low.flags | high.flags;
    if ((flags & kExceptional) != 0) {
      exceptional_successors(pair, low, high, stepped);
      return;
    }
    own_successors(pair, low, high, stepped);
    std::uint32_t urgent = flags & kUrgent;
    for (const FarMove& move : low.far_moves()) {
      if ((high.met >> move.guard & 1) == 0) continue;
      urgent |= move.is_urgent;
      stepped(
          pair_of(after(Half::Low, low_of(pair), move.effect, worker),
                  after(Half::High, high_of(pair), move.far_effect, worker)));
    }
    for (const FarMove& move : high.far_moves()) {
      if ((low.met >> move.guard & 1) == 0) continue;
      urgent |= move.is_urgent;
      stepped(pair_of(after(Half::Low, low_of(pair), move.far_effect, worker),
                      after(Half::High, high_of(pair), move.effect, worker)));
    }
    if (urgent != 0 || is_untimed_) return;
    const Word later = pair_of(later_half(Half::Low, low_of(pair), worker),
                               later_half(Half::High, high_of(pair), worker));
    if (later != pair) stepped(later);
  }

  // The same state with every clock at 0.
  Word without_clocks(Word pair, Worker& worker);

  // Prefetches what `successors` reads first.
  void prefetch(Word pair) const {
    __builtin_prefetch(moves_[0][low_of(pair)]);
    __builtin_prefetch(moves_[1][high_of(pair)]);
  }
  void load(Word pair, Word* out) const { states_.load(pair, out); }

  HalfCounts counts() const { return states_.counts(); }
  std::size_t bytes() const;

 private:
  // An edge of one half, open as far as that half knows.
  struct FarMove {
    std::uint32_t effect;
    std::uint32_t far_effect;
    std::uint16_t guard;
    std::uint16_t is_urgent;  // 1 where it has reached its deadline
  };
  // What a half does. All of it is known when `own` is not null.
  struct HalfMoves {
    // Numbers of halves: own steps; when timers are due, only theirs.
    std::atomic<const std::uint32_t*> own;
    Word met;                          // conditions of the other half's edges
    std::atomic<std::uint32_t> later;  // a unit of time later, plus 1; 0: ask
    std::atomic<std::uint32_t> clockless;  // with its clocks at 0, plus 1
    std::uint16_t own_count;
    std::uint16_t far_count;
    std::uint32_t flags;

    std::span<const std::uint32_t> own_moves() const {
      return {own.load(std::memory_order_relaxed), own_count};
    }
    std::span<const FarMove> far_moves() const {
      return {reinterpret_cast<const FarMove*>(own_moves().data() + own_count),
              far_count};
    }
  };
  enum Flag : std::uint32_t {
    kUrgent = 1,  // an open edge has reached its deadline
    kFault = 2,
    kDue = 4,     // a timer is due
    kDueFar = 8,  // and its edge is not the half's alone
    kMixed = 16,  // a mixed edge may be open
    kExceptional = kFault | kDue | kMixed
  };
  struct Opened;

  const HalfMoves& moves_of(Half half, std::uint32_t id, Worker& worker) {
    HalfMoves& moves = *moves_[index(half)][id];
    if (moves.own.load(std::memory_order_acquire) == nullptr) {
      open(half, id, moves, worker);
    }
    return moves;
  }

  template <class Stepped>
  static void own_successors(Word pair, const HalfMoves& low,
                             const HalfMoves& high, Stepped& stepped) {
    for (const std::uint32_t target : low.own_moves()) {
      stepped(pair_of(target, high_of(pair)));
    }
    for (const std::uint32_t target : high.own_moves()) {
      stepped(pair_of(low_of(pair), target));
    }
  }
  template <class Stepped>
  void exceptional_successors(Word pair, const HalfMoves& low,
                              const HalfMoves& high, Stepped& stepped) {
    const std::uint32_t flags = low.flags | high.flags;
    if ((flags & kFault) != 0) return;
    if ((flags & kDue) != 0 && (flags & kDueFar) == 0) {
      const HalfMoves none{};
      own_successors(pair, (low.flags & kDue) != 0 ? low : none,
                     (high.flags & kDue) != 0 ? high : none, stepped);
      return;
    }
    StateVector state(word_count());
    load(pair, state.data());
    system_.successors(state, [&](StateView target, Step step) {
      const Word to = interned(target, pair);
      if (step.edge != kTimeStep || to != pair) stepped(to);
    });
  }

  // The half after an effect on it.
  std::uint32_t after(Half half, std::uint32_t id, std::uint32_t effect,
                      Worker& worker) {
    if (effect == 0) return id;
    const Word key = Word{effect} << 32 | id;
    auto& known = worker.effects[(key * 0x9e3779b97f4a7c15ull) >> 50];
    if (known.key != key) {
      known = {key, computed_after(half, id, effect, worker)};
    }
    return known.target;
  }
  std::uint32_t later_half(Half half, std::uint32_t id, Worker& worker) {
    const std::uint32_t known =
        moves_[index(half)][id]->later.load(std::memory_order_relaxed);
    return known != 0 ? known - 1 : computed_later(half, id, worker);
  }

  Word interned(StateView state, std::optional<Word> near);
  std::uint32_t interned_half(Half half, const Word* state);
  void load_half(Half half, std::uint32_t id, Worker& worker) const;
  std::uint32_t computed_after(Half half, std::uint32_t id,
                               std::uint32_t effect, Worker& worker);
  std::uint32_t computed_later(Half half, std::uint32_t id, Worker& worker);
  std::uint32_t computed_clockless(Half half, std::uint32_t id, Worker& worker);
  void open(Half half, std::uint32_t id, HalfMoves& moves, Worker& worker);
  bool open_due_timers(Half half, const StateVector& state, Opened& opened);
  void open_edges(const SplitAutomaton& automaton, const StateVector& state,
                  Opened& opened);
  void keep(const Opened& opened, HalfMoves& moves);

  const CompiledNetwork& system_;
  SplitEdges edges_;
  bool is_untimed_;
  std::optional<Field> fault_;
  PairDictionary states_;
  ChunkedArray<HalfMoves> moves_[2];
  std::array<std::mutex, 64> opening_;  // by number of the half
  std::mutex keeping_;
  std::vector<std::unique_ptr<std::uint32_t[]>> blocks_;  // of lists
  std::size_t block_used_ = 0;
};

}  // namespace btcheck
