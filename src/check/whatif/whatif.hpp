// SPDX-License-Identifier: MIT
//
// What the mission does when something breaks: each fault of each leaf, over
// all runs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "check/whatif/answer_graph.hpp"
#include "check/whatif/faults.hpp"
#include "check/whatif/unnoticed.hpp"
#include "explore/state/limits.hpp"
#include "explore/state/transition_system.hpp"
#include "ltl/rules/property.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"
#include "text/input_file.hpp"

namespace btcheck {

// What a fault does to the mission, the worst first.
enum class Harm : std::uint8_t {
  Silent,      // it succeeds, what the leaf is for was not done, nobody notices
  NeverEnds,   // some run has no end any more
  RuleBreaks,  // a rule that holds otherwise
  LeftOn,      // it ends, and something runs or is on that otherwise is not
  Throws,      // an exception leaves the tree
  Fails,       // it cannot succeed any more, and says so
  MayFail,     // some runs fail that otherwise do not
  Survives,    // it ends as runs do that ask the leaf and have no fault
  NotAsked,    // the fault does not strike on any run
  Undecided    // a limit was reached
};
inline constexpr std::size_t kHarms = 10;
struct HarmFacts {
  std::string_view word;  // in tables and files
  std::string_view told;  // "succeeds, and nobody notices"
};
inline constexpr std::array<HarmFacts, kHarms> kHarmFacts = {{
    {"silent", "succeeds without it, and nobody notices"},
    {"never-ends", "never ends"},
    {"rule-breaks", "breaks a rule"},
    {"left-on", "ends with something left on"},
    {"throws", "ends by an exception"},
    {"fails", "always fails"},
    {"may-fail", "can fail"},
    {"survives", "ends as it does without the fault"},
    {"not-asked", "is never asked while all else works"},
    {"undecided", "not decided within the limits"},
}};
constexpr const HarmFacts& facts_of(Harm harm) {
  return kHarmFacts[static_cast<std::size_t>(harm)];
}

// Something that the success of one leaf begins, and that of others ends: so
// its contract says, or its name.
struct OnOff {
  NodeId on{};
  std::vector<NodeId> off;
};

// A rule, by its file and its place there.
struct RuleId {
  std::size_t file = 0;
  std::size_t rule = 0;
  friend bool operator==(const RuleId&, const RuleId&) = default;
};

// Over all runs on which the faults strike; of a tree without faults, over all.
struct Effect {
  bool strikes = false;
  bool succeeds = false;  // some run does
  bool fails = false;
  bool throws = false;
  bool hangs = false;  // some run comes to where no end is reached any more
  std::vector<RuleId> broken = {};        // rules, by their number
  std::vector<NodeId> left_running = {};  // when the mission has ended
  std::vector<NodeId> left_on = {};       // OnOff::on
  StopReason stopped = StopReason::None;
  std::uint64_t states = 0;
};

// How the mission gets on after a fault.
struct Recovery {
  NodeId caught_by{};           // does something else than pass it on
  std::vector<NodeId> through;  // leaves that are asked on no healthy run
  bool is_asked_again = false;  // the leaf itself
};

struct FaultRow {
  std::vector<InjectedFault> faults;  // one, or several at once
  Effect effect;
  Effect healthy;  // how runs that ask the leaf end without the fault
  Harm harm = Harm::Undecided;
  std::optional<Notice> notice = {};  // on the run that is shown
  // Of single faults: the most ticks from the strike to a notice or the end;
  // nothing where there is no such number.
  std::optional<int> within = {};
  std::optional<Recovery> recovery = {};
  std::vector<Step> steps = {};  // a shortest run that shows it; may be empty
  // Its network remembers what the rules of this file ask for.
  std::optional<std::size_t> rules = {};
  int struck_in = 0;             // the tick, from 1; 0: none
  int ended_in = 0;              // the last tick of the run
  std::vector<bool> asked = {};  // by node: leaves asked once all have struck
};

// What must not be: that the mission fails, cannot succeed, …
struct TopEvent {
  enum class Kind : std::uint8_t {
    Fails,
    CannotSucceed,
    NeverEnds,
    Throws,
    Rule
  };
  Kind kind{};
  RuleId rule = {};
};
// Whether it is, with these faults.
bool happens(const TopEvent& event, const Effect& effect);

// Sets of faults with which it can happen, and with none of their parts alone;
// the smallest first.
struct CutSets {
  TopEvent event;
  std::vector<std::vector<InjectedFault>> sets;
};

// How many faults end how, of the tree or of a part of it.
struct Score {
  std::array<std::size_t, kHarms> of{};
  std::size_t total() const;
  std::size_t of_harm(Harm harm) const {
    return of[static_cast<std::size_t>(harm)];
  }
};

struct WhatIf {
  FaultChoices choices;
  PossibleFaults possible;
  std::vector<PropertyFile> rules;  // those that hold without faults, by file
  std::vector<std::string> broken_rules;  // that do not: not asked again
  Effect healthy;
  std::vector<FaultRow> rows;  // the worst first
  int order = 1;
  std::vector<FaultRow> pairs;     // that do what neither fault does alone
  std::size_t pairs_searched = 0;  // of all, those that were worth it
  std::size_t pairs_in_all = 0;
  std::vector<CutSets> cut_sets;
  StopReason stopped = StopReason::None;
  std::string error;  // a run could not be replayed: our mistake

  Score score() const;
  Score score_below(const BehaviorTree& tree, NodeId node) const;
};

struct WhatIfOptions {
  FaultChoices choices;
  int order = 1;  // 2: pairs as well
  // By NodeId: whose answers are listened to, and which leaves have faults; all
  // above one have to be as well. What stands below is gone through, and seen
  // from outside. Empty: all.
  std::vector<bool> heard = {};
  TickSemantics ticks = TickSemantics::Root;
  Limits limits;
  unsigned threads = 1;
};

// A tree, and what is asked of it.
struct WhatIfInput {
  BehaviorTree tree;
  SourceText source;  // of the tree's file
  std::vector<PropertyFile> rules;
  std::vector<SourceText> rule_texts;  // of each of these
};
// Reads it; with what the readers have to say.
Result<WhatIfInput> what_if_input(const TreeInput& tree,
                                  const std::vector<InputFile>& rules);

// By NodeId: what does not stand below a SubTree; of a tree that is too large
// as a whole.
std::vector<bool> own_nodes(const BehaviorTree& tree);

// Errors are those of names in the rules, and of numbers of the tree that have
// too many values.
Result<WhatIf> what_if(const WhatIfInput& input, const WhatIfOptions& options);

// The tree of a row with its network, on which its steps are a run.
struct RowNetwork {
  BehaviorTree tree;
  Network network;
};
RowNetwork network_of(const WhatIfInput& input, const WhatIf& result,
                      const FaultRow& row, TickSemantics ticks);

}  // namespace btcheck
