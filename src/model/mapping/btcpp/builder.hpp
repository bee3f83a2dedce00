// SPDX-License-Identifier: MIT
//
// The pen for nodes of BehaviorTree.CPP and Nav2 (XML trees): what the engine
// does around every tick, and the moves its nodes share.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/automata/builder.hpp"
#include "model/tree/releases.hpp"

namespace btcheck::mapping {

// Where a node goes when its child has answered.
struct Reaction {
  LocationId to{};
  std::vector<Assignment> updates = {};
  Expression guard = {};
};

// What each answer of a child leads to. Guards must exclude each other: none of
// them goes first. What a child cannot answer needs no reaction.
struct Reactions {
  std::vector<Reaction> success = {};
  std::vector<Reaction> failure = {};
  std::vector<Reaction> running = {};  // none: the node answers running, too
  std::vector<Reaction> skipped = {};
};

// Whether tick() of a node type calls setStatus(RUNNING) before anything else:
// such a node stays running when it answers SKIPPED. Where it calls it only if
// it is idle, one that has ended and was not reset stays as it ended.
enum class Begins : std::uint8_t { Running, RunningIfIdle, Silently };

// The counter's value + 1, where that is within its range.
Assignment count(VariableId counter);
Expression at_least(VariableId variable, int value);
// None where there is no such variable.
std::vector<Assignment> set_if_there(std::optional<VariableId> variable,
                                     int value);
std::vector<Assignment> joined(std::vector<Assignment> one,
                               const std::vector<Assignment>& other);

// Draws the automaton of one node of an XML tree. Around tick() the engine
// evaluates preconditions, runs postconditions and keeps the status
// (TreeNode::executeTick, src/tree_node.cpp of 4.10).
class EngineBuilder {
 public:
  EngineBuilder(NodeBuilder& draw, Begins begins);

  NodeBuilder& draw() { return draw_; }
  const Node& node() const { return draw_.node(); }
  std::size_t child_count() const { return draw_.child_count(); }
  Profile profile() const { return draw_.context().tree.profile; }
  // Whether the engine is one of these.
  int release() const { return engine_release(profile()); }
  bool is_in(const Releases& releases) const { return releases.has(release()); }

  VariableId status() const { return draw_.context().status(draw_.id()); }
  VariableId status(std::size_t child) const { return draw_.status(child); }
  VariableId caller(std::size_t child) const { return draw_.caller(child); }

  LocationId at(std::string_view name) { return draw_.at(name); }
  // The location by its name; where it is new, `draw` gives it its edges.
  template <class Draw>
  LocationId once(std::string_view name, Draw draw) {
    const bool is_new = !draw_.knows(name);
    const LocationId location = at(name);
    if (is_new) draw(location);
    return location;
  }
  // Where tick() begins.
  LocationId body() const { return body_; }
  LocationId success() { return at("success"); }
  LocationId failure() { return at("failure"); }
  LocationId running() { return at("running"); }
  LocationId answering(NodeStatus answer);
  // Answers running with a wake-up signal, so that others get their turn and
  // the tree is then ticked again at once (TreeNode::emitWakeUpSignal).
  LocationId yielding();
  // tick() answers SKIPPED.
  LocationId skipped();
  // tick() throws: the run ends, as the program does.
  void throws(LocationId from, Expression guard, std::string_view why);

  // The node's own status before the tick.
  Expression was_idle() const;
  Expression was_running() const;
  // A child's status.
  Expression is_running(std::size_t child) const;
  Expression is_idle(std::size_t child) const;
  Expression has(std::size_t child, NodeStatus word) const;
  bool may_skip(std::size_t child) const;
  bool own_may_skip() const;
  bool every_child_may_skip() const;
  bool some_child_may_skip() const;
  // Whether the parent may tick the node again after it has ended, without a
  // reset in between.
  bool may_stay() const;

  // From body() to `then`; a node that was idle makes these updates.
  void start_anew(LocationId then, std::vector<Assignment> updates);
  // Where a row of children goes on with this one, counted from 0: `turn_1`, …;
  // behind the last one `end`.
  LocationId turn(std::size_t child);
  // Passes every answer of an only child on; with these updates when it has
  // ended.
  Reactions passing(const std::vector<Assignment>& when_ended = {});

  // An only child that was skipped is idle then.
  void resets_skipped(Reactions& reactions) const;

  // child->executeTick(), and where its answers lead. For one child it may be
  // drawn several times, under different names of the occasion.
  LocationId tick(std::size_t child, Reactions reactions,
                  std::string_view occasion = {});
  // A decorator's: its child is idle after every completed tick
  // (DecoratorNode::executeTick); within the tick it stays as it ended on the
  // way to `kept`.
  LocationId tick_only_child(Reactions reactions,
                             std::string_view occasion = {},
                             std::optional<LocationId> kept = {});

  // Halts those of the children that run, from left to right, and goes on to
  // `then` with these updates when none of them runs any more.
  void halt(LocationId from, LocationId then,
            const std::vector<std::size_t>& children,
            std::vector<Assignment> updates = {}, Expression guard = {});
  // Halts those of the children that run, from left to right, and leaves all
  // of them idle: resetChildren, haltChild.
  void reset(LocationId from, LocationId then,
             const std::vector<std::size_t>& children,
             std::vector<Assignment> updates = {}, Expression guard = {});
  void reset_all(LocationId from, LocationId then,
                 std::vector<Assignment> updates = {});
  // A location that resets all children and goes on to `then`.
  LocationId resetting(std::string_view name, LocationId then,
                       std::vector<Assignment> updates = {});
  std::vector<std::size_t> all_children() const;
  // Resets all children; then answers, or where all were skipped, SKIPPED.
  void end(LocationId from, LocationId answer,
           const std::vector<Assignment>& updates, Expression otherwise,
           Expression are_all_skipped);

  // From a location on somebody halts the node, with its script and these
  // updates, and gives it no turn.
  void halt_from_outside(std::string_view location, LocationId then,
                         std::vector<Assignment> updates);
  // halt(): all children are reset, with these updates.
  void on_halt(std::vector<Assignment> updates = {});

  // From a location to one of two, by a script's value, with its assignments on
  // the way. `evaluate` also throws, where there is no value or the script
  // reads what is not there.
  void choose(LocationId from, const Script& script, LocationId where_true,
              LocationId where_false, const Expression& guard = {});
  void evaluate(LocationId from, const Script& script, LocationId where_true,
                LocationId where_false, Expression guard = {});
  // The engine throws where a script's value is neither true nor false, and
  // where it reads an entry that only the program around the tree can have
  // written.
  void throws_where_undecided(LocationId from, const Script& script,
                              Expression guard);

 private:
  void draw_preconditions();
  void draw_reading();
  void draw_preconditions_of_each_tick();
  void draw_answers();
  void draw_skipped(const std::vector<ScriptTime>& otherwise);
  void draw_halted();
  void draw_own_halt(LocationId from);
  // Runs postconditions one after the other. Returns where to go on, with the
  // updates that are still to be done on the way from there.
  struct Afterwards {
    LocationId last{};
    std::vector<Assignment> updates;
    std::vector<std::int32_t> programs;
  };
  Afterwards run_afterwards(std::string_view location,
                            const std::vector<ScriptTime>& times);
  void leave(const Afterwards& after, LocationId to, Expression guard,
             std::string label);
  Expression is_idle_status(VariableId status) const;

  NodeBuilder& draw_;
  Begins begins_;
  LocationId body_{};
};

// The leaves of a program, of py_trees as well.
void draw_engine_leaf(NodeBuilder& draw);

extern const Family kEngineLeafDrawings;
extern const Family kEngineSequenceDrawings;
extern const Family kEngineParallelDrawings;
extern const Family kBranchingDrawings;
extern const Family kEngineDecoratorDrawings;
extern const Family kTimeDrawings;
extern const Family kNav2Drawings;

}  // namespace btcheck::mapping
