// SPDX-License-Identifier: MIT
//
// The pen with which the mapping of each node family draws its automaton.
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/automata/network.hpp"
#include "model/automata/regions.hpp"
#include "model/tree/answers.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::mapping {

// Guards and values, short.
Expression negated(Expression of);
Expression either(Expression left, Expression right);
// No divisor of the expression, which is over the network, is zero.
Expression is_defined(const Expression& over_network);
Assignment set(VariableId variable, int value);
Assignment set(VariableId variable, NodeStatus status);

// What the families share: the tree, the network under construction, and the
// locations and variables that other automata may name.
struct Context {
  const BehaviorTree& tree;
  Network& network;
  std::vector<Answers> answers = {};  // of XML trees, indexed by NodeId
  SampledValues samples = {};

  VariableId add_variable(Variable variable) const;
  VariableId status(NodeId node) const {
    return network.node_status[index(node)];
  }
  VariableId caller(NodeId node) const {
    return *network.node_caller[index(node)];
  }
  // An expression of the tree, over the network's variables.
  Expression over_network(const Expression& expression) const;
  // The assignments of the tree, in order, as those of an edge.
  std::vector<Assignment> over_network(
      const std::vector<StateAssignment>& effects) const;
  // The values that SetSV may give a state variable.
  std::vector<int> sampled(StateVariableId variable) const;
  // The fault variable, made on first use.
  VariableId fault() const;
  // Of XML trees, made on first use: 1 when the root has been asked to tick
  // again at once.
  VariableId wake();
  std::optional<VariableId> wake_up = {};
};

// What the world outside sees of a companion timer.
struct Timer {
  VariableId location{};
  static constexpr int kIdle = 0;
  static constexpr int kCounting = 1;
  static constexpr int kDue = 2;

  Expression is_idle() const { return equals(location, kIdle); }
  Expression is_counting() const { return equals(location, kCounting); }
  Expression is_due() const { return equals(location, kDue); }
  Assignment start() const { return set(location, kCounting); }
  Assignment stop() const { return set(location, kIdle); }
};

// Draws the automaton of one node. The frame (figure 5 of the paper) is drawn
// first: start_, tick_node, the status locations, done; each mapping then adds
// what stands between tick_node and the status locations.
class NodeBuilder {
 public:
  NodeBuilder(Context& context, NodeId node);

  const Node& node() const { return node_; }
  NodeId id() const { return id_; }
  Context& context() { return context_; }
  std::size_t child_count() const { return node_.children.size(); }
  NodeId child(std::size_t i) const { return node_.children[i]; }
  VariableId status(std::size_t i) const { return context_.status(child(i)); }
  VariableId caller(std::size_t i) const { return context_.caller(child(i)); }

  // Location by name; made when it does not exist yet.
  LocationId at(std::string_view name);
  // Where it calls child i, and where it waits for the answer; under another
  // name for each occasion.
  LocationId calling(std::size_t i, std::string_view occasion = {});
  LocationId called(std::size_t i, std::string_view occasion = {});
  bool calls(std::size_t i, std::string_view occasion = {});
  bool knows(std::string_view name);
  bool has_edge(LocationId source, LocationId target);
  // Where the node waits for the children that it halts in a location: each
  // such location has its own.
  LocationId waiting_beside(LocationId location);
  VariableId local(std::string_view name, int min, int max, int initial);
  // Of LocalRole::Rounds, from 0 on.
  VariableId rounds(std::string_view name, int most);
  // Of LocalRole::Fault, made on first use.
  VariableId fault_phase();
  // Makes a variable of the family one of this automaton's locals.
  void own(VariableId variable) { automaton().locals.push_back(variable); }

  void edge(LocationId source, LocationId target, Expression guard = {},
            std::vector<Assignment> updates = {}, std::string label = {});
  // An edge that the world outside may choose instead of others of its source.
  void choice(LocationId source, LocationId target, Expression guard,
              std::vector<Assignment> updates, std::string label);
  void timed_edge(LocationId source, LocationId target, Interval when,
                  std::string label = {});
  // The label of the edge drawn last tells why the node goes on as it does.
  void tells_why();
  // The edge drawn last begins another round of an unknown number.
  void is_like_time();
  // The edge drawn last executes this program, if it is one, with this outcome.
  void executes(std::int32_t program, ScriptOutcomeKind outcome);

  // The locations of the frame, start_ first, which is where it begins, and
  // their edges.
  void frame();
  // The frame of a node that never answers running and is never halted.
  void frame_without_running();

  // The location in which the node decides: tick_node itself, or `evaluate`
  // one unit of time later when the tick semantics times this node.
  LocationId decide();
  // True when the tick semantics makes this node take one unit.
  bool is_timed() const;

  // The location that calls child i, drawn with its `_done` on first use:
  // `C → C_done` with caller := self.
  LocationId call(std::size_t i);
  // The guard "child i has given control back with this status".
  Expression answered(std::size_t i, NodeStatus status) const;
  // From `C_done` of child i, on this answer, to `target`.
  void on_answer(std::size_t i, NodeStatus status, LocationId target,
                 std::vector<Assignment> updates = {}, Expression guard = {});

  // Whether more than one child may run at a time. Where none can, halting one
  // asks nothing of the others: a row of n children takes n conditions, not
  // n²/2.
  bool several_children_may_run() const;

  // Draws `from` so that it halts the running children, left to right, one
  // after the other, and goes to `then` when none runs any more.
  void halt_children(LocationId from, LocationId then,
                     std::vector<Assignment> updates = {});
  // halt → (children) → halted with these updates.
  void on_halt(std::vector<Assignment> updates = {});
  // Of a root with Node::option: where it runs, its caller may halt it instead
  // of ticking it again, with these updates; the next tick begins at `start`.
  void halted_by_caller(LocationId start, std::vector<Assignment> updates = {});

  Expression some_child_runs() const;
  Expression all_children_are_back() const;

  // A companion timer for this node, due after a time in the interval.
  Timer add_timer(Interval duration);
  // The same, due after the node's own duration, if that takes any time.
  bool takes_time() const;
  Timer add_timer();

 private:
  // The edge into tick_node.
  void is_called_when(const Expression& called);
  Automaton& automaton();
  LocationId at(std::string_view name, LocationRole role, NodeId child);
  std::string name_of(std::size_t i, std::string_view occasion) const;
  void status_edges(bool may_run);

  Context& context_;
  NodeId id_;
  const Node& node_;
  std::unordered_map<std::string, LocationId> places_;  // by name
  std::optional<VariableId> fault_phase_ = {};
};

// Draws the automaton of one node, frame included.
using Draw = void (*)(NodeBuilder&);
struct Drawing {
  NodeType type{};
  Draw draw = nullptr;
};
// Those of one family of node types: a table below its drawings.
using Family = std::span<const Drawing>;

// What each node type of a language does.
class Drawings {
 public:
  // Throws, and names the type, where one that the language has by its row is
  // not drawn; where one is drawn twice, or another one.
  Drawings(In language, std::initializer_list<Family> families);

  Draw of(NodeType type) const {
    return draws_.at(static_cast<std::size_t>(type));
  }

 private:
  std::vector<Draw> draws_;  // by NodeType
};

}  // namespace btcheck::mapping
