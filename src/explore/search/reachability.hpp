// SPDX-License-Identifier: MIT
//
// What breadth-first and depth-first search share.
//
// States are numbered as they are found; beside the visited set a search only
// keeps the number of the state each was reached from (four bytes). One search
// serves any number of questions: a visitor is shown each state and each step
// and says when it has seen enough.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "explore/search/breadth_first_tree.hpp"
#include "explore/search/stored_run.hpp"
#include "explore/state/limits.hpp"
#include "explore/state/transition_system.hpp"
#include "explore/store/state_store.hpp"

namespace btcheck {

enum class SearchOrder : std::uint8_t { BreadthFirst, DepthFirst };

// What a search shows to who runs it. Every member may be hidden by one of the
// same name.
struct ReachabilityVisitor {
  // Of a system whose steps stand for several (reduced_network.hpp): a single
  // one, on the way from the state that is expanded next or soon.
  void passed(StateId /*from*/, StateView /*before*/, Step,
              StateView /*after*/) {}
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
  };

  // The first half of an expansion. Between the halves the memory that the
  // second will need is on its way; a search that computes many first halves
  // before the second ones hides most of what that takes.
  template <class Visitor>
  void compute(StateId state, Expansion& expansion, Visitor& visitor) {
    expansion.state = state;
    expansion.words.resize(system_.word_count());
    expansion.successors.clear();
    store_.load(state, expansion.words);
    const auto stepped = [&](StateView target, Step step) {
      const StateStore::Key key = store_.key(target, state);
      store_.prefetch_slot(key);
      expansion.successors.push_back({key, step});
    };
    const auto passed = [&](StateView before, Step step, StateView after) {
      visitor.passed(state, before, step, after);
    };
    if constexpr (requires {
                    system_.successors(expansion.words, stepped, passed);
                  }) {
      system_.successors(expansion.words, stepped, passed);
    } else {
      system_.successors(expansion.words, stepped);
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

}  // namespace btcheck
