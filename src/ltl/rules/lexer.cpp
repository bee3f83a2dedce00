// SPDX-License-Identifier: MIT
//
// Tokens and vocabulary, in one pass over the bytes, longest symbol first.
//
// Comments open with #, // or ; as in tree files, or stand between /* and */; a
// line of its own that opens with exactly two # is a title and is kept. Words
// may hold any letter of Unicode; the logical signs that a PDF viewer puts on
// the clipboard are symbols of their own. A stretch of bytes that form no token
// becomes one Unknown token and is reported here; the parser stays silent about
// it. Lines and columns are counted on the way: looking each one up would cost
// time in the square of a line's length.
//
// Words are compared without regard to case, except the single letters: G F X
// U W R V and T are operators and a constant, g and t ordinary names. No
// operator is ever a name; a word that opens or joins the forms of a body may
// be one: `always.ticked` is an event of a node called always.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "ltl/rules/parser.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

struct Symbol {
  std::string_view text;
  TokenKind kind;
  FormulaKind operation = FormulaKind::True;
  Relation relation = Relation::Equal;
};

constexpr Symbol sign(std::string_view text, FormulaKind operation) {
  return {text, TokenKind::Operator, operation};
}
constexpr Symbol sign(std::string_view text, Relation relation) {
  return {text, TokenKind::Relation, FormulaKind::True, relation};
}

// A symbol stands before every shorter one that it begins with.
constexpr Symbol kSymbols[] = {
    sign("<=>", FormulaKind::Equivalent),
    {"...", TokenKind::Ellipsis},
    sign("[]", FormulaKind::Always),
    sign("<>", FormulaKind::Eventually),
    sign("()", FormulaKind::Next),
    sign("/\\", FormulaKind::And),
    sign("\\/", FormulaKind::Or),
    sign("&&", FormulaKind::And),
    sign("||", FormulaKind::Or),
    sign("=>", FormulaKind::Implies),
    sign("->", FormulaKind::Implies),
    sign("==", Relation::Equal),
    sign("!=", Relation::NotEqual),
    sign("~=", Relation::NotEqual),
    sign("<=", Relation::LessEqual),
    sign(">=", Relation::GreaterEqual),
    {"..", TokenKind::DotDot},
    {"(", TokenKind::LeftParen},
    {")", TokenKind::RightParen},
    {"[", TokenKind::LeftBracket},
    {"]", TokenKind::RightBracket},
    {",", TokenKind::Comma},
    {":", TokenKind::Colon},
    {".", TokenKind::Dot},
    {"/", TokenKind::Slash},
    {"@", TokenKind::At},
    {"-", TokenKind::Minus, FormulaKind::Not},
    {"+", TokenKind::Plus},
    {"*", TokenKind::Times},
    sign("~", FormulaKind::Not),
    sign("!", FormulaKind::Not),
    sign("=", Relation::Equal),
    sign("<", Relation::Less),
    sign(">", Relation::Greater),
    sign("□", FormulaKind::Always),
    sign("◻", FormulaKind::Always),
    sign("◇", FormulaKind::Eventually),
    sign("♢", FormulaKind::Eventually),
    sign("⇒", FormulaKind::Implies),
    sign("→", FormulaKind::Implies),
    sign("⇔", FormulaKind::Equivalent),
    sign("↔", FormulaKind::Equivalent),
    sign("∧", FormulaKind::And),
    sign("∨", FormulaKind::Or),
    sign("¬", FormulaKind::Not),
    sign("∼", FormulaKind::Not),
    sign("≠", Relation::NotEqual),
    sign("≤", Relation::LessEqual),
    sign("≥", Relation::GreaterEqual),
};

constexpr std::string_view kBlanks[] = {" ",  "\t", "\n",     "\r",
                                        "\v", "\f", "\u00A0", "\uFEFF"};

constexpr std::pair<std::string_view, FormulaKind> kOperatorWords[] = {
    {"not", FormulaKind::Not},      {"G", FormulaKind::Always},
    {"F", FormulaKind::Eventually}, {"X", FormulaKind::Next},
    {"and", FormulaKind::And},      {"or", FormulaKind::Or},
    {"until", FormulaKind::Until},  {"release", FormulaKind::Release},
    {"U", FormulaKind::Until},      {"W", FormulaKind::WeakUntil},
    {"R", FormulaKind::Release},    {"V", FormulaKind::Release},
};

// Words that can only follow a complete condition, besides the operators.
constexpr std::string_view kJoiningWords[] = {
    "leadsto", "then",     "within",   "before",  "after",
    "between", "precedes", "requires", "forbids", "causes",
    "for",     "lasting",  "globally", "since"};

// Reserved words that neither open a condition nor join two.
constexpr std::string_view kOtherWords[] = {
    "in",   "property", "prove", "assert", "let", "expect",
    "tree", "assume",   "is",    "root",   "T"};

bool means(std::string_view text, std::string_view word) {
  return word.size() == 1 ? text == word : equal_ignoring_case(text, word);
}

template <class Words>
bool contains(const Words& words, std::string_view text) {
  return std::ranges::any_of(
      words, [&](std::string_view word) { return means(text, word); });
}

bool is_ascii_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

class Lexer {
 public:
  explicit Lexer(const SourceText& source)
      : source_(source), text_(source.text()) {}

  TokenList run() {
    while (at_ < text_.size()) {
      if (!skip_blank() && !skip_comment()) read_token();
    }
    Token end;
    end.span = {1, 1, 1};
    if (!result_.tokens.empty()) {
      const Token& last = result_.tokens.back();
      end.begin = end.end = last.end;
      end.span = {last.span.line, last.span.column + last.span.length, 1};
    }
    result_.tokens.push_back(end);
    return std::move(result_);
  }

 private:
  std::size_t blank_here() const {
    for (const std::string_view blank : kBlanks) {
      if (starts_with(blank)) return blank.size();
    }
    return 0;
  }

  const Symbol* symbol_here() const {
    for (const Symbol& symbol : kSymbols) {
      if (starts_with(symbol.text)) return &symbol;
    }
    return nullptr;
  }

  bool is_letter_here() const {
    const char c = text_[at_];
    if (is_ascii_letter(c) || is_digit(c)) return true;
    const bool is_ascii = static_cast<unsigned char>(c) < 0x80;
    return !is_ascii && blank_here() == 0 && symbol_here() == nullptr;
  }

  void advance(std::size_t bytes) {
    for (std::size_t i = 0; i < bytes && at_ < text_.size(); ++i, ++at_) {
      if (text_[at_] == '\n') {
        ++line_;
        column_ = 1;
      } else if (!continues_character(text_[at_])) {
        ++column_;
      }
    }
  }

  void advance_to_line_end() {
    advance(std::min(text_.find('\n', at_), text_.size()) - at_);
  }

  bool skip_blank() {
    const std::size_t length = blank_here();
    advance(length);
    return length > 0;
  }

  bool skip_comment() {
    if (starts_with("/*")) {
      skip_long_comment();
      return true;
    }
    if (!starts_with("#") && !starts_with("//") && !starts_with(";")) {
      return false;
    }
    if (starts_with("##") && !starts_with("###")) keep_title();
    advance_to_line_end();
    return true;
  }

  void skip_long_comment() {
    const std::size_t close = text_.find("*/", at_ + 2);
    if (close == std::string_view::npos) {
      report("BT1207", {line_, column_, 2}, "this comment is never closed",
             "opened here", "close it with `*/`");
      at_ = text_.size();
      return;
    }
    advance(close + 2 - at_);
  }

  void keep_title() {
    if (line_of_last_token_ == line_) return;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    result_.titles.push_back(
        {line_, trimmed(text_.substr(at_ + 2, end - at_ - 2))});
  }

  void read_token() {
    begin_ = at_;
    start_ = {line_, column_, 1};
    if (text_[at_] == '"') return read_quoted();
    if (is_letter_here()) return read_word();
    const Symbol* symbol = symbol_here();
    if (symbol == nullptr) return read_unknown();
    advance(symbol->text.size());
    Token& token = push(symbol->kind);
    token.operation = symbol->operation;
    token.relation = symbol->relation;
  }

  void read_word() {
    bool is_number = true;
    while (at_ < text_.size() &&
           (continues_character(text_[at_]) || is_letter_here())) {
      is_number = is_number && is_digit(text_[at_]);
      advance(1);
    }
    Token& token = push(is_number ? TokenKind::Number : TokenKind::Identifier);
    if (!is_number) token.operation = operation_of(token.text);
  }

  void read_quoted() {
    const std::size_t close = text_.find_first_of("\"\n", at_ + 1);
    if (close == std::string_view::npos || text_[close] == '\n') {
      advance_to_line_end();
      report("BT1207", push(TokenKind::Unknown).span,
             "this name is never closed", "no second `\"` on the line",
             "close it with `\"`");
      return;
    }
    advance(close + 1 - at_);
    Token& token = push(TokenKind::Quoted);
    token.text = text_.substr(begin_ + 1, close - begin_ - 1);
    if (token.text.empty()) {
      token.kind = TokenKind::Unknown;
      report("BT1207", token.span, "a name cannot be empty",
             "nothing between the quotes", "");
    }
  }

  void read_unknown() {
    while (at_ < text_.size() && blank_here() == 0 && !is_letter_here() &&
           symbol_here() == nullptr && text_[at_] != '"' && text_[at_] != '#' &&
           text_[at_] != ';') {
      advance(1);
    }
    const Token& token = push(TokenKind::Unknown);
    const std::string_view text = token.text;
    report("BT1208", token.span,
           fmt::format("`{}` means nothing in a property", text),
           "no such operator",
           text == "&"   ? "write `and`"
           : text == "|" ? "write `or`"
           : text.find_first_of("%^") != std::string_view::npos
               ? "a rule calculates with `+`, `-` and `*`"
               : "a name with other characters than letters, digits "
                 "and _ is written in double quotes");
  }

  // The token from begin_ up to here.
  Token& push(TokenKind kind) {
    start_.length = column_ - start_.column;
    result_.tokens.push_back({kind, line_of_last_token_ != start_.line, begin_,
                              at_, start_, text_.substr(begin_, at_ - begin_)});
    line_of_last_token_ = start_.line;
    return result_.tokens.back();
  }

  void report(std::string_view code, SourceSpan span, std::string message,
              std::string label, std::string help) {
    if (result_.findings.size() == kMostFindings) return;
    result_.findings.push_back(
        source_.diagnostic(Severity::Error, code, span, std::move(message),
                           std::move(label), std::move(help)));
  }

  bool starts_with(std::string_view what) const {
    return text_.substr(at_).starts_with(what);
  }

  const SourceText& source_;
  std::string_view text_;
  TokenList result_;
  std::size_t at_ = 0;
  int line_ = 1;
  int column_ = 1;
  int line_of_last_token_ = 0;
  std::size_t begin_ = 0;  // of the token that is being read
  SourceSpan start_;
};

}  // namespace

FormulaKind operation_of(std::string_view word) {
  for (const auto& [name, operation] : kOperatorWords) {
    if (means(word, name)) return operation;
  }
  return FormulaKind::True;
}

bool ends_operand(std::string_view word) {
  const FormulaKind operation = operation_of(word);
  return (!is_leaf(operation) && !is_unary(operation)) ||
         contains(kJoiningWords, word);
}

const std::vector<std::string>& opening_words() {
  static const std::vector<std::string> words = {
      "never",      "absent",   "always",       "possible",
      "eventually", "present",  "deadlockfree", "infinitelyOften",
      "mortal",     "whenever", "not",          "true",
      "false",      "stuck",    "dead",         "ltl",
      "tick",       "live",     "enter",        "leave"};
  return words;
}

bool is_reserved(std::string_view word) {
  return !is_leaf(operation_of(word)) || contains(kJoiningWords, word) ||
         contains(opening_words(), word) || contains(kOtherWords, word);
}

TokenList tokenize(const SourceText& source) { return Lexer(source).run(); }

}  // namespace btcheck
