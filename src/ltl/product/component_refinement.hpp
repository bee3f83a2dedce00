// SPDX-License-Identifier: MIT
//
// The part of a component in which a run can stay and be strongly fair.
//
// A component that requests a condition and nowhere grants it has no fair run
// through the states that request it. They are taken out, what remains falls
// into components, and each with every acceptance set is looked at in the same
// way, until one grants all that it requests (Lichtenstein and Pnueli, POPL
// 1985; Emerson and Lei 1987, for Streett automata). The first round needs the
// marks only; the steps of the states that stay are then asked for again.
//
// A component may be examined while it is still growing, so that a search can
// stop early (Duret-Lutz, Poitrenaud and Couvreur, ATVA 2009, carry the
// acceptance of each component along instead): each time the number of its
// states has doubled, and when it is complete.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "explore/state/limits.hpp"
#include "explore/store/state_store.hpp"
#include "ltl/product/fair_system.hpp"
#include "ltl/product/open_components.hpp"
#include "ltl/product/strong_fairness.hpp"

namespace btcheck {

// The open components with every acceptance set, outermost first.
class Candidates {
 public:
  // A cycle was closed in the innermost component, named by its root, and it
  // has every set.
  void closed_cycle(std::uint32_t root);

  // Whether that component, innermost and of `size` states, has doubled since
  // it was examined last; it counts as examined from now on.
  bool is_due(std::uint32_t root, std::size_t size);

  // The innermost component is complete: forgets it. True when it is one of
  // these and has changed since it was examined last.
  bool is_due_when_complete(std::uint32_t root);

  std::size_t bytes() const { return stack_.capacity() * sizeof(Candidate); }

 private:
  struct Candidate {
    std::uint32_t root;
    bool has_changed;
    std::size_t examined;  // its size then
  };

  std::vector<Candidate> stack_;
};

// States by number, each with its marks and its steps among them.
class MarkedGraph {
 public:
  struct Arc {
    std::uint32_t target;
    std::uint32_t sets;  // their number
  };

  void add_state(std::uint32_t marks);
  // A step of the state added last.
  void add_arc(std::uint32_t target, AcceptanceSet sets) {
    arcs_.push_back({target, set_numbers_.number(sets)});
  }

  std::size_t size() const { return marks_.size(); }
  std::uint32_t marks(std::uint32_t state) const { return marks_[state]; }
  std::span<const Arc> arcs(std::uint32_t state) const;
  AcceptanceSet sets(const Arc& arc) const { return set_numbers_[arc.sets]; }
  std::size_t bytes() const;

 private:
  std::vector<std::uint32_t> marks_;
  std::vector<std::uint64_t> first_;  // by state: its first arc
  std::vector<Arc> arcs_;
  SetNumbers set_numbers_;
};

// Asked every few thousand states whether to go on, with the bytes held.
using MayGoOn = std::function<bool(std::size_t bytes)>;

// Some states of a graph that are strongly connected by at least one step,
// have all sets and grant what they request. Empty when there are none, or
// when told not to go on.
std::vector<std::uint32_t> strongly_fair_part(const MarkedGraph& graph,
                                              const MarkTable& table,
                                              AcceptanceSet all_sets,
                                              const MayGoOn& may_go_on);

template <FairSystem System>
class ComponentRefinement {
 public:
  // All must outlive it. States met are stored already.
  ComponentRefinement(const System& system, StateStore& store,
                      StateMarks& marks)
      : system_(system), store_(store), marks_(marks) {}

  // A part, as above, of a strongly connected component with all sets and at
  // least one step. `place_of` tells the place of a state in `component`, or a
  // number that is none.
  template <class PlaceOf>
  std::vector<StateId> fair_part(std::span<const StateId> component,
                                 PlaceOf&& place_of, const MayGoOn& may_go_on) {
    ConditionTally tally(marks_.table());
    for (std::size_t i = 0; i < component.size(); ++i) {
      tally.add(marks_.number(component[i]));
      if ((i + 1) % kPollInterval == 0 && !may_go_on(0)) return {};
    }
    std::vector<StateId> rest(component.begin(), component.end());
    if (tally.is_fair()) return rest;
    std::erase_if(rest, [&](StateId state) {
      return tally.requests_in_vain(marks_.number(state));
    });
    return fair_part_among(rest, component.size(), place_of, may_go_on);
  }

  // A part, as above, of any states of a component of that size.
  template <class PlaceOf>
  std::vector<StateId> fair_part_among(std::span<const StateId> states,
                                       std::size_t component_size,
                                       PlaceOf&& place_of,
                                       const MayGoOn& may_go_on) {
    if (states.empty()) return {};
    const std::optional<MarkedGraph> graph =
        graph_of(states, component_size, place_of, may_go_on);
    if (!graph) return {};
    std::vector<StateId> part;
    for (const std::uint32_t number : strongly_fair_part(
             *graph, marks_.table(), system_.all_sets(), may_go_on)) {
      part.push_back(states[number]);
    }
    return part;
  }

 private:
  static constexpr std::uint32_t kOutside = UINT32_MAX;

  // The states and the steps between them; nothing when told not to go on.
  template <class PlaceOf>
  std::optional<MarkedGraph> graph_of(std::span<const StateId> states,
                                      std::size_t component_size,
                                      PlaceOf&& place_of,
                                      const MayGoOn& may_go_on) {
    std::vector<std::uint32_t> numbers(component_size, kOutside);  // by place
    for (std::size_t i = 0; i < states.size(); ++i) {
      numbers[place_of(states[i])] = static_cast<std::uint32_t>(i);
    }
    std::optional<MarkedGraph> graph(std::in_place);
    StateVector present(store_.word_count());
    for (std::size_t i = 0; i < states.size(); ++i) {
      graph->add_state(marks_.number(states[i]));
      store_.load(states[i], present);
      system_.successors(
          present, [&](StateView target, Step, AcceptanceSet sets) {
            const std::size_t place = place_of(store_.insert(target).id);
            if (place >= component_size || numbers[place] == kOutside) return;
            graph->add_arc(numbers[place], sets);
          });
      const std::size_t bytes =
          graph->bytes() + numbers.capacity() * sizeof(std::uint32_t);
      if ((i + 1) % kPollInterval == 0 && !may_go_on(bytes)) return {};
    }
    return graph;
  }

  const System& system_;
  StateStore& store_;
  StateMarks& marks_;
};

}  // namespace btcheck
