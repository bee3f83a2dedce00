// SPDX-License-Identifier: MIT
//
// A run as text: told tick by tick, one state of it as a tree, and one line for
// each tick.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "text/utf8.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

enum class Detail : unsigned char {
  Events,    // what leaves answer, variables that change, halts, the end
  EveryStep  // and every edge of every automaton
};

// How much is told, and how wide a line may be where it is laid out.
struct Layout {
  Detail detail = Detail::Events;
  std::size_t width = kLineWidth;

  Layout() = default;
  Layout(Detail how_much, std::size_t columns = kLineWidth)
      : detail(how_much), width(columns) {}
};

struct TextStyle : Layout {
  std::string indent = "    ";
  // The state with the occurrence that a real-time pattern is violated by,
  // marked in the text with these words.
  std::optional<std::size_t> trigger_state;
  std::string trigger_words = "asked here, not answered";

  TextStyle() = default;
  explicit TextStyle(Layout layout) : Layout(layout) {}
};

// Lines ending in newlines:
//
//     tick 1  start_drone -> success                       chosen
//             measure_battery: battery := Low              chosen
//
// "chosen" stands where the world outside decided: the answer of an action or
// a condition, the value a SetSV finds, a variable that moves by itself.
std::string run_text(const RecordedRun& run, const TextStyle& style);
std::string run_text(const BehaviorTree& tree, const Network& network,
                     const Run& run, const TextStyle& style);

// The same in six lines at most, one for each tick: what these nodes do, and
// what else decides it.
//
//     tick 1  GlobalUpdatedGoal -> success, ComputePathToPose -> failure
//
// Lines are of kBriefWidth columns, or of `width` where that is more.
inline constexpr std::size_t kBriefWidth = 100;
std::string brief_text(const RecordedRun& run, const std::vector<NodeId>& shown,
                       std::size_t width = kBriefWidth);

// Unvisited: a subtree that has not been ticked yet is one line.
enum class Folding : unsigned char { None, Unvisited };

// A line for each node at one state of a run, ending in newlines. What a node
// did in an earlier tick stands in parentheses:
//
//     inspect                     running
//       Sequence3                 running
//         look                    (success)
//         ReactiveFallback7 and 4 below it
std::string tree_text(const RecordedRun& run, std::size_t state,
                      Folding folding);

// Takes a run step by step and writes a line when a root has answered:
//
//     tick 3: root=running battery=Low fls=0 Sequence17=running look=success
//
// `root` is what the tree answered; then come all state variables as declared,
// with their values at the end of the tick, and the nodes below the root that
// were ticked or halted in it, in pre-order, with all their answers in order:
// `success,halted`. `error` is a node whose assignment left the range of its
// variable; `none` means no answer: there the run ended within the tick. With
// several trees a line begins `tick 3 of NAME: `, and has that tree's nodes.
//
// A node is called by its name, `land@23` where several share it, `land_btn12`
// where that is not enough or a state variable has the name. A name with a
// blank, a quote, = or a comma is put in double quotes.
class TickLines {
 public:
  TickLines(const BehaviorTree& tree, const Network& network);

  // One more step: the line that it completes, without a newline, or "".
  std::string take(const RunStep& step);
  // The lines of ticks that have begun and not ended, each with a newline;
  // `last` is the last state.
  std::string rest(const Valuation& last) const;

 private:
  struct Tick {  // of a root, the last
    int number = 0;
    bool is_open = false;
  };

  void note(NodeId node, const Location& location);
  std::string line(NodeId root, std::string_view answer,
                   const Valuation& state) const;

  const BehaviorTree& tree_;
  const Network& network_;
  std::vector<std::string> keys_;  // by node
  std::vector<NodeId> root_of_;    // by node
  std::vector<Tick> ticks_;        // by node; of roots
  std::vector<bool> is_visited_;   // by node: ticked or halted in this tick
  std::vector<std::string> answers_;
};

// What the nodes are called in these lines, by NodeId.
std::vector<std::string> tick_line_keys(const BehaviorTree& tree);

// The lines of a run, as far as it is told: a loop once.
std::string tick_lines(const BehaviorTree& tree, const Network& network,
                       const Run& run);

}  // namespace btcheck
