// SPDX-License-Identifier: MIT
//
// One run of a tree, step by step; the caller decides what it leaves open.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "check/bind/verdict.hpp"
#include "check/replay/replay.hpp"
#include "explore/state/split_mix.hpp"
#include "model/automata/network.hpp"
#include "model/btcpp/tree/entry_programs.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// What kind of decision a step is.
enum class ChoiceKind : std::uint8_t {
  Answer,  // of an action or a condition, or the value a SetSV finds
  World,   // what else a node asks the world: whether a script is true
  Tick,    // a root begins a tick: until then, free variables may move
  Tree,    // a step of the tree, which another one may come before
  Due,     // the time of an action is up, before it has to be
  Move,    // a free variable changes
  Time     // time passes after the end of all trees
};

struct SimulationChoice {
  Step step;
  ChoiceKind kind = ChoiceKind::Tree;
};

// Which step goes first where two could be taken in either order.
enum class Interleaving : std::uint8_t {
  Open,    // a choice, where the order can make a difference
  InOrder  // the automaton with the least process number, always; and free
           // variables move when the first root begins a tick, and only then
};

// True for nodes whose answer, or the value they find, the world decides.
bool is_scripted(NodeType type);

// A leaf of an XML tree that was not reset answers what it has answered before.
bool keeps_answer(const Edge& edge);

// Why a run does not go on.
enum class RunEnd : std::uint8_t { None, Ended, Fault, Stuck };

// Stands in one state of the network, with what may happen next. Tree and
// network must outlive it.
class Simulation {
 public:
  Simulation(const BehaviorTree& tree, const Network& network,
             Interleaving interleaving);

  const BehaviorTree& tree() const { return tree_; }
  const Network& network() const { return network_; }
  const Valuation& state() const { return state_; }

  // What may happen next: the steps of each node together (a SetSV that finds
  // nothing new first), nodes by process number, then what moves by itself. The
  // first is taken when nobody chooses. A single choice is offered for the
  // answer of a leaf, the beginning of a tick and the move of a variable; at
  // the end there is none.
  std::span<const SimulationChoice> choices() const { return choices_; }
  // The state that a choice leads to.
  Valuation after(const SimulationChoice& choice) const {
    return interpreter_.after(state_, choice.step);
  }

  // Takes one of the choices, and then all steps that leave none.
  void take(std::size_t choice);
  // Returns to where the last choice among several was made. False: there was
  // none.
  bool back();

  // Ended: every root has succeeded or failed for ever, though free variables
  // may still move.
  RunEnd end() const;
  // Time cannot pass before a variable has moved, whose own time is over.
  bool must_move() const { return !interpreter_.may_wait(state_); }
  // How many ticks the root of the node's tree has begun.
  int ticks(NodeId node) const;

  // Calls told(state before, step) for each step that the last `take` took, or
  // that led to the first choice; for none after `back`.
  template <class Told>
  void for_each_latest(Told&& told) const;
  // The run as a whole.
  Run run() const;

 private:
  using Choices = std::vector<SimulationChoice>;

  void add_enabled(const Automaton& automaton,
                   std::vector<std::uint32_t>& edges) const;
  std::vector<std::uint32_t> enabled(AutomatonKind kind) const;
  std::optional<std::uint32_t> forced_timer() const;
  bool is_contested(std::uint32_t edge) const;
  ChoiceKind kind_of(std::uint32_t edge) const;
  void put_unchanged_first(Choices& own) const;
  void leave_out_refused(std::vector<std::uint32_t>& edges) const;
  Choices choices_of_tree() const;
  void add_due(Choices& choices) const;
  bool may_move(const Automaton& variable, const Choices& choices) const;
  Choices choices_without_tree() const;
  Choices possible() const;
  bool has_root_alive() const;
  void restart(std::span<const Step> steps);
  void execute(const Step& step);
  void settle();

  const BehaviorTree& tree_;
  const Network& network_;
  NetworkInterpreter interpreter_;
  Interleaving interleaving_;
  // By automaton and location: what is done there can make a difference to
  // others, or theirs to it.
  std::vector<std::vector<bool>> contested_;

  // Where a choice was made: the number of steps before it.
  struct Mark {
    std::size_t steps = 0;
    bool is_among_several = false;
  };
  std::vector<Step> steps_;  // states are executed again when asked for
  std::vector<Mark> marks_;
  std::vector<int> ticks_;  // by node
  // What scripts have written, where a state variable stands for many values.
  std::optional<btcpp::EntryExecution> values_;
  Valuation state_;
  Valuation before_latest_;
  std::size_t first_latest_ = 0;  // of steps_
  Choices choices_;
};

template <class Told>
void Simulation::for_each_latest(Told&& told) const {
  Valuation here = before_latest_;
  for (std::size_t i = first_latest_; i < steps_.size(); ++i) {
    RunStep step{steps_[i], interpreter_.after(here, steps_[i])};
    told(std::as_const(here), std::as_const(step));
    here = std::move(step.after);
  }
}

// One of the choices, at random. Where free variables may move, one in four
// goes to them; else all are equally likely.
std::size_t random_choice(std::span<const SimulationChoice> choices,
                          SplitMix64& random);

}  // namespace btcheck
