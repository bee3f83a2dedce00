// SPDX-License-Identifier: MIT
//
// Whether two trees do the same, for every caller and every world; if not, a
// shortest run that one has and the other has not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "check/diff/pairing.hpp"
#include "check/diff/seen_graph.hpp"
#include "explore/minimise/play.hpp"
#include "explore/minimise/traces.hpp"
#include "explore/state/limits.hpp"
#include "explore/state/transition_system.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"
#include "text/input_file.hpp"

namespace btcheck {

// Who ticks the trees.
enum class Caller : std::uint8_t {
  Any,  // ticks them again after they have ended, and may halt them between two
        // ticks: what a tree is used as
  Once  // until they have ended, as the program that runs a mission
};

struct DiffOptions {
  TickSemantics ticks = TickSemantics::Root;
  Caller caller = Caller::Any;
  // What is seen beside the beginning of each tick, the answers of the roots
  // and halts by the caller: "leaves", what happens to the leaves; "root",
  // nothing else; or a node, as rules name it. Empty: the leaves.
  std::vector<std::string> observe = {};
  Limits limits = {};
};

// Something that is seen; the roots first.
struct WatchedPair {
  NodePair nodes;
  bool is_root = false;
  std::string otherwise = {};  // what it is told in the other tree instead
};

// What one has and the other has not.
struct Difference {
  enum class Kind : std::uint8_t {
    Runs,     // a run
    Choices,  // no run, but when it is settled how one goes on
    Told      // no run, but what a leaf is told when it is ticked
  };
  Kind kind = Kind::Runs;
  // What is seen: of Runs both have it, but for the last with TraceEnd::Seen;
  // of Told it ends with the leaf that is ticked; of Choices empty.
  std::vector<SeenEvent> run;
  // Of Runs.
  TraceEnd end = TraceEnd::Seen;
  std::size_t side = 0;            // who has it: 0 the one tree, 1 the other
  std::vector<SeenEvent> instead;  // what the other can do there
  bool other_stops = false;
  bool other_unseen = false;
  std::vector<PlayRound> play;  // of Choices
};

struct DiffSide {
  BehaviorTree tree;  // as it is called
  Network network;
  std::uint64_t states = 0;
  // Of Runs and Told: a shortest run that is seen as the difference, as far as
  // this tree has it.
  std::vector<Step> steps = {};
};

struct Diff {
  std::array<DiffSide, 2> sides;
  std::vector<WatchedPair> watched;  // by number, as in SeenEvent
  std::optional<Difference> difference;
  StopReason stopped = StopReason::None;  // else it is not known
  std::uint32_t classes = 0;  // states of both that nobody can tell apart
  std::string error;          // a run could not be replayed: our mistake

  bool is_equivalent() const {
    return stopped == StopReason::None && !difference;
  }
};

struct DiffTree {
  const BehaviorTree& tree;
  SourceText source;  // of its file
};

// Errors are those of names that no node has, and of numbers with too many
// values.
Result<Diff> compare_trees(const DiffTree& one, const DiffTree& other,
                           const DiffOptions& options);

}  // namespace btcheck
