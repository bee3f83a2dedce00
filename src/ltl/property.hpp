// SPDX-License-Identifier: MIT
//
// Properties as their author wrote them: formulas over atoms not yet bound.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnostic.hpp"
#include "ltl/formula.hpp"

namespace btcheck {

// What an atom says of a node or process. Events hold in the states of the
// node's automaton that are named after them.
enum class AtomKind : std::uint8_t {
  NodeEvent,   // land@23.ticked: node, word = ticked|success|failure|running|
               // halted|done|active|ended
  Comparison,  // left op right, e.g. fls > 3, x.status == success, RR.failed<3
  Range,       // left in low..high
  ProcessState,  // drone/5/state done: process, word = the location or value
  Keyword,       // tick, dead, stuck
};

enum class Relation : std::uint8_t {
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual
};

// One side of a comparison: a number, or a name to be looked up: a state
// variable, a symbol, `node.status`, `node.local`, `btnode[x].rstatus`.
struct Operand {
  bool is_number = false;
  std::int32_t number = 0;
  std::string node;  // node reference; empty for a plain name
  std::string name;  // variable, symbol, "status", or a local's name
  SourceSpan span;
};

// An atom with the place it was written at.
//
// A node reference is kept as written: `land`, `fail_mission/land`, `land@23`,
// `land_btn12`, `btn12`, or the paper's `drone/8`.
struct Atom {
  AtomKind kind = AtomKind::NodeEvent;
  std::string node;       // NodeEvent: the node reference
  std::string word;       // NodeEvent, ProcessState, Keyword
  std::string component;  // `drone` of drone/5/state …, and of value (…)
  std::optional<std::int32_t> process;  // `5` of drone/5/…: where a
                                        // ProcessState looks, or the process
                                        // in whose scope names are looked up
  Relation relation = Relation::Equal;
  Operand left;
  Operand right;         // Comparison
  std::int32_t low = 0;  // Range
  std::int32_t high = 0;
  std::string text;      // as written, for messages
  SourceSpan span;       // of the whole atom
  SourceSpan node_span;  // of the node reference
  SourceSpan word_span;  // of `word`
};

enum class PropertyForm : std::uint8_t {
  Never,         // absent P: no reachable state satisfies `formula`
  Invariant,     // always P: every reachable state does
  Possible,      // some reachable state does
  DeadlockFree,  // no reachable state is dead
  Ltl,           // every run satisfies `formula`
  Response       // P leadsto Q within [a, b]: `formula` = P, `answer` = Q
};

enum class Expectation : std::uint8_t { None, Holds, Violated };

struct Property {
  std::string name;   // as written, or proveN for the Nth unnamed one; a
                      // repeated name gets #2, #3, …
  std::string title;  // its ## comment, one line
  std::vector<std::string> tags;  // of `[safety, req=SR-12]`, as written
  Expectation expectation = Expectation::None;
  PropertyForm form = PropertyForm::Ltl;
  FormulaId formula{};  // Never, Invariant, Possible, Response: no temporal
                        // operators in it
  FormulaId answer{};   // Response only
  int from = 0;         // Response: the closed interval, in units of time
  int to = 0;
  std::string text;  // the body as written, white space collapsed
  SourceSpan span;   // of the name, or of `prove`
};

// What one property file says.
struct PropertyFile {
  std::string file;
  std::string tree;                  // "" when it names none
  std::optional<std::string> ticks;  // root, leaves, nodes, none
  std::vector<Property> properties;
  FormulaPool formulas;     // of all properties
  std::vector<Atom> atoms;  // numbered by the atoms of `formulas`
};

// Reads the text of a property file; grammar in docs/properties.md. Every
// error is reported, at most 20; a file with an error has no value.
Result<PropertyFile> read_properties(std::string_view file_name,
                                     std::string_view text);

}  // namespace btcheck
