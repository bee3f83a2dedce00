// SPDX-License-Identifier: MIT
//
// The waist: what a search needs to know of a system, and nothing more.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace btcheck {

using Word = std::uint64_t;
// One packed global state: word_count() words. Borrowed, or owned.
using StateView = std::span<const Word>;
using StateVector = std::vector<Word>;
template <class Buffer>
StateView view_of(const Buffer& words) {
  return {words.data(), words.size()};
}

// Dense number of a stored state, in order of discovery.
enum class StateId : std::uint32_t {};
constexpr std::uint32_t index(StateId id) {
  return static_cast<std::uint32_t>(id);
}

// The atomic propositions true in a state, one bit each.
using PropositionSet = std::uint64_t;
inline constexpr int kMaxPropositions = 64;

// A visitor's answer: whether the search should go on.
enum class GoOn : std::uint8_t { Yes, No };

inline constexpr std::uint32_t kTimeStep = 0xffffffff;

// How one state becomes the next.
struct Step {
  std::uint32_t edge = kTimeStep;  // number of the edge fired, or kTimeStep
  std::uint8_t elapsed = 0;        // units of time that pass: 0 or 1
  // False for a move of a free state variable. Only runs with infinitely many
  // steps of progress are runs (built-in justice).
  bool progress = true;

  friend bool operator==(const Step&, const Step&) = default;
};

// A Kripke structure with events and time. Every state has a successor: where
// nothing can happen any more, a step with edge kTimeStep leads back to the
// same state (an idle step). `successors` must not keep the views it hands
// out: they die with the call.
template <class System>
concept TransitionSystem = requires(const System& system, StateView state,
                                    void (*found)(StateView),
                                    void (*stepped)(StateView, Step)) {
  { system.word_count() } -> std::convertible_to<std::size_t>;
  system.initial_states(found);
  system.successors(state, stepped);
  { system.label(state) } -> std::convertible_to<PropositionSet>;
};

// A state together with the step that leads to it (the first state of a run
// has no such step; its Step is meaningless).
struct RunState {
  StateVector state;
  Step step;
};

// An infinite run: the prefix, then the cycle for ever. The first state of the
// cycle is reached from the last of the prefix; the cycle's first state is
// also a successor of the cycle's last, by `closing`. The prefix is never
// empty: it begins with an initial state.
struct Lasso {
  std::vector<RunState> prefix;
  std::vector<RunState> cycle;  // empty: a finite run (a safety violation)
  Step closing;
};

}  // namespace btcheck
