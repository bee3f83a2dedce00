// SPDX-License-Identifier: MIT
//
// What the chapters of the property reader share, and what each one reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ltl/formula/formula.hpp"
#include "ltl/formula/pattern.hpp"
#include "ltl/rules/lexer.hpp"
#include "ltl/rules/property.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

inline constexpr std::size_t kNoToken = static_cast<std::size_t>(-1);
inline constexpr std::size_t kMaxNesting = 500;
inline constexpr std::uint32_t kMaxFormulaSize = 10'000;
inline constexpr std::size_t kMaxAtoms = 64;
inline constexpr std::size_t kShownText = 120;  // of a formula, in messages

// A formula as read, and how it stands in the text. Tokens are given by their
// number in the file.
struct Phrase {
  FormulaId id{};
  std::uint32_t size = 1;  // operators and atoms, every let expanded
  std::size_t first = 0;   // its tokens are [first, end)
  std::size_t end = 0;
  std::size_t temporal = kNoToken;  // its first temporal operator
  std::size_t join = kNoToken;      // its outermost operator, when that has two
                                    // sides and stands outside parentheses
  FormulaKind joined_by = FormulaKind::True;
  std::size_t always = kNoToken;  // its first token, when that is a `[]`
                                  // outside parentheses …
  std::size_t always_end = 0;     // … and the end of what the `[]` covers
};

// `let name = …`, written out wherever the name stands.
struct Definition {
  FormulaId formula{};
  std::uint32_t size = 1;
  std::vector<std::uint32_t> atoms;
  int line = 0;
};

// The process that the names inside `drone/5/value (…)` belong to.
struct ProcessScope {
  std::string component;
  std::int32_t process = 0;
  std::string text;  // `drone/5/value`, as written
};

// How far a file is read, what it has said, and what was found wrong.
class PropertyParser {
 public:
  PropertyParser(const SourceText& source, TokenList tokens,
                 PropertyFile& file);

  // The token `ahead` places from here; the End token when there is none.
  const Token& peek(std::size_t ahead = 0) const;
  const Token& token(std::size_t number) const { return tokens_[number]; }
  const Token& take();
  std::size_t position() const { return at_; }
  bool at_end() const { return peek().kind == TokenKind::End; }
  bool at(TokenKind kind) const { return peek().kind == kind; }
  bool accept(TokenKind kind);

  // A Word, compared without regard to case.
  bool at_word(std::string_view word, std::size_t ahead = 0) const;
  bool accept_word(std::string_view word);
  // The same, but no name is meant: neither `always.ticked` nor `always = 3`.
  bool at_keyword(std::string_view word, std::size_t ahead = 0) const;
  // True when the token here goes on as a node path or a comparison does.
  bool continues_name(std::size_t ahead = 0) const;
  // True when the token could be the first of a condition.
  bool starts_operand(std::size_t ahead = 0) const;
  // True when `property`, `let` or one of their kind stands here.
  bool at_item() const;
  // Moves on to the next such word at the start of a line.
  void skip_to_item();

  SourceSpan span(std::size_t first, std::size_t end) const;
  SourceSpan here() const { return peek().span; }
  // The tokens [first, end) as written, without comments, each gap one blank;
  // `limit` in bytes, beyond it the middle is left out.
  std::string text(std::size_t first, std::size_t end,
                   std::size_t limit = kNoToken) const;
  std::string text(const Phrase& phrase) const {
    return text(phrase.first, phrase.end, kShownText);
  }
  // The title that ends on the line above.
  std::string title_above(int line) const;

  // Each returns false, so that a reader can end with it. An Unknown token
  // here keeps `unexpected` silent: the lexer has spoken.
  bool error(std::string_view code, SourceSpan span, std::string message,
             std::string label = {}, std::string help = {});
  bool unexpected(std::string message, std::string label,
                  std::string help = {});
  void warn(std::string_view code, SourceSpan span, std::string message,
            std::string label, std::string help);
  bool has_errors() const { return errors_ > 0; }
  bool is_full() const;  // 20 errors: nobody reads more
  std::vector<Diagnostic> take_findings();

  // The number of an atom; equal atoms share theirs.
  std::uint32_t number_of(Atom atom);
  void use_atoms(std::span<const std::uint32_t> numbers);
  // The atoms used since the last call, ascending.
  std::vector<std::uint32_t> take_used_atoms();

  PropertyFile& file() { return file_; }
  FormulaPool& formulas() { return file_.formulas; }

  std::unordered_map<std::string, Definition> definitions;
  // Every `let NAME` of the file, by name: the line of the first one.
  std::unordered_map<std::string, int> announced;
  std::size_t first_next = kNoToken;  // the first X or () of this property
  // A word that ends a formula outside parentheses although it is an operator:
  // the `and` of `between Q and R`.
  std::string_view stop_word;
  // Bodies that are a condition and nothing else: warned about at the end.
  std::vector<Phrase> conditions_alone;
  bool is_warned_of_reach = false;  // BT1203, in this property
  bool is_inside_event = false;     // the condition of `enter` is being read

 private:
  bool add(Severity severity, std::string_view code, SourceSpan span,
           std::string message, std::string label, std::string help);

  const SourceText& source_;
  std::vector<Token> tokens_;
  std::vector<TitleLine> titles_;
  std::vector<Diagnostic> findings_;
  PropertyFile& file_;
  std::size_t at_ = 0;
  std::size_t errors_ = 0;
  std::size_t warnings_ = 0;
  std::unordered_map<std::string, std::uint32_t> atom_numbers_;
  std::vector<std::uint32_t> used_atoms_;
};

// property_words.cpp: which words mean what
std::optional<FormulaKind> prefix_here(const PropertyParser& in);
// AG, EF, …: the quantifier and the operator in one word.
struct PathPrefix {
  FormulaKind quantifier = FormulaKind::ForAllPaths;
  FormulaKind kind = FormulaKind::Always;
};
std::optional<PathPrefix> path_prefix_here(const PropertyParser& in);
// The A or E of `A [p U q]`.
std::optional<FormulaKind> path_quantifier_here(const PropertyParser& in);
std::optional<FormulaKind> infix_here(const PropertyParser& in,
                                      std::size_t ahead = 0);
std::optional<Relation> relation_here(const PropertyParser& in,
                                      std::size_t ahead = 0);
// Words that can only stand behind a complete condition.
bool ends_operand(std::string_view word);
// Words that name nothing unless they are quoted.
bool is_reserved(std::string_view word);
// Words that a mistyped one may have meant: at the start of a condition, and
// behind a complete one.
std::span<const std::string> opening_words();
std::span<const std::string> joining_words();
// The entry of a list that is this word, compared without regard to case.
std::optional<std::string_view> entry_of(std::span<const std::string_view> list,
                                         std::string_view word);
// "did you mean `x`?" for the nearest candidate, else `otherwise`.
std::string suggestion(std::string_view word,
                       std::span<const std::string> candidates,
                       std::string otherwise = {});

// property_operand.cpp: reads a side of a comparison, with or without `.word`:
// `land`, `fail/land@31.ticked`, `btnode[x].rstatus`, or a number.
struct Side {
  Operand operand;        // a node without `.word` has no name
  std::size_t first = 0;  // its tokens are [first, end)
  std::size_t end = 0;
  std::size_t node_end = 0;  // the node reference is [first, node_end)
};
std::optional<Side> read_side(PropertyParser& in, const ProcessScope* scope);
// A number with its sign, in the range of 32 bits.
std::optional<std::int32_t> read_number(PropertyParser& in);
// A word or a quoted name.
bool is_name(const Token& token);

// property_atom.cpp: reads one condition without operators: an atom, a
// constant or the name of a let. Inside a scope: a comparison.
std::optional<Phrase> read_atom(PropertyParser& in, const ProcessScope* scope);
// The atom that was read from token `first` up to here, numbered, with its text
// and the process of its scope.
Phrase finish_atom(PropertyParser& in, const ProcessScope* scope,
                   std::size_t first, Atom atom);

// property_event.cpp: `drone/5/state done`, `enter P`, `leave P` and
// `time.passes`, when one of them stands here. Only the first can inside a
// scope, where it is an error.
bool at_event(const PropertyParser& in, const ProcessScope* scope);
std::optional<Phrase> read_event(PropertyParser& in, const ProcessScope* scope);
// `land@23.ticked`: a node and its event, read as a side that was not compared.
std::optional<Phrase> read_node_event(PropertyParser& in, const Side& side);
// `drone/5/value (` when it stands here.
std::optional<ProcessScope> read_value_opening(PropertyParser& in);

// property_formula.cpp: reads the longest formula that stands here, or one
// operand of it: an atom, a parenthesis, and what negates them.
std::optional<Phrase> read_formula(PropertyParser& in);
std::optional<Phrase> read_single_operand(PropertyParser& in);

// property_body.cpp: reads what a property claims, up to the next item.
bool read_body(PropertyParser& in, Property& property);
// An error unless the phrase speaks of single states; `who` names what asks.
bool require_state_predicate(PropertyParser& in, const Phrase& phrase,
                             std::string_view who, std::string_view help);

// Reports what stands behind a complete condition and cannot; returns false.
bool refuse_leftover(PropertyParser& in);

// property_tail.cpp: the scope and the time behind a pattern, each at most
// once.
enum class TimeKind : std::uint8_t { Within, For, Lasting };
struct Timing {
  TimeKind kind = TimeKind::Within;
  std::int32_t from = 0;  // a closed interval of whole units of time;
  std::int32_t to = 0;    // kNoEnd when it has no end
  SourceSpan span;
};
struct Tail {
  bool has_scope = false;
  Scope scope;
  SourceSpan scope_span;
  std::optional<Timing> timing;
  bool asks_for_first = false;  // `present first`, `leadsto first`
};
bool read_tail(PropertyParser& in, Tail& tail);
// `after Q,` in front of a body.
bool read_leading_scope(PropertyParser& in, Tail& tail);

// property_timed.cpp: what the pattern claims with the time that the tail must
// have; an error where it takes none in that scope.
bool claim_timed(PropertyParser& in, Property& property, Pattern pattern,
                 const Phrase& p, const Phrase& q, const Tail& tail);

// property_macro.cpp: `absentAfter`, when such a word opens a body here, and
// its operands: P, Q where the pattern takes two, then the ends of the scope.
struct Macro {
  Pattern pattern = Pattern::Absence;
  bool takes_two = false;
  ScopeKind scope = ScopeKind::Before;
};
std::optional<Macro> at_macro(const PropertyParser& in);
bool read_macro_operands(PropertyParser& in, const Token& word,
                         const Macro& macro, std::span<Phrase> operands);

}  // namespace btcheck
