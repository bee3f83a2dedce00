// SPDX-License-Identifier: MIT
//
// A behavior tree as its author wrote it: nodes, state variables, positions.
#pragma once

#include <array>
#include <boost/container/flat_map.hpp>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/tree/expression.hpp"
#include "model/tree/leaf_fault.hpp"
#include "model/tree/leaf_meaning.hpp"
#include "model/tree/scale.hpp"
#include "text/diagnostic.hpp"
#include "text/input_file.hpp"
#include "text/tables.hpp"

namespace btcheck {

// A node's pre-order number over all trees of the file, subtrees expanded: a
// root is 0, its child 1. This is the M of the paper's `land_btnM`.
enum class NodeId : std::uint32_t {};
constexpr std::uint32_t index(NodeId id) {
  return static_cast<std::uint32_t>(id);
}

namespace btcpp {
struct EntryPrograms;
}

// Index into BehaviorTree::variables, in the order of declaration.
enum class StateVariableId : std::uint32_t {};
constexpr std::uint32_t index(StateVariableId id) {
  return static_cast<std::uint32_t>(id);
}

// A named set of automata (section 8 of docs/semantics.md). Those of XML trees
// are named after the engine: the releases of BehaviorTree.CPP, and the
// branches of Nav2. Btcpp4 is the newest release, Lyrical and main have the
// same nodes.
enum class Profile : std::uint8_t {
  Paper,
  Btcpp351,
  Btcpp35,
  Btcpp36,
  Btcpp37,
  Btcpp38,
  Btcpp40,
  Btcpp41,
  Btcpp42,
  Btcpp43,
  Btcpp44,
  Btcpp45,
  Btcpp46,
  Btcpp47,
  Btcpp48,
  Btcpp49,
  Btcpp410,
  Btcpp4,
  PyTrees,
  Nav2Galactic,
  Nav2Humble,
  Nav2Iron,
  Nav2Jazzy,
  Nav2Kilted,
  Nav2Lyrical,
  Nav2Main
};

// The release of BehaviorTree.CPP that it stands on, 4.8.3 as 40803: of a minor
// release its last patch, of a branch of Nav2 the one in its ROS distribution.
// 0 for those that stand on none.
struct ProfileRow {
  Profile profile{};
  std::string_view name;
  int release = 0;
};
inline constexpr std::array kProfiles = {
    ProfileRow{Profile::Paper, "paper", 0},
    ProfileRow{Profile::Btcpp351, "btcpp-3.5.1", 30501},
    ProfileRow{Profile::Btcpp35, "btcpp-3.5", 30506},
    ProfileRow{Profile::Btcpp36, "btcpp-3.6", 30601},
    ProfileRow{Profile::Btcpp37, "btcpp-3.7", 30700},
    ProfileRow{Profile::Btcpp38, "btcpp-3.8", 30808},
    ProfileRow{Profile::Btcpp40, "btcpp-4.0", 40002},
    ProfileRow{Profile::Btcpp41, "btcpp-4.1", 40101},
    ProfileRow{Profile::Btcpp42, "btcpp-4.2", 40201},
    ProfileRow{Profile::Btcpp43, "btcpp-4.3", 40308},
    ProfileRow{Profile::Btcpp44, "btcpp-4.4", 40403},
    ProfileRow{Profile::Btcpp45, "btcpp-4.5", 40502},
    ProfileRow{Profile::Btcpp46, "btcpp-4.6", 40602},
    ProfileRow{Profile::Btcpp47, "btcpp-4.7", 40703},
    ProfileRow{Profile::Btcpp48, "btcpp-4.8", 40804},
    ProfileRow{Profile::Btcpp49, "btcpp-4.9", 40901},
    ProfileRow{Profile::Btcpp410, "btcpp-4.10", 41000},
    ProfileRow{Profile::Btcpp4, "btcpp-4", 41000},
    ProfileRow{Profile::PyTrees, "py_trees", 0},
    ProfileRow{Profile::Nav2Galactic, "nav2-galactic", 30600},
    ProfileRow{Profile::Nav2Humble, "nav2-humble", 30807},
    ProfileRow{Profile::Nav2Iron, "nav2-iron", 30807},
    ProfileRow{Profile::Nav2Jazzy, "nav2-jazzy", 40901},
    ProfileRow{Profile::Nav2Kilted, "nav2-kilted", 40900},
    ProfileRow{Profile::Nav2Lyrical, "nav2-lyrical", 41000},
    ProfileRow{Profile::Nav2Main, "nav2-main", 41000}};
static_assert(is_indexed(kProfiles, &ProfileRow::profile) &&
              kProfiles.back().profile == Profile::Nav2Main);

constexpr const ProfileRow& row_of(Profile profile) {
  return kProfiles[static_cast<std::size_t>(profile)];
}
constexpr std::string_view profile_name(Profile profile) {
  return row_of(profile).name;
}
constexpr int engine_release(Profile profile) {
  return row_of(profile).release;
}
std::optional<Profile> profile_named(std::string_view name);
// "4.8.3" of 40803.
std::string release_text(int release);

// Trees in the XML of BehaviorTree.CPP: one thread ticks the nodes, one after
// another, and a node that is reset is idle.
constexpr bool is_engine(Profile profile) { return profile != Profile::Paper; }
// Release 3 of the engine: nothing is skipped, and no node answers running
// only to let others be heard.
constexpr bool is_release_3(Profile profile) {
  return engine_release(profile) > 0 && engine_release(profile) < 40'000;
}
constexpr bool has_nav2(Profile profile) {
  return profile >= Profile::Nav2Galactic;
}
// Whether RoundRobin begins again behind its last child, whatever it is told;
// from lyrical on it has `wrap_around` (Nav2 10ad099d9).
constexpr bool wraps_round(Profile profile) {
  return profile != Profile::Nav2Lyrical && profile != Profile::Nav2Main;
}

// Whether SpeedController, reset, goes on with its period; from humble on it
// begins anew (Nav2 ff958bb13).
constexpr bool keeps_speed_period(Profile profile) {
  return profile == Profile::Nav2Galactic;
}

// The value of a node's rstatus field (paper, section 3.1). In XML trees it is
// the status that the engine keeps of the node, NoRetStatus being IDLE; a node
// that answers SKIPPED stays idle, or running where its tick had begun, or
// ended where nobody has reset it; before 4.3.4 it is skipped until a reset.
enum class NodeStatus : std::uint8_t {
  NoRetStatus,
  Success,
  Failure,
  Running,
  HaltMe,
  Skipped,
  SkippedRunning,
  SkippedEnded
};
inline constexpr std::array<std::string_view, 5> kStatusNames = {
    "no_ret_status", "success", "failure", "running", "halt_me"};
inline constexpr std::array<std::string_view, 8> kPyTreesStatusNames = {
    "invalid", "success", "failure",         "running",
    "halt_me", "skipped", "skipped_running", "skipped_ended"};
inline constexpr std::array<std::string_view, 8> kEngineStatusNames = {
    "idle",    "success", "failure",         "running",
    "halt_me", "skipped", "skipped_running", "skipped_ended"};
// The names of all values of rstatus in trees of this profile.
std::span<const std::string_view> status_names(Profile profile);

// Defined in model/tree/node_types.hpp, with a row of facts for each.
enum class NodeType : std::uint8_t;

enum class Moves : std::uint8_t {
  Default,  // an enumeration that nothing in the tree writes is free; all else
            // is sampled
  Free,     // changes by itself, at any instant: an enumeration along its
            // transitions, a number to any value
  Sampled   // changes only where a node writes it
};

// From `least` to `greatest`, which may be infinite.
struct NumberRange {
  double least = 0;
  double greatest = 0;
};

// What a state of a blackboard entry stands for: one or more numbers or texts;
// neither when the entry is empty or its value is not known.
struct EntryValue {
  std::optional<NumberRange> numbers;
  std::optional<std::string> text;
  bool is_any_text = false;
};

// Closed interval in ticks, 0 <= min <= max.
inline constexpr int kEndless = std::numeric_limits<int>::max();
struct Duration {
  int min = 0;
  int max = 0;  // kEndless: no time is too long

  friend bool operator==(const Duration&, const Duration&) = default;
};
inline constexpr Duration kAnyDuration{0, kEndless};
// As it is written: "[2,5]", "[2,inf]".
std::string duration_text(const Duration& duration);

// A number in [min, max], counted in steps of `scale`; or an enumeration whose
// values are 0, 1, … in the order of `states` (then min = 0, max =
// states.size() - 1).
struct StateVariable {
  std::string name;
  std::vector<std::string> states;  // empty for a number
  std::vector<EntryValue> values;   // of a blackboard entry, for each state
  // Of a blackboard entry that is declared: the states that it may be measured,
  // or move to, ascending; and for each state what is executed on real values
  // when it comes there.
  std::vector<int> measured;
  std::vector<std::int32_t> programs;
  bool is_declared_range = false;  // by :min and :max
  // For each state the first one of the same value, whose name is shown: the
  // engine may keep a value in several ways. Empty where all states differ.
  std::vector<int> alike;
  int min = 0;
  int max = 0;
  int initial = 0;
  Scale scale;
  // Allowed changes of an enumeration, present value to next; `:all` is
  // written out. Staying is always allowed and never listed.
  std::vector<std::pair<int, int>> transitions;
  // For each of them, how long its first state has lasted when a free variable
  // takes it; empty where none says so. It is left before any has lasted
  // longer.
  std::vector<Duration> lasting;
  Moves moves = Moves::Default;  // as written
  SourceSpan span;               // of the name

  bool is_enumeration() const { return !states.empty(); }
  // The text of a value: the name of its state (see `alike`), or the number.
  std::string value_name(int value) const;
};

struct StateAssignment {
  StateVariableId variable{};
  Expression value;  // over state variables and statuses
  SourceSpan span;
  Expression fits = {};  // where not, the value lies between two steps
};

// What an argument of a .btf file is evaluated to when its node is ticked: the
// value of the expression, divided by 10^decimals.
struct ArgumentValue {
  Expression value;  // over state variables and statuses
  int decimals = 0;
  int min = 0;  // what the expression stays between
  int max = 0;
  std::vector<std::string> names = {};  // of min, min + 1, …; of a number none
};

// One `key value` pair of :args, or a port of an XML node.
struct Argument {
  std::string key;
  std::string value;  // as written
  // Nothing where the program around the tree gives it, and in XML.
  std::optional<ArgumentValue> known = {};
  SourceSpan span = {};  // of the value
};

// What an XML leaf does besides answering (BehaviorTree.CPP 4.10,
// src/action_node.cpp; Nav2's plugins).
enum class LeafMemory : std::uint8_t {
  None,                     // every tick runs it anew
  Latched,                  // a result stands until the node is reset
  Unknown,                  // either of the two
  FirstTickFails,           // after a reset it first looks, and fails
  FirstTickOfLifeFails,     // looks once, whatever resets it
  FirstTickOfLifeSucceeds,  // likewise, and succeeds
  SuccessStays              // having succeeded once it never fails again
};

// What a step of a run does with blackboard entries, when it is executed on
// real values: an index into btcpp::EntryPrograms::programs.
inline constexpr std::int32_t kNoProgram = -1;
enum class ScriptOutcomeKind : std::uint8_t { Holds, Fails, Ends, Throws };
struct ScriptStep {
  std::int32_t program = kNoProgram;
  ScriptOutcomeKind outcome = ScriptOutcomeKind::Ends;
};

// What an Action or Condition may do, from its defaction or defcondition.
struct LeafContract {
  bool may_succeed = true;
  bool may_fail = true;
  bool may_run = true;    // never for a condition
  bool may_skip = false;  // XML trees only
  LeafMemory memory = LeafMemory::None;
  Expression requirement;  // where it is false, the leaf can only fail
  // Where this is true it does not fail, and where it is false not succeed.
  Expression decision;
  // XML trees: where these may be false.
  Expression unmet;
  Expression decided_against;
  std::vector<StateAssignment> on_success;
  std::vector<StateAssignment> on_failure;
  // XML trees: when it answers running or skipped, and when it is halted.
  std::vector<StateAssignment> on_running;
  // XML trees: declared entries that its ports write.
  std::vector<StateVariableId> measures;
  // XML trees: where what it writes is none of the values that are declared.
  Expression success_leaves = Expression::constant(0);
  Expression failure_leaves = Expression::constant(0);
  // XML trees: what is executed for these.
  std::int32_t requirement_program = kNoProgram;
  std::int32_t decision_program = kNoProgram;
  std::int32_t success_program = kNoProgram;
  std::int32_t failure_program = kNoProgram;
  std::int32_t running_program = kNoProgram;
  LeafMeaning meaning;

  // What it needs to succeed.
  Expression needed() const { return both(requirement, decision); }
};

// A script of BehaviorTree.CPP over the state variables. Where it depends on
// entries that are no state variables it may come out either way.
struct Script {
  std::string text;                          // as written, in one line
  std::vector<StateAssignment> assignments;  // in order
  Expression may_hold;  // where its value may be true: everywhere when empty
  Expression may_fail;  // where it may be false
  // Where it reads what the tree has not written: it throws unless the program
  // around the tree has written it.
  std::optional<Expression> may_lack;
  // Where it gives an entry what that is declared not to hold: the run ends.
  std::optional<Expression> may_leave;
  // Where it may throw else; without it, it throws for certain where it may
  // neither hold nor fail.
  std::optional<Expression> may_throw;
  std::int32_t program = kNoProgram;
};

// A blackboard entry modelled more loosely than the engine has it: it may hold
// any value, or its values are told apart in ranges only.
struct OpenEntry {
  std::string name;
  std::string reason;  // "more than 128 values"
  SourceSpan span;     // where it is written or read first
  std::uint32_t included = 0;
  // Scripts alone write it: the engine knows the value. Else the program around
  // the tree may write it at any time.
  bool is_rough = false;
  std::size_t group = 0;  // of entries that are mentioned together
};

// When an XML node's script runs: before its tick, as _failureIf, … and after.
enum class ScriptTime : std::uint8_t {
  FailureIf,
  SuccessIf,
  SkipIf,
  While,
  OnHalted,
  OnFailure,
  OnSuccess,
  Post
};
inline constexpr std::size_t kScriptTimes = 8;

// Where a program finds an entry: on the blackboard that this node has, by its
// key; and the name that rules have for it.
struct EntryHome {
  NodeId node{};
  std::string name;
};

// A node's access to a blackboard entry. A port that may write as well as read
// does both; one of an unknown direction, too.
struct EntryUse {
  NodeId node{};
  std::uint32_t entry = 0;  // an index into BehaviorTree::entries
  bool reads = false;
  bool writes = false;
  bool is_port = false;                 // else a script
  std::optional<ScriptTime> when = {};  // of a script; its own has none
  // What the script gives it, where that is a literal: "'moving'", "0".
  std::string literal = {};
};

// In `repetitions` of XML nodes: without end, and an unknown number.
inline constexpr int kEndlessRounds = -1;
inline constexpr int kOpenRounds = -2;
// In a Duration of XML nodes: any number of ticks.
inline constexpr int kUnboundedTicks = std::numeric_limits<int>::max();

// A threshold of a Parallel: a negative one counts from the end, so that -1 is
// all of the children.
constexpr int threshold_of(int written, int children) {
  const int from_end = children + written + 1;
  return written >= 0 ? written : from_end > 0 ? from_end : 0;
}

// Of an AnswerMap: what it answers for each answer of its child.
struct AnswerTable {
  NodeStatus of_success = NodeStatus::Success;
  NodeStatus of_failure = NodeStatus::Failure;
  NodeStatus of_running = NodeStatus::Running;
};

// Of an AnswerQueue: the same answer, so many times.
struct QueuedAnswers {
  NodeStatus answer{};
  int times = 1;
};

struct Node {
  NodeType type{};
  std::string name;  // :name, else :ID, else Type<line>; in XML name or ID
  std::string id;    // :ID, may be empty; in XML the registered type
  std::string path;  // in XML the fullPath, "Move::4/patrol"
  SourceSpan span;   // of the node type's word
  // Where it stands: 0 for BehaviorTree::file, from 1 those that it includes.
  std::uint32_t included = 0;
  NodeId parent{};  // a root is its own parent
  std::vector<NodeId> children;

  bool halt = false;   // :halt 1
  bool wait = false;   // :wait 1
  bool loop = false;   // BehaviorTree :loop 1
  bool wakes = false;  // the root of an XML tree: tickOnce, not tickExactlyOnce
  int threshold = 0;   // Parallel :success; the number of children for
                       // ParallelAll
  int repetitions = 0;               // Repeat :repeat, RetryUntilSuccessful
                                     // :num_attempts, Recovery :num_retries
  double rate_hz = 0;                // RateController
  std::optional<Duration> duration;  // Wait and Action, in ticks
  LeafContract contract;             // Action (:SF clears may_run), Condition
  std::optional<LeafFault> fault;    // of these and SetSV: put in by `whatif`
  StateVariableId variable{};        // SetSV
  Expression expression;             // Eval without :=
  std::optional<StateAssignment> assignment;  // Eval with :=
  std::vector<Argument> arguments;

  // Of XML trees.
  bool is_guessed = false;    // a leaf that no model or contract tells of
  int failure_threshold = 0;  // Parallel, ParallelAll
  // A negative success_count: skipped children count as succeeding.
  bool counts_skipped = false;
  // RunOnce then_skip, TryCatch catch_on_halt, RoundRobin wrap_around; of a
  // root: its caller may halt it while it runs.
  bool option = false;
  // What a Precondition, Loop, WhenUpdated or BlackboardCheck answers instead
  // of ticking its child.
  NodeStatus otherwise = NodeStatus::Failure;
  boost::container::flat_map<ScriptTime, Script> scripts;
  // The script of a Script or Precondition; of a Switch, one for each case.
  std::vector<Script> own_scripts;
  bool answers_value = false;  // a Script: ScriptCondition
  // A number that tick() reads by a port, if any: it throws where none can be
  // read.
  std::vector<Script> readings;

  // Of py_trees.
  AnswerTable becomes;               // AnswerMap
  std::vector<QueuedAnswers> queue;  // AnswerQueue
  // Where the queue goes on behind its last answer, an index into `queue`.
  // `option`: at its beginning, whenever the node has not been running.
  std::size_t queue_goes_on = 0;
  // PolicyParallel: which children have to succeed, counted from 0; or, where
  // there are none, one of them (`option`).
  std::vector<std::size_t> selected;
  bool is_synchronised = false;

  // Null where it has none.
  const Script* script(ScriptTime time) const {
    const auto found = scripts.find(time);
    return found == scripts.end() ? nullptr : &found->second;
  }
  bool is_root() const;
};

// Everything one .btf file says: its state variables and its trees, which run
// in parallel when there is more than one. Subtrees are expanded in place.
struct BehaviorTree {
  std::string file;                   // as given by the user
  std::vector<std::string> included;  // more files, of XML trees
  Profile profile = Profile::Paper;
  std::vector<StateVariable> variables;
  std::vector<Node> nodes;    // in pre-order, indexed by NodeId
  std::vector<NodeId> roots;  // BehaviorTree nodes, in the order they run
  // Of XML trees.
  std::vector<OpenEntry> open_entries;
  std::vector<std::string> entries;    // their names, modelled or not
  std::vector<EntryHome> entry_homes;  // of each of these
  std::vector<EntryUse> entry_uses;    // by node
  std::shared_ptr<const btcpp::EntryPrograms> programs;

  const Node& node(NodeId id) const { return nodes[index(id)]; }
  // The file that a node stands in.
  const std::string& file_of(NodeId id) const;
  const StateVariable& variable(StateVariableId id) const {
    return variables[index(id)];
  }
};

// "land_btn12": a name that is unique in the tree (paper, section 3).
std::string unique_name(const BehaviorTree& tree, NodeId node);

// The name when no other node has it, else with its line, "land@23"; where that
// is not enough, the path of an XML node, or "land_btn12".
std::string short_name(const BehaviorTree& tree, NodeId node);
// The same of all nodes, in one go.
std::vector<std::string> short_names(const BehaviorTree& tree);

// The name, or the type where the reader made the name of it and a line: what
// stays when lines move.
std::string stable_name(const Node& node);

// The file that a node stands in, from the folder of the tree's own file.
std::string short_file(const BehaviorTree& tree, NodeId node);

// "line 23", with the file where it is an included one: "land.xml, line 23".
std::string line_of(const BehaviorTree& tree, NodeId node);

// "land (line 23)"; where several nodes of this name stand in the line, with
// the path of an XML node, or "land_btn12", for the name.
std::string name_and_line(const BehaviorTree& tree, NodeId node);

// "fail_mission/land": names from below the root down to the node.
std::string path_name(const BehaviorTree& tree, NodeId node);

// Every node in post-order, each root last in its tree: the order in which
// the paper numbers its processes.
std::vector<NodeId> post_order(const BehaviorTree& tree);

// Where the ways from the root to two nodes part: the lowest node above both,
// and which of its children, from 0, each stands in.
struct Fork {
  NodeId node{};
  std::size_t one = 0;
  std::size_t other = 0;
};
// Nothing where one of the nodes is above the other, or in another tree.
std::optional<Fork> fork_of(const BehaviorTree& tree, NodeId one, NodeId other);

// The root of the tree that a node stands in.
NodeId root_of(const BehaviorTree& tree, NodeId node);

// True when the node may write the variable (SetSV, :=, the effects of a
// contract, or scripts); when some node of the tree may.
bool writes(const Node& node, StateVariableId variable);
bool is_written(const BehaviorTree& tree, StateVariableId variable);

// True when the variable changes by itself (section 2 of docs/semantics.md).
bool moves_freely(const BehaviorTree& tree, StateVariableId variable);

// Reads the text of a .btf file, a tick of which takes `tick_ms`. Every error
// is reported, at most 20; nothing is thrown. Source: the paper's listings;
// grammar in docs/btf.md.
Result<BehaviorTree> read_btf(std::string_view file_name, const FileText& text,
                              int tick_ms = 100);

}  // namespace btcheck
