// SPDX-License-Identifier: MIT
//
// A suite of tests: scripted runs, which tell what the leaves answer and what
// every node does because of it, tick by tick. Together they reach all that the
// exhaustive search has proven possible and that can be forced on an engine.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check/questions/defaults.hpp"
#include "explore/state/limits.hpp"
#include "explore/state/step.hpp"
#include "model/btcpp/script/value.hpp"
#include "model/tree/tree.hpp"
#include "suites/forced_network.hpp"

namespace btcheck {

// An answer or a halt of a node: a cell of the table of the default report.
using Cell = std::pair<NodeId, NodeQuestion>;

// What is written into an entry: on the blackboard that the node `home` has.
struct EntryWrite {
  NodeId home{};
  std::string key;
  btcpp::ScriptValue value;  // a number or a text
};

// One answer of a leaf, and what it writes before.
struct LeafAnswer {
  std::string answer;  // "running"; of a SetSV the value that it finds
  std::vector<EntryWrite> writes;
};

struct SuiteTick {
  std::vector<EntryWrite> before;            // what the program writes
  std::map<StateVariableId, int> variables;  // and what moves by itself
  std::string root;                          // its answer; "" where it throws
  // All answers of those that were ticked or halted, in pre-order:
  // "success,halted".
  std::vector<std::pair<NodeId, std::string>> nodes;
};

struct SuiteTest {
  std::string name;   // an identifier of C++, which says what it shows
  std::string about;  // the same in words
  std::string code;   // of the finding or the name of the rule, if any
  std::map<NodeId, std::vector<LeafAnswer>> leaves;
  std::vector<SuiteTick> ticks;
  std::set<Cell> cells;           // that it reaches
  bool has_script = false;        // `simulate --script` can play it
  std::set<std::uint32_t> edges;  // of the nodes' automata
};

// A cell that is possible and that no test reaches.
struct LeftOut {
  Cell cell;
  std::string reason;  // "real time: Sleep"
};

struct Suite {
  std::vector<SuiteTest> tests;
  std::set<Cell> proven;            // answers and halts that are possible
  std::set<Cell> reached;           // of these, by some test
  std::vector<LeftOut> left_out;    // the others, in pre-order
  std::vector<EntryWrite> initial;  // before the first tick
  std::size_t edges = 0;            // of nodes' automata that tests take
  std::size_t forced_edges = 0;     // that they could take
  bool is_complete = false;         // the search for runs was not stopped
};

// A run to be told as a test besides those that are found: what it shows, in a
// few words, and the finding or rule that it belongs to.
struct NamedRun {
  std::string about;
  std::string code;
  std::vector<Step> steps;
};

// Searches twice: for what can be forced, and for short runs that do all of it.
// `defaults` is what the exhaustive search of the same tree has said, in the
// network of `asked`, where entries may be declared less closely.
Suite make_suite(const ForcedNetwork& forced, const ForcedNetwork& asked,
                 const DefaultReport& defaults,
                 const std::vector<NamedRun>& also, const Limits& limits);

// What the program puts into entries before the first tick, as it is declared.
std::vector<EntryWrite> initial_writes(const BehaviorTree& tree);

// What becomes of one run: a test without a name. It ends with the last tick
// that is over; nothing where there is none.
std::optional<SuiteTest> told_test(const ForcedNetwork& forced,
                                   const std::vector<Step>& steps);

// "14 tests reach 96 of 96 answers and halts that are proven possible (100 %)".
std::string suite_summary(const Suite& suite, const BehaviorTree& tree);

// "success", of a question about nodes.
inline std::string_view word_of(NodeQuestion question) {
  return kNodeQuestionNames[static_cast<std::size_t>(question)];
}

// A name that C++ and Python take: letters, digits and single underscores.
std::string identifier(std::string_view text);

}  // namespace btcheck
