// SPDX-License-Identifier: MIT
//
// A property file as its author wrote it: formulas over atoms whose names have
// not been looked up in a tree yet.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ltl/formula/formula.hpp"
#include "ltl/formula/pattern.hpp"
#include "text/diagnostic.hpp"
#include "text/input_file.hpp"
#include "text/numbers.hpp"

namespace btcheck {

// Events hold in the states of a node's automaton that have their names.
enum class AtomKind : std::uint8_t {
  NodeEvent,   // land@23.ticked: node, word = ticked|success|failure|running|
               // halted|done|active|ended
  Comparison,  // left op right, e.g. fls > 3, x.status == success, RR.failed<3
  Range,       // left in low..high
  ProcessState,  // drone/5/state done: process, word = the location or value
  Keyword,       // tick, dead, stuck
  // Of the past (model/automata/past_memory.hpp), of and since: conditions on
  // single states:
  Once,        // once P
  Since,       // P since Q
  Previously,  // previously P: where the tick before ended
  // Events of the step that is about to be taken (state/event LTL):
  Enter,   // `of` is false now and true after it
  Leave,   // `of` is true now and false after it
  Moves,   // land@23.moves, battery.moves: node; its automaton takes the step
  Passes,  // time.passes: the step is one of time
};
constexpr bool is_step_event(AtomKind kind) { return kind >= AtomKind::Enter; }
constexpr bool is_past(AtomKind kind) {
  return kind >= AtomKind::Once && kind <= AtomKind::Previously;
}

enum class Relation : std::uint8_t {
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual
};

enum class Arithmetic : std::uint8_t { None, Add, Subtract, Multiply };

// One side of a comparison: a number, or the name of a state variable, a
// symbol, `node.status`, `node.local`, `btnode[x].rstatus`; or a calculation
// with two such operands, where only its span is set besides.
struct Operand {
  Arithmetic calculation = Arithmetic::None;
  std::vector<Operand> parts = {};
  bool is_number = false;
  Decimal number = {};
  std::string node = {};  // node reference; empty for a plain name
  std::string name = {};  // variable, symbol, "status", or a local's name
  SourceSpan span = {};
};

// An atom with the place it was written at.
//
// A node reference is kept as written: `land`, `fail_mission/land`, `land@23`,
// `land_btn12`, `btn12`, or the paper's `drone/8`.
struct Atom {
  AtomKind kind = AtomKind::NodeEvent;
  std::string node = {};       // NodeEvent: the node reference
  std::string word = {};       // NodeEvent, ProcessState, Keyword
  std::string component = {};  // `drone` of drone/5/state …, and of value (…)
  // `5` of drone/5/…: where a ProcessState looks, or the process in whose scope
  // names are looked up.
  std::optional<std::int32_t> process = {};
  Relation relation = Relation::Equal;
  Operand left = {};
  Operand right = {};  // Comparison
  Decimal low = {};    // Range
  Decimal high = {};
  FormulaId of{};             // Enter, Leave, Once, Since, Previously: P
  FormulaId since{};          // Since: Q
  std::string text = {};      // as written, for messages
  SourceSpan span = {};       // of the whole atom
  SourceSpan node_span = {};  // of the node reference
  SourceSpan word_span = {};  // of `word`
};

// Calls visit(operand) with each name and number that the operand is made of.
template <class Visit>
void visit_leaves(const Operand& operand, Visit visit) {
  if (operand.calculation == Arithmetic::None) return visit(operand);
  for (const Operand& part : operand.parts) visit_leaves(part, visit);
}
// Of both sides.
template <class Visit>
void visit_leaves(const Atom& atom, Visit visit) {
  visit_leaves(atom.left, visit);
  visit_leaves(atom.right, visit);
}

enum class PropertyForm : std::uint8_t {
  Never,         // absent P: no reachable state satisfies `formula`
  Invariant,     // always P: every reachable state does
  Possible,      // some reachable state does
  DeadlockFree,  // no reachable state is dead
  Ltl,           // every run satisfies `formula`
  Branching,     // the initial state satisfies `formula`, which is CTL
  Timed          // every run satisfies `timed`
};

// A real-time pattern (ltl/timed/timed_pattern.hpp); conditions on single
// states.
struct TimedClaim {
  Demand demand = Demand::Answer;
  std::optional<FormulaId> trigger;
  FormulaId answer{};
  std::optional<FormulaId> opening;
  std::optional<FormulaId> closing;
  int from = 0;  // the closed interval, in units of time; to may be kNoEnd
  int to = 0;
  bool must_open = false;
};

enum class Expectation : std::uint8_t { None, Holds, Violated };

struct Property {
  std::string name;   // as written, or proveN for the Nth unnamed one; a
                      // repeated name gets #2, #3, …
  std::string title;  // its ## comment, one line
  std::vector<std::string> tags;  // of `[safety, req=SR-12]`, as written
  Expectation expectation = Expectation::None;
  PropertyForm form = PropertyForm::Ltl;
  FormulaId formula{};  // Never, Invariant, Possible: no temporal operators
  std::vector<FormulaId> scope_ends;  // of a pattern: what opens, closes it
  TimedClaim timed;                   // Timed only
  std::string text;                   // the body as written, each gap one blank
  SourceSpan span;                    // of the name, or of `prove`
};

// What a file assumes of every run; runs without it are not searched.
struct Assumption {
  enum class Kind : std::uint8_t {
    ActionsEnd,  // an action ticked infinitely often ends infinitely often
    Formula      // the run satisfies `formula`, which is LTL
  };
  Kind kind = Kind::ActionsEnd;
  std::string name;  // as written, else assumeN for the Nth unnamed one
  FormulaId formula{};
  std::string text;  // as written, each gap one blank
  SourceSpan span;   // of the name, or of `assume`
};

struct PropertyFile {
  std::string file;
  std::string tree;                  // "" when it names none
  std::optional<std::string> ticks;  // root, leaves, nodes, none
  std::vector<Property> properties;
  std::vector<Assumption> assumptions;  // in force for all of them
  FormulaPool formulas;                 // of all properties
  std::vector<Atom> atoms;              // numbered by the atoms of `formulas`
};

// "rules.ltl", "rules.btp".
bool is_property_file(std::string_view name);

// Whether the text is one of items (`property`, `let`, …) or of comments, not
// of a rule alone, `never land.failure`.
bool begins_item(std::string_view text);

// Reads the text of a property file; grammar in docs/properties.md. Every
// error is reported, at most 20; a file with an error has no value.
Result<PropertyFile> read_properties(std::string_view file_name,
                                     const FileText& text);

}  // namespace btcheck
