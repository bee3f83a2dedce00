// SPDX-License-Identifier: MIT
//
// Automata as data: locations, and edges with guards, updates and intervals;
// and the network that a tree becomes, automata in parallel over shared
// variables and clocks.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/tree/expression.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// Index into Network::variables.
enum class VariableId : std::uint32_t {};
constexpr std::uint32_t index(VariableId id) {
  return static_cast<std::uint32_t>(id);
}

// Index into Network::automata.
enum class AutomatonId : std::uint32_t {};
constexpr std::uint32_t index(AutomatonId id) {
  return static_cast<std::uint32_t>(id);
}

// Index into Automaton::locations.
enum class LocationId : std::uint32_t {};
constexpr std::uint32_t index(LocationId id) {
  return static_cast<std::uint32_t>(id);
}

// The value of a variable, and its comparison with a constant.
Expression read(VariableId variable);
Expression equals(VariableId variable, int value);
Expression equals(VariableId variable, NodeStatus status);
Expression differs(VariableId variable, int value);

// What a location is for, in any family of node types. Every node has one of
// each of Start, Tick and Done, and of the answers it can give.
enum class LocationRole : std::uint8_t {
  Inner,     // of this node type's own
  Start,     // nobody has called it
  Tick,      // it has just been called
  Evaluate,  // it decides, one unit of time after it was called
  Call,      // it calls a child
  Called,    // it waits for the answer of a child, and reads it
  Success,
  Failure,
  Running,
  Skipped,
  Error,   // it has thrown
  Halt,    // it has been asked to halt, or halts itself
  Halted,  // and so have its children
  Done     // it gives control back
};

struct Location {
  std::string name;
  LocationRole role = LocationRole::Inner;
  NodeId child{};  // of Call and Called
};

// A node answers in a location of this role.
bool is_answer(LocationRole role);
// A root has ended there: an XML tree may be skipped as a whole.
bool is_end(LocationRole role);

// Closed interval of whole time units, open to infinity when upper is
// kUnbounded. The clock of an edge starts when its source is entered.
inline constexpr int kUnbounded = std::numeric_limits<int>::max();
struct Interval {
  int lower = 0;
  int upper = 0;

  bool is_urgent() const { return upper == 0; }
  bool needs_clock() const {
    return lower > 0 || (upper > 0 && upper != kUnbounded);
  }
  // The greatest clock value that has to be told apart from later ones; 0
  // where no clock is needed.
  int greatest_clock() const { return upper == kUnbounded ? lower : upper; }
  friend bool operator==(const Interval&, const Interval&) = default;
};
inline constexpr Interval kAtOnce{0, 0};
inline constexpr Interval kAnyTime{0, kUnbounded};

// variable := value, both over the variables of the network.
struct Assignment {
  VariableId variable{};
  Expression value;
};

// One atomic step of one automaton. Assignments are executed in order, each
// seeing the ones before it; then the target becomes active. An edge whose
// interval needs a clock has no guard, so that a variable that flips cannot
// reset the clock.
struct Edge {
  LocationId source{};
  LocationId target{};
  Expression guard;  // true when empty
  std::vector<Assignment> updates;
  Interval when;
  std::string label;  // what it means, in the paper's words; may be empty
  // The world outside may choose this edge; the label tells what it does then.
  bool asks_world = false;
  // The label is the reason for what follows, not a child: `the time is up`.
  bool tells_why = false;
  // Begins another round of an unknown number, or reaches a goal of another
  // process: not taken for ever without time passing.
  bool is_like_time = false;
  // XML trees: what happens to blackboard entries, in order.
  std::vector<ScriptStep> scripts = {};
};

enum class AutomatonKind : std::uint8_t { StateVariable, Node, Timer };

// One process of the network. Its present location is the value of the
// variable `location`: for a state variable's automaton that is the variable
// itself, its locations being the values, as in the paper's
// `mars_rover/3/state Unfolded`.
struct Automaton {
  AutomatonKind kind = AutomatonKind::Node;
  std::string name;
  NodeId node{};                     // Node, and the node a Timer serves
  StateVariableId state_variable{};  // StateVariable
  VariableId location{};
  // When set: no edge is enabled while this two-valued variable is 0. It is
  // the caller field; the frame of every node makes it so.
  std::optional<VariableId> gate;
  std::vector<Location> locations;
  std::vector<Edge> edges;
  std::vector<VariableId> locals;
  std::uint32_t first_edge = 0;  // number of edges[0] in the whole network

  const Location& source(const Edge& edge) const {
    return locations[index(edge.source)];
  }
  const Location& target(const Edge& edge) const {
    return locations[index(edge.target)];
  }
  std::optional<LocationId> find_location(std::string_view word) const;
  // The first one of a role.
  std::optional<LocationId> find_location(LocationRole role) const;
  std::vector<std::string> location_names() const;
};

// Where time passes (paper, section 3.8.2). None: no clocks and no urgency.
enum class TickSemantics : std::uint8_t { Root, Leaves, Nodes, None };
std::string_view tick_name(TickSemantics ticks);
std::optional<TickSemantics> tick_semantics(std::string_view name);

enum class VariableRole : std::uint8_t {
  State,     // a state variable of the tree
  Location,  // the location of a node's or timer's automaton
  Caller,    // 0 None, 1 the parent
  Status,    // rstatus, a NodeStatus
  Local,     // next_seq, retry, failed, …
  Fault      // 1 once an assignment has left its variable's range
};

// What a local is for, in any family of node types.
enum class LocalRole : std::uint8_t {
  Inner,   // of this node type's own
  Rounds,  // how many rounds are done, or how often it has tried again
  Fault    // a FaultPhase (model/tree/leaf_fault.hpp)
};

// An integer in [min, max].
struct Variable {
  VariableRole role = VariableRole::Local;
  std::string name;  // within its node: `next_seq`, `rstatus`, …
  int min = 0;
  int max = 0;
  int initial = 0;
  std::vector<std::string> value_names;  // of min, min + 1, …; may be empty
  // Whose location, gate, status or local it is; of an enumerated state
  // variable the automaton that moves it.
  std::optional<AutomatonId> owner = std::nullopt;
  Scale scale = {};  // of a number
  LocalRole local = LocalRole::Inner;

  std::int64_t domain_size() const {
    return std::int64_t{max} - std::int64_t{min} + 1;
  }
  std::string value_name(int value) const;
};

// What a node was given when it was ticked last, for rules that ask: the value
// of one of its arguments, 0 or what is nearest before and after. Made by
// keep_arguments; see docs/semantics.md, section 4.
struct KeptArgument {
  NodeId node{};
  std::size_t number = 0;  // of Node::arguments
  VariableId variable{};   // one of the locals of the node's automaton
};

// What a rule says of the past, as a bit. Made by remember_past.
struct PastMemory {
  std::string key;
  VariableId variable{};  // one of the locals of the first root's automaton
};

// Automata in the paper's order: enumerated state variables as declared, then
// the nodes of each tree in post-order; timers after all of them. Process
// number k (counted from 1) is automata[k - 1].
//
// Semantics (docs/semantics.md, sections 1 and 2): one edge of one automaton
// at a time, in any order; a timer's edge that has reached its deadline goes
// before every other edge; time advances by one when no enabled edge has
// reached its deadline; no edge is enabled once `fault` is 1.
struct Network {
  Profile profile = Profile::Paper;
  TickSemantics ticks = TickSemantics::Root;
  std::vector<Variable> variables;
  std::vector<Automaton> automata;
  std::optional<VariableId> fault;  // absent when no assignment can fail
  std::vector<KeptArgument> arguments;
  std::vector<PastMemory> past;

  // Indexed by NodeId; `caller` of a root is absent.
  std::vector<AutomatonId> node_automaton;
  std::vector<VariableId> node_status;
  std::vector<std::optional<VariableId>> node_caller;
  // Indexed by StateVariableId.
  std::vector<VariableId> state_variable;
  // Indexed by StateVariableId; absent for a number that does not move.
  std::vector<std::optional<AutomatonId>> state_automaton;

  const Variable& variable(VariableId id) const { return variables[index(id)]; }
  const Automaton& automaton(AutomatonId id) const {
    return automata[index(id)];
  }
  const Automaton& automaton(NodeId node) const {
    return automaton(node_automaton[index(node)]);
  }
  std::uint32_t edge_count() const;
  // Anew, where edges have been added: by automaton, as they stand.
  void number_edges();
  // The automaton that owns the edge with this number.
  const Automaton& owner_of_edge(std::uint32_t edge) const;
  const Edge& edge(std::uint32_t number) const;
};

// An expression over the tree's variables and statuses, over the network's.
Expression over_network(const Network& network, const Expression& expression);

// The node that an edge brings into a location of this role; nothing when the
// edge is no node's or leads elsewhere.
std::optional<NodeId> node_entering(const Network& network, std::uint32_t edge,
                                    LocationRole role);

// True if something else could have happened instead of the edge: its automaton
// had another step to take where the variables have these values.
bool is_choice(const Network& network, std::span<const int> values,
               std::uint32_t edge);

// The node's local of this role, if it has one.
std::optional<VariableId> local_of(const Network& network, NodeId node,
                                   LocalRole role);

// The automaton whose location the variable is, if it is one.
std::optional<AutomatonId> automaton_at(const Network& network,
                                        VariableId variable);

// Text of an expression over network variables, `battery = Low and x < 3`.
std::string expression_text(const Network& network,
                            const Expression& expression);
// What is assigned: the name of a value, or `fls + 1`; of a number in steps
// `height + 1 (steps of 0.1)`.
std::string assigned_text(const Network& network, const Assignment& update);
// The name of a variable with its owner, `Sequence13_btn6.next_seq`.
std::string qualified_name(const Network& network, VariableId variable);

}  // namespace btcheck
