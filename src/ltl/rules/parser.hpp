// SPDX-License-Identifier: MIT
//
// What the chapters of the property reader share, and what each one reads:
//
//   lexer      the tokens of the file, and its vocabulary
//   reader     items: property, prove, let, expect, tree, …
//   body       what a property claims: `always P`, `P leadsto Q`
//   tail       the scope and the time behind a pattern
//   formula    operators
//   condition  comparisons, constants and names
//   event      what processes do, and steps
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ltl/formula/formula.hpp"
#include "ltl/formula/pattern.hpp"
#include "ltl/rules/name_help.hpp"
#include "ltl/rules/property.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

inline constexpr std::size_t kNoToken = static_cast<std::size_t>(-1);
inline constexpr std::size_t kMostFindings = 20;  // of errors, of warnings
inline constexpr std::size_t kMaxNesting = 500;
inline constexpr std::uint32_t kMaxFormulaSize = 10'000;
inline constexpr std::size_t kMaxAtoms = 64;
inline constexpr std::size_t kShownText = 120;  // of a formula, in messages

enum class TokenKind : std::uint8_t {
  End,         // stands right behind the last token
  Unknown,     // already reported
  Identifier,  // letters, digits and _, with at least one that is no digit
  Quoted,
  Number,  // digits only; its value may be out of every range
  LeftParen,
  RightParen,
  LeftBracket,
  RightBracket,
  Comma,
  Colon,
  Dot,
  DotDot,
  Ellipsis,
  Slash,
  At,
  Minus,  // negation, the sign of a number, or a difference
  Plus,
  Times,
  Operator,  // `[]`, `=>`: a symbol
  Relation   // `=`, `<`
};

struct Token {
  TokenKind kind = TokenKind::End;
  bool is_first_on_line = false;
  std::size_t begin = 0;  // bytes [begin, end) of the text
  std::size_t end = 0;
  SourceSpan span;
  std::string_view text;  // as written; a quoted name without its quotes
  FormulaKind operation =
      FormulaKind::True;                // of an Operator, a Minus, or a
                                        // Identifier such as `and`; else True
  Relation relation = Relation::Equal;  // Relation only

  bool is_name() const {
    return kind == TokenKind::Identifier || kind == TokenKind::Quoted;
  }
};

// A `##` comment that has its line to itself.
struct TitleLine {
  int line = 0;
  std::string_view text;  // blanks at both ends removed
};

struct TokenList {
  std::vector<Token> tokens;         // the last one is End
  std::vector<TitleLine> titles;     // by ascending line
  std::vector<Diagnostic> findings;  // at most kMostFindings
};

// Splits the text. Views in the result point into it.
TokenList tokenize(const SourceText& source);

// The operator that a word is, else True.
FormulaKind operation_of(std::string_view word);
// Words that can only stand behind a complete condition.
bool ends_operand(std::string_view word);
// Words that can begin a condition or a body.
const std::vector<std::string>& opening_words();
// Words that name nothing unless they are quoted.
bool is_reserved(std::string_view word);

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
  std::set<std::uint32_t> atoms;
  int line = 0;
};

// The process that the names inside `drone/5/value (…)` belong to.
struct ProcessScope {
  std::string component;
  std::int32_t process = 0;
  std::string text;  // `drone/5/value`, as written
};

// What a reader returns after an error.
struct Refused {
  template <std::same_as<bool> Bool>
  operator Bool() const {
    return false;
  }
  template <class T>
  operator std::optional<T>() const {
    return std::nullopt;
  }
};

// The place in the file, what has been read, and what was found wrong.
class PropertyParser {
 public:
  PropertyParser(const SourceText& source, TokenList tokens,
                 PropertyFile& file);

  // The token `ahead` places from here; the End token when there is none.
  const Token& peek(std::size_t ahead = 0) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
  }
  const Token& token(std::size_t number) const { return tokens_[number]; }
  const Token& take() {
    const Token& token = peek();
    if (at_ + 1 < tokens_.size()) ++at_;
    return token;
  }
  std::size_t position() const { return at_; }
  bool at_end() const { return peek().kind == TokenKind::End; }
  bool at(TokenKind kind, std::size_t ahead = 0) const {
    return peek(ahead).kind == kind;
  }
  bool accept(TokenKind kind) { return take_if(at(kind)); }
  // A word or a quoted name.
  bool at_name(std::size_t ahead = 0) const { return peek(ahead).is_name(); }

  // An Identifier, compared without regard to case.
  bool at_word(std::string_view word, std::size_t ahead = 0) const {
    return peek(ahead).kind == TokenKind::Identifier &&
           equal_ignoring_case(peek(ahead).text, word);
  }
  bool accept_word(std::string_view word) { return take_if(at_word(word)); }
  // The same, but not as a name: neither `always.ticked` nor `always = 3`.
  bool at_keyword(std::string_view word) const {
    return at_word(word) && !continues_name();
  }
  bool accept_keyword(std::string_view word) {
    return take_if(at_keyword(word));
  }
  // The token here goes on as a node path or a comparison does.
  bool continues_name(std::size_t ahead = 0) const;
  // The token could be the first of a condition.
  bool starts_operand(std::size_t ahead = 0) const;
  // An operator of two operands, a symbol or a word.
  std::optional<FormulaKind> infix_here(std::size_t ahead = 0) const;
  // The symbol of an operator, not its word: `<>`, not F.
  bool at_symbol(FormulaKind operation, std::size_t ahead = 0) const {
    return peek(ahead).kind == TokenKind::Operator &&
           peek(ahead).operation == operation;
  }
  // `property`, `let` or one of their kind stands here.
  bool at_item(std::size_t ahead = 0) const;
  bool at_item_end() const { return at_end() || at_item(); }
  // Moves on to the next such word at the start of a line.
  void skip_to_item() {
    while (!at_end() && !(peek().is_first_on_line && at_item())) take();
  }

  SourceSpan span(std::size_t first, std::size_t end) const;
  SourceSpan here() const { return peek().span; }
  // The tokens [first, end) as written, without comments, each gap one blank;
  // cut at a blank, with `...`, where it is longer than `limit` bytes.
  std::string text(std::size_t first, std::size_t end,
                   std::size_t limit = kNoToken) const;
  std::string text(const Phrase& phrase) const {
    return text(phrase.first, phrase.end, kShownText);
  }
  // The title that ends on the line above.
  std::string title_above(int line) const;

  // An Unknown token here keeps `unexpected` silent: the lexer reported it.
  Refused error(std::string_view code, SourceSpan span, std::string message,
                std::string label = {}, std::string help = {}) {
    return add(Severity::Error, code, span, std::move(message),
               std::move(label), std::move(help));
  }
  Refused unexpected(std::string message, std::string label,
                     std::string help = {});
  void warn(std::string_view code, SourceSpan span, std::string message,
            std::string label, std::string help) {
    add(Severity::Warning, code, span, std::move(message), std::move(label),
        std::move(help));
  }
  bool has_errors() const { return errors_ > 0; }
  bool is_full() const { return errors_ >= kMostFindings; }
  std::vector<Diagnostic> take_findings();

  // The number of an atom; equal atoms share theirs.
  std::uint32_t number_of(Atom atom);

  PropertyFile& file() { return file_; }
  FormulaPool& formulas() { return file_.formulas; }

  std::unordered_map<std::string, Definition> definitions;
  // Every `let NAME` of the file, by name: the line of the first one.
  std::unordered_map<std::string, int> announced;
  std::set<std::uint32_t> used_atoms;  // in this `let` or property
  std::size_t first_next = kNoToken;   // the first X or () of this property
  // A word that ends a formula outside parentheses although it is an operator:
  // the `and` of `between Q and R`.
  std::string_view stop_word;
  std::optional<ProcessScope> scope;  // inside `drone/5/value (…)`
  // Bodies that are a condition and nothing else: warned about at the end.
  std::vector<Phrase> conditions_alone;
  bool is_warned_of_reach = false;  // BT1203, in this property
  bool is_inside_event = false;     // the condition of `enter` is being read
  std::size_t past_depth = 0;       // operators of the past being read
  NameHelp name_help;               // for a name with nothing about it

 private:
  Refused add(Severity severity, std::string_view code, SourceSpan span,
              std::string message, std::string label, std::string help);

  bool take_if(bool is_wanted) {
    if (is_wanted) take();
    return is_wanted;
  }

  const SourceText& source_;
  std::vector<Token> tokens_;
  std::vector<TitleLine> titles_;
  std::vector<Diagnostic> findings_;
  PropertyFile& file_;
  std::size_t at_ = 0;
  std::size_t errors_ = 0;
  std::size_t warnings_ = 0;
  std::unordered_map<std::string, std::uint32_t> atom_numbers_;
};

// condition.cpp: a side of a comparison, with or without `.word`: `land`,
// `fail/land@31.ticked`, `btnode[x].rstatus`, or a number.
struct Side {
  Operand operand;        // a node without `.word` has no name
  std::size_t first = 0;  // its tokens are [first, end)
  std::size_t end = 0;
  std::size_t node_end = 0;  // the node reference is [first, node_end)
};
// A `(` stands here that is part of a calculation: `(x + y) * 2 > 3`.
bool at_calculation(const PropertyParser& in);
// A number with its sign, in the range of 32 bits.
std::optional<std::int32_t> read_number(PropertyParser& in);
// One condition without operators: an atom, a constant or the name of a let.
// Inside a scope: a comparison.
std::optional<Phrase> read_atom(PropertyParser& in);

// tick_rule.cpp: in which ticks a rule says that its condition holds.
enum class TickWords : std::uint8_t { Every, No, Some };
// `in every tick`, `in no tick` or `in some tick` begins at this place.
bool at_ticks(const PropertyParser& in, std::size_t ahead);
// `every tick`, `in every tick`, `in no tick` or `in some tick`, if they stand
// here.
std::optional<TickWords> read_tick_words(PropertyParser& in);
// The condition where a tick ends: `tick.ends and P`, for every tick
// `tick.ends => P`.
FormulaId at_tick_ends(PropertyParser& in, TickWords ticks, SourceSpan words,
                       FormulaId condition);
// `tick.ends` and `x.answered success`, if they stand here.
bool at_tick_end(const PropertyParser& in);
std::optional<Phrase> read_tick_end(PropertyParser& in);
std::optional<Phrase> read_answered(PropertyParser& in, const Side& side);

// event.cpp: `drone/5/state done`, `enter P`, `leave P` and `time.passes`, when
// one of them stands here. Inside a scope the first is an error, and the others
// are names.
bool at_event(const PropertyParser& in);
std::optional<Phrase> read_event(PropertyParser& in);
// The rest of `P since Q`, where `since` stands here.
std::optional<Phrase> read_since(PropertyParser& in, const Phrase& held);
// `land@23.ticked`: a node and its event, read as a side that was not compared.
std::optional<Phrase> read_node_event(PropertyParser& in, const Side& side);
// `drone/5/value (` when it stands here.
std::optional<ProcessScope> read_value_opening(PropertyParser& in);
// The atom that was read from token `first` up to here, numbered, with its text
// and the process of its scope.
Phrase finish_atom(PropertyParser& in, std::size_t first, Atom atom);

// formula.cpp: the longest formula that stands here, or one operand of it: an
// atom, a parenthesis, and what negates them.
std::optional<Phrase> read_formula(PropertyParser& in);
std::optional<Phrase> read_single_operand(PropertyParser& in);

// tail.cpp: the scope and the time behind a pattern, each at most once.
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
// What the pattern claims with the time that the tail must have; an error where
// it takes none in that scope.
bool claim_timed(PropertyParser& in, TimedClaim& claim, Pattern pattern,
                 const Phrase& p, const Phrase& q, const Tail& tail);

// body.cpp: what a property claims, up to the next item.
bool read_body(PropertyParser& in, Property& property);
// An error unless the phrase speaks of single states; `who`, in the message,
// asks for it.
bool require_state_predicate(PropertyParser& in, const Phrase& phrase,
                             std::string_view who, std::string_view help);
// Reports a token that cannot follow a complete condition.
Refused refuse_leftover(PropertyParser& in);
// An error unless the item ends here.
bool require_end(PropertyParser& in);

}  // namespace btcheck
