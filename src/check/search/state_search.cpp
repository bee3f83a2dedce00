// SPDX-License-Identifier: MIT
//
// In a small search a path is followed back. A large one is done in parallel,
// where a path is found by expanding its depths once more. What has no room in
// memory goes to disk, if there is a folder for it.
#include <algorithm>
#include <utility>

#include "check/search/searches.hpp"
#include "explore/halves/interned_system.hpp"
#include "explore/halves/split_network.hpp"
#include "explore/large/disk_breadth_first.hpp"
#include "explore/large/parallel_breadth_first.hpp"
#include "explore/large/state_questions.hpp"
#include "explore/reduce/labels.hpp"
#include "explore/search/reachability.hpp"
#include "explore/search/stored_run.hpp"

namespace btcheck {
namespace {

// Notes the first state that meets each predicate.
struct FirstStates : public ReachabilityVisitor {
  FirstStates(const ReducedNetwork& system,
              const std::vector<StatePredicate>& predicates,
              const std::vector<std::size_t>& asked)
      : labels(system, predicates), open(asked), first(predicates.size()) {}

  GoOn expanded(StateId id, StateView state, bool is_dead) {
    std::erase_if(open, [&](std::size_t question) {
      if (!labels.holds(question, state, is_dead)) return false;
      first[question] = id;
      return true;
    });
    return open.empty() ? GoOn::No : GoOn::Yes;
  }

  LabelledNetwork labels;
  std::vector<std::size_t> open;  // not met so far
  std::vector<std::optional<StateId>> first;
};

// One search for all questions, and what came of them.
class StateSearches {
 public:
  StateSearches(const ReducedNetwork& system,
                const std::vector<StatePredicate>& predicates,
                std::vector<std::size_t> asked, const TakeRun& take)
      : system_(system),
        predicates_(predicates),
        open_(std::move(asked)),
        take_(take) {
    answers_.met.resize(predicates.size());
  }

  bool is_done() const { return open_.empty(); }
  const ReachabilityResult& result() const { return answers_.result; }
  StateAnswers take() { return std::move(answers_); }

  template <class Search>
  void run(Search search) {
    FirstStates visitor(system_, predicates_, open_);
    answers_.result = search.run(visitor);
    for (const std::size_t question : open_) {
      if (const auto& state = visitor.first[question]) {
        is_met(question, [&] { return Lasso{search.path_to(*state), {}, {}}; });
      }
    }
    open_ = visitor.open;
  }

  void run_in_parallel(const SearchChoices& how, const Limits& limits) {
    if (system_.is_reduced()) {
      InternedSystem interned(system_, system_.network());
      run_over(interned, how, limits);
    } else {
      SplitNetwork split(system_.network());
      run_over(split, how, limits);
    }
  }

 private:
  template <class System>
  void run_over(System& system, const SearchChoices& how,
                const Limits& limits) {
    ask(system, ParallelBreadthFirst<System, CompressedPairSet>(
                    system, limits, how.threads, KeepDepths::Yes));
    if (answers_.result.stopped != StopReason::Memory ||
        how.scratch.folder.empty()) {
      return;
    }
    try {
      ask(system, DiskBreadthFirst<System>(system, limits, how.threads,
                                           how.scratch, KeepDepths::Yes));
    } catch (const ScratchFault&) {  // while a run was told
      answers_.result.stopped = StopReason::Disk;
      answers_.result.is_complete = false;
    }
  }

  template <class System, class Search>
  void ask(System& system, Search&& search) {
    const LabelledNetwork labels(system_, predicates_);
    StateQuestions questions(system, open_.size(),
                             [&](std::size_t i, StateView state, bool is_dead) {
                               return labels.holds(open_[i], state, is_dead);
                             });
    answers_.result = search.run(questions).reachability;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      const auto& found = questions.answers()[i];
      if (!found) continue;
      is_met(open_[i], [&] {
        const auto pairs = search.path_to(found->pair, found->depth);
        const auto load = [&](Word pair, StateVector& words) {
          system.load(pair, words.data());
        };
        return Lasso{tell_run(system_, pairs, load), {}, {}};
      });
    }
  }

  void is_met(std::size_t question, const std::function<Lasso()>& run) {
    answers_.met[question] = true;
    if (take_) take_(question, run);
  }

  const ReducedNetwork& system_;
  const std::vector<StatePredicate>& predicates_;
  std::vector<std::size_t> open_;  // the questions not answered so far
  const TakeRun& take_;
  StateAnswers answers_;
};

}  // namespace

StateAnswers search_states(const ReducedNetwork& system,
                           const std::vector<StatePredicate>& predicates,
                           const std::vector<bool>& asked,
                           const SearchChoices& how, const Limits& limits,
                           const TakeRun& take) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < predicates.size(); ++i) {
    if (asked.empty() || asked[i]) open.push_back(i);
  }
  StateSearches searches(system, predicates, std::move(open), take);
  if (searches.is_done()) return searches.take();
  if (how.order == SearchOrder::DepthFirst) {
    searches.run(DepthFirst(system, limits));
    return searches.take();
  }
  Limits few = limits;
  few.max_states = std::min(limits.max_states, how.sequential_states);
  searches.run(
      BreadthFirst(system, few, system.is_reduced() ? how.threads : 1));
  const StopReason stopped = searches.result().stopped;
  const bool needs_more = (stopped == StopReason::MaxStates &&
                           few.max_states < limits.max_states) ||
                          stopped == StopReason::Memory;
  if (!searches.is_done() && needs_more) searches.run_in_parallel(how, limits);
  return searches.take();
}

}  // namespace btcheck
