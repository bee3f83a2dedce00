// SPDX-License-Identifier: MIT
//
// Reachability, breadth first and depth first. One search serves any number of
// questions: a visitor is shown each state and each step and says when it has
// seen enough.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "explore/search/stored_run.hpp"
#include "explore/state/limits.hpp"
#include "explore/state/transition_system.hpp"
#include "explore/store/growing_array.hpp"
#include "explore/store/search_threads.hpp"
#include "explore/store/state_store.hpp"

namespace btcheck {

enum class SearchOrder : std::uint8_t { BreadthFirst, DepthFirst };

// Watches a search. A visitor derives from this and redefines the members it
// needs.
struct ReachabilityVisitor {
  // Of a system whose steps stand for several (reduced_network.hpp): a single
  // one, on the way from the state that is expanded next or soon.
  void passed(StateId /*from*/, StateView /*before*/, Step) {}
  // Whether `passed` has anything to do for such a step, as things are; asked
  // by several threads at once. Goes with `passed`.
  bool is_heard(Step) const { return false; }
  // A step from the state being expanded. The target is stored already.
  void stepped(StateId /*from*/, Step, StateId /*to*/) {}
  // A state with all its steps known. `is_dead`: none but an idle one.
  GoOn expanded(StateId, StateView, bool /*is_dead*/) { return GoOn::Yes; }
  // Memory held by the visitor, for the limit.
  std::size_t bytes() const { return 0; }
};

struct ReachabilityResult {
  StopReason stopped = StopReason::None;
  bool is_complete = false;  // every reachable state was expanded
  SearchProgress progress;
};

// The visited set, who was reached from whom, the limits, and telling a path.
template <TransitionSystem System>
class Reachability {
 public:
  // Both must outlive the search.
  Reachability(const System& system, const Limits& limits)
      : system_(system), limits_(limits), store_(system.word_count()) {}

  const StateStore& store() const { return store_; }
  const BreadthFirstTree& tree() const { return tree_; }

  // The run on which the search reached an expanded state.
  std::vector<RunState> path_to(StateId state) const {
    return run_along(tree_.path_to(state));
  }

  // The run over stored states each of which follows from the one before.
  std::vector<RunState> run_along(std::span<const StateId> states) const {
    return btcheck::run_along(system_, store_, states);
  }

 protected:
  template <class Stored>
  void store_initial(Stored stored) {
    system_.initial_states(
        [&](StateView state) { stored(store_.insert(state).id); });
  }

  // A stored state with its successors computed but not stored yet.
  struct Expansion {
    struct Successor {
      StateStore::Key key;
      Step step;
    };
    StateId state{};
    StateVector words;
    std::vector<Successor> successors;
    // What a thread has found that may not touch the store: the targets of the
    // steps, and the states before those single ones that the visitor hears of,
    // one behind the other.
    std::vector<Step> steps;
    std::vector<Word> targets;
    std::vector<Step> heard;
    std::vector<Word> before;
  };

  // The first half of an expansion. Between the halves the memory that the
  // second will need is on its way.
  template <class Visitor>
  void compute(StateId state, Expansion& expansion, Visitor& visitor) {
    begin_expansion(state, expansion);
    expand(
        expansion,
        [&](StateView target, Step step, auto&&...) {
          offer(expansion, target, step);
        },
        [&](StateView before, Step step, StateView) {
          visitor.passed(state, before, step);
        });
  }

  // The same in two parts. The first only reads, and several threads may do it
  // at once for different expansions.
  template <class Visitor>
  void compute_apart(StateId state, Expansion& expansion,
                     const Visitor& visitor) const {
    begin_expansion(state, expansion);
    expansion.steps.clear();
    expansion.targets.clear();
    expansion.heard.clear();
    expansion.before.clear();
    expand(
        expansion,
        [&](StateView target, Step step, auto&&...) {
          expansion.steps.push_back(step);
          append(target, expansion.targets);
        },
        [&](StateView before, Step step, StateView) {
          if (!visitor.is_heard(step)) return;
          expansion.heard.push_back(step);
          append(before, expansion.before);
        });
  }
  template <class Visitor>
  void take_over(Expansion& expansion, Visitor& visitor) {
    const std::size_t words = system_.word_count();
    const auto vector = [&](const std::vector<Word>& from, std::size_t i) {
      return StateView(from).subspan(i * words, words);
    };
    for (std::size_t i = 0; i < expansion.heard.size(); ++i) {
      visitor.passed(expansion.state, vector(expansion.before, i),
                     expansion.heard[i]);
    }
    for (std::size_t i = 0; i < expansion.steps.size(); ++i) {
      offer(expansion, vector(expansion.targets, i), expansion.steps[i]);
    }
  }

  void prefetch(const Expansion& expansion) const {
    for (const auto& successor : expansion.successors) {
      store_.prefetch_pair(successor.key);
    }
  }

  // The second half: stores the successors; `arrived(target, is_new)` for each.
  template <class Visitor, class Arrived>
  GoOn commit(const Expansion& expansion, Visitor& visitor, Arrived arrived) {
    bool is_dead = true;
    for (const auto& [key, step] : expansion.successors) {
      const auto [id, is_new] = store_.insert(key);
      arrived(id, is_new);
      if (step.edge != kTimeStep || id != expansion.state) {
        is_dead = false;
        ++progress_.transitions;
      }
      visitor.stepped(expansion.state, step, id);
    }
    return visitor.expanded(expansion.state, expansion.words, is_dead);
  }

  template <class Visitor>
  bool may_go_on(std::uint64_t expanded, const Visitor& visitor,
                 std::size_t own_bytes) {
    update_progress(expanded, visitor, own_bytes);
    stopped_ = limits_.reached(progress_);
    if (progress_.states >= kMostStates) stopped_ = StopReason::MaxStates;
    return stopped_ == StopReason::None;
  }

  template <class Visitor>
  ReachabilityResult result(std::uint64_t expanded, const Visitor& visitor,
                            std::size_t own_bytes, bool is_exhausted) {
    update_progress(expanded, visitor, own_bytes);
    return {stopped_, is_exhausted && stopped_ == StopReason::None, progress_};
  }

  const System& system_;
  const Limits& limits_;
  StateStore store_;
  BreadthFirstTree tree_;
  SearchProgress progress_;

 private:
  static constexpr std::uint64_t kMostStates = UINT32_MAX - kPollInterval * 64;

  void begin_expansion(StateId state, Expansion& expansion) const {
    expansion.state = state;
    expansion.words.resize(system_.word_count());
    expansion.successors.clear();
    store_.load(state, expansion.words);
  }

  template <class Stepped, class Passed>
  void expand(const Expansion& expansion, Stepped&& stepped,
              Passed&& passed) const {
    if constexpr (requires {
                    system_.successors(expansion.words, stepped, passed);
                  }) {
      system_.successors(expansion.words, stepped, passed);
    } else {
      system_.successors(expansion.words, stepped);
    }
  }

  void offer(Expansion& expansion, StateView target, Step step) {
    const StateStore::Key key = store_.key(target, expansion.state);
    store_.prefetch_slot(key);
    expansion.successors.push_back({key, step});
  }

  static void append(StateView vector, std::vector<Word>& to) {
    to.insert(to.end(), vector.begin(), vector.end());
  }

  template <class Visitor>
  void update_progress(std::uint64_t expanded, const Visitor& visitor,
                       std::size_t own_bytes) {
    progress_.states = store_.size();
    progress_.expanded = expanded;
    progress_.bytes =
        store_.bytes() + tree_.bytes() + visitor.bytes() + own_bytes;
  }

  StopReason stopped_ = StopReason::None;
};

// Reachability, breadth first: every path it tells is a shortest one.
//
// States are numbered as they are found, so the queue is the range of numbers
// not yet expanded. They are expanded in small batches: first the successors of
// all are computed, then they are looked up, so that the waits for memory,
// which at some million states are most of the time, overlap. States are found
// in the same order as one by one, also where several threads compute the
// successors of larger batches: that pays where a step is dear, as a chain of a
// reduction is, and not where it is as cheap as looking it up.
template <TransitionSystem System>
class BreadthFirst : public Reachability<System> {
 public:
  BreadthFirst(const System& system, const Limits& limits, unsigned threads = 1)
      : Reachability<System>(system, limits), thread_count_(threads) {}

  // To be called once.
  template <class Visitor>
  ReachabilityResult run(Visitor& visitor) {
    this->store_initial(
        [&](StateId state) { this->tree_.reach(state, state); });
    level_end_ = this->store_.size();
    while (next_ < this->store_.size()) {
      if (!expand_batch(visitor)) break;
    }
    return this->result(next_, visitor, 0, next_ == this->store_.size());
  }

 private:
  using Expansion = typename Reachability<System>::Expansion;
  static constexpr std::size_t kBatch = 32;
  static constexpr std::size_t kBatchOfThreads = 512;
  static constexpr std::size_t kWorthSharing = 128;
  static constexpr std::size_t kShare = 16;  // that a thread takes at once
  // Before so many states are expanded nobody is woken.
  static constexpr std::size_t kShort = std::size_t{1} << 14;

  // Expands the next states in order; false when the search is to end.
  template <class Visitor>
  bool expand_batch(Visitor& visitor) {
    if (next_ >= next_poll_) {
      next_poll_ = next_ + kPollInterval;
      if (!this->may_go_on(next_, visitor, 0)) return false;
    }
    const std::size_t count = compute_batch(visitor);
    for (std::size_t i = 0; i < count; ++i) this->prefetch(batch_[i]);
    for (std::size_t i = 0; i < count; ++i) {
      if (next_ == level_end_) {
        level_end_ = this->store_.size();
        ++this->progress_.depth;
      }
      const StateId state{next_++};
      const GoOn go_on =
          this->commit(batch_[i], visitor, [&](StateId target, bool is_new) {
            if (is_new) this->tree_.reach(target, state);
          });
      if (go_on == GoOn::No) return false;
    }
    return true;
  }

  // The successors of the next states; answers of how many.
  template <class Visitor>
  std::size_t compute_batch(Visitor& visitor) {
    // The limits are asked in the same states, whoever computes.
    const auto waiting = static_cast<std::size_t>(
        std::min<std::uint64_t>(this->store_.size(), next_poll_) - next_);
    const bool is_shared =
        thread_count_ > 1 && next_ >= kShort && waiting >= kWorthSharing;
    const std::size_t count =
        std::min(is_shared ? kBatchOfThreads : kBatch, waiting);
    batch_.resize(std::max(batch_.size(), count));
    if (is_shared) {
      compute_shared(count, visitor);
    } else {
      for (std::size_t i = 0; i < count; ++i) {
        this->compute(waiting_state(i), batch_[i], visitor);
      }
    }
    return count;
  }

  template <class Visitor>
  void compute_shared(std::size_t count, Visitor& visitor) {
    static_assert(hears_all<Visitor>());
    if (!threads_) threads_.emplace(thread_count_);
    std::atomic<std::size_t> taken = 0;
    threads_->each([&](std::size_t) {
      for (std::size_t first; (first = taken.fetch_add(kShare)) < count;) {
        const std::size_t last = std::min(first + kShare, count);
        for (std::size_t i = first; i < last; ++i) {
          this->compute_apart(waiting_state(i), batch_[i],
                              std::as_const(visitor));
        }
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      this->take_over(batch_[i], visitor);
    }
  }

  // Whether a visitor that redefines `passed` says what it hears of.
  template <class Visitor>
  static constexpr bool hears_all() {
    using Base = ReachabilityVisitor;
    return std::is_same_v<decltype(&Visitor::passed),
                          decltype(&Base::passed)> ||
           !std::is_same_v<decltype(&Visitor::is_heard),
                           decltype(&Base::is_heard)>;
  }

  StateId waiting_state(std::size_t i) const {
    return StateId{next_ + static_cast<std::uint32_t>(i)};
  }

  unsigned thread_count_;
  std::optional<SearchThreads> threads_;
  std::vector<Expansion> batch_;
  std::uint32_t next_ = 0;       // the state to be expanded next
  std::uint64_t next_poll_ = 0;  // when to ask the limits
  std::size_t level_end_ = 0;    // one past the last state of this depth
};

template <class System>
BreadthFirst(const System&, const Limits&, unsigned = 1)
    -> BreadthFirst<System>;

// Reachability, depth first: goes deep at once, where breadth-first first sees
// everything near. Finds some run, not a shortest one.
//
// A state's successors are stored when it is entered and wait on a stack; the
// one on top is entered next unless it has been entered meanwhile. The parent
// of a state is the one it was entered from.
template <TransitionSystem System>
class DepthFirst : public Reachability<System> {
 public:
  using Reachability<System>::Reachability;

  // To be called once.
  template <class Visitor>
  ReachabilityResult run(Visitor& visitor) {
    this->store_initial([&](StateId state) {
      waiting_.push_back({state, state, 0});
    });
    while (!waiting_.empty()) {
      const Waiting next = waiting_.back();
      waiting_.pop_back();
      if (!this->tree_.reach(next.state, next.from)) continue;
      if (expanded_ % kPollInterval == 0 &&
          !this->may_go_on(expanded_, visitor, waiting_.bytes())) {
        break;
      }
      ++expanded_;
      this->progress_.depth =
          std::max<std::uint64_t>(this->progress_.depth, next.depth);
      this->compute(next.state, expansion_, visitor);
      const GoOn go_on =
          this->commit(expansion_, visitor, [&](StateId target, bool is_new) {
            // One that is stored but not entered yet may as well be entered
            // from here.
            if (is_new || !this->tree_.is_reached(target)) {
              waiting_.push_back({target, next.state, next.depth + 1});
            }
          });
      if (go_on == GoOn::No) {
        waiting_.push_back(next);
        break;
      }
    }
    return this->result(expanded_, visitor, waiting_.bytes(), waiting_.empty());
  }

 private:
  struct Waiting {
    StateId state;
    StateId from;
    std::uint32_t depth;
  };

  GrowingArray<Waiting> waiting_;
  typename Reachability<System>::Expansion expansion_;
  std::uint64_t expanded_ = 0;
};

template <class System>
DepthFirst(const System&, const Limits&) -> DepthFirst<System>;

}  // namespace btcheck
