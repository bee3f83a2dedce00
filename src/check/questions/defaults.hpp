// SPDX-License-Identifier: MIT
//
// The properties of a tree without a property file.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "check/bind/verdict.hpp"
#include "check/findings/suspicion.hpp"
#include "check/replay/run_tree.hpp"
#include "explore/reduce/observed.hpp"
#include "explore/state/step.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// What is asked of every node, in this order.
enum class NodeQuestion : std::uint8_t {
  Ticked,
  Success,
  Failure,
  Running,
  Halted,
  Skipped
};
inline constexpr std::size_t kNodeQuestionCount = 6;
inline constexpr std::array<std::string_view, kNodeQuestionCount>
    kNodeQuestionNames = {"ticked",  "success", "failure",
                          "running", "halted",  "skipped"};
// The location that a node is in when it is so.
inline constexpr std::array<LocationRole, kNodeQuestionCount>
    kNodeQuestionRoles = {LocationRole::Tick,    LocationRole::Success,
                          LocationRole::Failure, LocationRole::Running,
                          LocationRole::Halted,  LocationRole::Skipped};

// Can it happen? Holds: yes, and `run` is a shortest witness. Violated: no, by
// exhaustive search. Undecided: not within the limits.
struct Possibility {
  Verdict verdict = Verdict::Undecided;
  std::optional<KeptRun> run;
  int ticks() const { return run ? run->ticks() : 0; }
};

struct NodeReport {
  NodeId node{};
  std::array<Possibility, kNodeQuestionCount> answers;
};

// What is asked of the tree as a whole.
enum class TreeQuestion : std::uint8_t {
  CanSucceed,        // the root can succeed
  CanFail,           // the root can fail
  CanAlwaysEnd,      // AG EF root.ended
  CanAlwaysSucceed,  // AG EF root.success
  NeverStuck,        // no dead state with the root unfinished
  InRange,           // no assignment leaves its variable's range
  NoZeroTimeLoop     // not asked where no time passes
};
inline constexpr std::size_t kTreeQuestionCount = 7;

// The run is a witness of CanSucceed and CanFail, a counterexample of the
// others: of NoZeroTimeLoop with its loop.
struct TreeReport : Possibility {
  TreeQuestion question{};
  // A mission that is an endless loop never ends: no fault. Nor is what the
  // user allows, or knows.
  bool is_meant = false;
  std::optional<Severity> severity = {};  // what the user says it is
};
// The code of the finding that the answer is no: "BT2105", "" for none.
std::string_view code_of(TreeQuestion question);

// Guards that are not ticked again while an action to their right runs, and a
// run on which it is so: it ends with the action being ticked again.
struct StaleGuardReport {
  NodeId action{};
  std::vector<NodeId> guards;  // in pre-order
  std::optional<KeptRun> run;
};

// A leaf that still runs when a node above it has decided, and a run that ends
// with that node giving control back.
struct LeftRunningReport {
  NodeId leaf{};
  NodeId above{};
  NodeStatus decision{};  // Success or Failure
  std::optional<KeptRun> run;
};

// A run that ends with what a sighting describes; and on from there until what
// has to follow, if it does.
struct SightedRun {
  Sighting sighting;
  std::optional<Consequence> then;
  KeptRun run;
  std::optional<KeptRun> followed = {};
};

struct DefaultReport {
  std::vector<TreeReport> tree;
  std::vector<NodeReport> nodes;                // in pre-order
  std::vector<StaleGuardReport> stale_guards;   // by action, in pre-order
  std::vector<LeftRunningReport> left_running;  // as they were found
  std::vector<TreeFinding> findings;            // ranked
  // Of a report in parts: what was seen, told or not, for the next one.
  std::vector<SightedRun> sighted;
  SearchProgress progress;
  std::size_t searches = 0;  // of parts of the tree; 0: one of the whole
  StopReason stopped = StopReason::None;
  std::string open;  // StopReason::OpenEntries: what is not known, in words
  // With any, the runs told are possible, but not the shortest.
  Reduction reduction = Reduction::None;
  std::string error;  // set when a run could not be replayed: our mistake
};

// Whether random walks help a search that takes long.
enum class Sampling : std::uint8_t { None, WhenLong };

// Answers all of them with one breadth-first search. A reduction changes no
// answer, but the runs told are then not the shortest. What random walks see is
// told to the monitor of `limits` at once. Nothing depends on how many threads.
DefaultReport check_defaults(const BehaviorTree& tree,
                             const CompiledNetwork& system, Reduction reduction,
                             const Limits& limits,
                             Sampling sampling = Sampling::None,
                             unsigned threads = 1);

// What the answer no is worth: an error, but for CanSucceed a warning.
Severity severity_of(const TreeReport& report);
// True when nobody wants the answer: it has a code, and is not meant.
bool is_bad(const TreeReport& report);
// True when the answer is a fault of the mission: the exit code is 1.
bool is_fault(const TreeReport& report);

}  // namespace btcheck
