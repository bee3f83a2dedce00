// SPDX-License-Identifier: MIT
//
// The network compiled to a successor function over packed words.
#pragma once

#include <bit>
#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <optional>
#include <vector>

#include "explore/state/condition.hpp"
#include "explore/state/state_layout.hpp"
#include "explore/state/transition_system.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// Time that passes without changing anything: where nothing can happen any
// more, or only free variables move. Every other step changes the state.
inline constexpr Step kIdleStep{kTimeStep, 1, true};

// Whether any step at all, other than an idle one, leads from a state, and
// whether one of a tree's own edges does.
struct Enabled {
  bool any = false;   // an edge, or a time step that moves a clock
  bool tree = false;  // an edge of a node or a timer
};

// A network as a TransitionSystem (semantics: model/automata/network.hpp).
// Immutable; may be used by several threads. The network must outlive it.
class CompiledNetwork {
 public:
  explicit CompiledNetwork(const Network& network);
  // With its vectors laid out as said.
  CompiledNetwork(const Network& network, StateLayout layout);

  const Network& network() const { return network_; }
  const StateLayout& layout() const { return layout_; }
  std::size_t word_count() const { return layout_.words; }
  PropositionSet label(StateView) const { return 0; }
  // True when some state variable moves by itself.
  bool has_free_moves() const { return has_free_moves_; }

  template <class Found>
  void initial_states(Found&& found) const {
    found(StateView(initial_));
  }

  // Calls stepped(StateView target, Step) for each step, the idle one last.
  template <class Stepped>
  void successors(StateView state, Stepped&& stepped) const {
    Move<Stepped> move{state.data(), Buffer(state.begin(), state.end()),
                       stepped};
    if (fault_ && fault_->get(state.data()) != 0) {
      stepped(state, kIdleStep);
      return;
    }
    if (!timers_.empty() && fire_due_timers(move)) return;
    for (const GateGroup& group : layout_.gates) {
      Word open = state[group.word] & group.mask;
      for (; open != 0; open &= open - 1) {
        fire(automata_[index(group.automaton_of_bit[std::countr_zero(open)])],
             move);
      }
    }
    for (const std::uint32_t ungated : ungated_) {
      fire(automata_[ungated], move);
    }
    pass_time(move);
  }

  Enabled enabled(StateView state) const;

  // For reductions, which look at one automaton at a time. Whether only due
  // timers may move, or nothing any more:
  bool is_preempted(StateView state) const {
    return (fault_ && fault_->get(state.data()) != 0) || has_due_timer(state);
  }
  // Calls found(automaton) for each that has been called, in node order, then
  // for those that need no call, until it answers No.
  template <class Found>
  void for_each_open(StateView state, Found&& found) const {
    for (const GateGroup& group : layout_.gates) {
      Word open = state[group.word] & group.mask;
      for (; open != 0; open &= open - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(open));
        if (found(group.automaton_of_bit[bit]) == GoOn::No) return;
      }
    }
    for (const std::uint32_t ungated : ungated_) {
      if (found(AutomatonId{ungated}) == GoOn::No) return;
    }
  }
  // Whether an automaton has been called, or needs no call.
  bool is_open(StateView state, AutomatonId automaton) const {
    const CompiledAutomaton& compiled = automata_[index(automaton)];
    return compiled.gate == 0 ||
           (state[compiled.gate_word] & compiled.gate) != 0;
  }
  LocationId location(StateView state, AutomatonId automaton) const {
    const Field& field = automata_[index(automaton)].location;
    return LocationId{
        static_cast<std::uint32_t>(field.get(state.data()) - field.base)};
  }
  // Calls found(edge) for each edge of the automaton whose guard is true, by
  // its place among the compiled ones. Intervals are not looked at.
  template <class Found>
  void open_edges(StateView state, AutomatonId automaton, Found&& found) const {
    const CompiledLocation& here =
        present(automata_[index(automaton)], state.data());
    for (std::uint32_t i = here.first_edge; i < here.last_edge; ++i) {
      if (conditions_.holds(edges_[i].guard, state.data())) found(i);
    }
  }
  // Whether an automaton can move neither now nor before time passes, whatever
  // others do: no edge leads on, or each still has to wait.
  bool is_at_rest(StateView state, AutomatonId automaton) const;
  // By its place among the compiled ones: the number of an edge, and firing it.
  std::uint32_t edge_number(std::uint32_t place) const {
    return edges_[place].number;
  }
  void fire(std::uint32_t place, std::span<Word> state) const {
    apply(edges_[place], state.data());
  }
  // Whether is_preempted may hold behind an edge before which it does not.
  bool may_preempt(std::uint32_t place) const {
    return edges_[place].may_preempt;
  }

  // The value of a variable, or of an automaton's clock (0 when it has none).
  std::int64_t value(StateView state, VariableId variable) const {
    return layout_.fields[index(variable)].get(state.data());
  }
  std::int64_t clock(StateView state, AutomatonId automaton) const {
    const std::optional<Field>& field = layout_.clocks[index(automaton)];
    return field ? field->get(state.data()) : 0;
  }
  // The same state with every clock at 0: what TINA calls its marking.
  void clear_clocks(std::span<Word> state) const;

 private:
  using Buffer = boost::container::small_vector<Word, 16>;

  // An assignment to a field: of bits known beforehand, or computed.
  struct Write {
    Word keep = 0;
    Word bits = 0;
    std::uint32_t word = 0;
    bool is_computed = false;
    Program program;
    Field field;
  };
  struct CompiledEdge {
    Condition guard;
    std::uint32_t first_write = 0;
    std::uint32_t last_write = 0;
    std::uint32_t number = 0;
    int lower = 0;
    int upper = 0;
    bool progress = true;
    bool may_preempt = false;  // writes a fault, or where a timer stands
  };
  struct CompiledLocation {
    std::uint32_t first_edge = 0;
    std::uint32_t last_edge = 0;
    int greatest_clock = 0;  // 0: no clock runs here
  };
  struct CompiledAutomaton {
    Field location;
    std::uint32_t first_location = 0;
    std::optional<Field> clock;
    std::uint32_t gate_word = 0;
    Word gate = 0;  // the bit of that word; 0: needs no call
  };

  // One computation of successors under way.
  template <class Stepped>
  struct Move {
    const Word* state;
    Buffer next;  // equal to state between two steps
    Stepped& stepped;
    bool is_urgent = false;     // an enabled edge has reached its deadline
    bool tree_enabled = false;  // an edge that is not a free move is enabled
  };

  void compile_automaton(AutomatonId id);
  void compile_edge(const Automaton& automaton, AutomatonId id,
                    std::uint32_t position);
  void compile_assignment(const Assignment& assignment,
                          std::uint32_t first_write);
  bool may_preempt(const Automaton& automaton, const Edge& edge) const;
  void write_constant(const Field& field, std::int64_t value,
                      std::uint32_t first_write);

  const CompiledLocation& present(const CompiledAutomaton& automaton,
                                  const Word* state) const {
    return locations_[automaton.first_location +
                      static_cast<std::uint32_t>(automaton.location.get(state) -
                                                 automaton.location.base)];
  }

  void apply(const CompiledEdge& edge, Word* next) const {
    for (std::uint32_t i = edge.first_write; i < edge.last_write; ++i) {
      const Write& write = writes_[i];
      if (write.is_computed) {
        write.field.put(next, conditions_.value(write.program, next));
      } else {
        next[write.word] = (next[write.word] & write.keep) | write.bits;
      }
    }
  }

  template <class Stepped>
  void take(const CompiledEdge& edge, Move<Stepped>& move) const {
    apply(edge, move.next.data());
    move.stepped(view_of(move.next), Step{edge.number, 0, edge.progress});
    std::copy(move.state, move.state + move.next.size(), move.next.begin());
  }

  template <class Stepped>
  void fire(const CompiledAutomaton& automaton, Move<Stepped>& move) const {
    const CompiledLocation& location = present(automaton, move.state);
    for (std::uint32_t i = location.first_edge; i < location.last_edge; ++i) {
      const CompiledEdge& edge = edges_[i];
      if (!conditions_.holds(edge.guard, move.state)) continue;
      int clock = 0;
      if (location.greatest_clock > 0) {
        clock = static_cast<int>(automaton.clock->get(move.state));
        if (clock < edge.lower) continue;
      }
      move.is_urgent |= clock == edge.upper;
      move.tree_enabled |= edge.progress;
      take(edge, move);
    }
  }

  bool has_due_timer(StateView state) const {
    for (const std::uint32_t timer : timers_) {
      const CompiledAutomaton& automaton = automata_[timer];
      const CompiledLocation& location = present(automaton, state.data());
      const std::int64_t clock = automaton.clock->get(state.data());
      for (std::uint32_t i = location.first_edge; i < location.last_edge; ++i) {
        if (edges_[i].upper == clock) return true;
      }
    }
    return false;
  }

  // Timers that have reached their deadline go before everything else.
  template <class Stepped>
  bool fire_due_timers(Move<Stepped>& move) const {
    bool fired = false;
    for (const std::uint32_t timer : timers_) {
      const CompiledAutomaton& automaton = automata_[timer];
      const CompiledLocation& location = present(automaton, move.state);
      for (std::uint32_t i = location.first_edge; i < location.last_edge; ++i) {
        const CompiledEdge& edge = edges_[i];
        const bool is_due =
            automaton.clock && edge.upper == automaton.clock->get(move.state);
        if (!is_due) continue;
        take(edge, move);
        fired = true;
      }
    }
    return fired;
  }

  template <class Stepped>
  void pass_time(Move<Stepped>& move) const {
    if (is_untimed_) {
      if (!move.tree_enabled) {
        move.stepped(StateView(move.state, move.next.size()), kIdleStep);
      }
      return;
    }
    if (move.is_urgent) return;
    advance_clocks(move.next.data());
    move.stepped(view_of(move.next), kIdleStep);
  }

  void advance_clocks(Word* next) const {
    for (const std::uint32_t clocked : clocked_) {
      const CompiledAutomaton& automaton = automata_[clocked];
      const int greatest = present(automaton, next).greatest_clock;
      if (greatest == 0) continue;
      const std::int64_t now = automaton.clock->get(next);
      if (now < greatest) automaton.clock->put(next, now + 1);
    }
  }

  const Network& network_;
  StateLayout layout_;
  ConditionPool conditions_;
  StateVector initial_;
  std::optional<Field> fault_;
  bool is_untimed_ = false;
  bool has_free_moves_ = false;
  std::vector<CompiledAutomaton> automata_;  // by AutomatonId
  std::vector<CompiledLocation> locations_;
  std::vector<CompiledEdge> edges_;  // by automaton, then source
  std::vector<Write> writes_;
  std::vector<std::uint32_t> ungated_;  // automata with edges but no gate
  std::vector<std::uint32_t> clocked_;
  std::vector<std::uint32_t> timers_;
};

}  // namespace btcheck
