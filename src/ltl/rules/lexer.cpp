// SPDX-License-Identifier: MIT
//
// One pass over the bytes, longest symbol first. Comments open with #, // or ;
// as in tree files, or stand between /* and */; a line of its own that opens
// with exactly two # is a title and is kept. Words may hold any letter of
// Unicode; the logical signs that a PDF viewer puts on the clipboard are
// symbols of their own, so a formula copied from a paper reads as it looks.
// What is no token at all becomes one Unknown token per stretch and is reported
// here, so that the parser stays silent about it. Lines and columns are
// counted on the way: looking each one up would cost time in the square of a
// line's length.
#include "ltl/rules/lexer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "text/utf8.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMaxFindings = 20;

struct Symbol {
  std::string_view text;
  TokenKind kind;
};

// A symbol stands before every shorter one that it begins with.
constexpr auto kSymbols = std::to_array<Symbol>({
    {"<=>", TokenKind::Equivalent}, {"...", TokenKind::Ellipsis},
    {"[]", TokenKind::Always},      {"<>", TokenKind::Eventually},
    {"()", TokenKind::Next},        {"/\\", TokenKind::And},
    {"\\/", TokenKind::Or},         {"&&", TokenKind::And},
    {"||", TokenKind::Or},          {"=>", TokenKind::Implies},
    {"->", TokenKind::Implies},     {"==", TokenKind::Equal},
    {"!=", TokenKind::NotEqual},    {"~=", TokenKind::NotEqual},
    {"<=", TokenKind::LessEqual},   {">=", TokenKind::GreaterEqual},
    {"..", TokenKind::DotDot},      {"(", TokenKind::LeftParen},
    {")", TokenKind::RightParen},   {"[", TokenKind::LeftBracket},
    {"]", TokenKind::RightBracket}, {",", TokenKind::Comma},
    {":", TokenKind::Colon},        {".", TokenKind::Dot},
    {"/", TokenKind::Slash},        {"@", TokenKind::At},
    {"-", TokenKind::Minus},        {"~", TokenKind::Not},
    {"!", TokenKind::Not},          {"=", TokenKind::Equal},
    {"<", TokenKind::Less},         {">", TokenKind::Greater},
    {"□", TokenKind::Always},       {"◻", TokenKind::Always},
    {"◇", TokenKind::Eventually},   {"♢", TokenKind::Eventually},
    {"⇒", TokenKind::Implies},      {"→", TokenKind::Implies},
    {"⇔", TokenKind::Equivalent},   {"↔", TokenKind::Equivalent},
    {"∧", TokenKind::And},          {"∨", TokenKind::Or},
    {"¬", TokenKind::Not},          {"∼", TokenKind::Not},
    {"≠", TokenKind::NotEqual},     {"≤", TokenKind::LessEqual},
    {"≥", TokenKind::GreaterEqual},
});

constexpr auto kBlanks = std::to_array<std::string_view>(
    {" ", "\t", "\n", "\r", "\v", "\f", "\u00A0", "\uFEFF"});

bool is_digit(char c) { return c >= '0' && c <= '9'; }

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

  TokenList run();

 private:
  bool starts_with(std::string_view what) const {
    return text_.substr(at_).starts_with(what);
  }
  std::size_t blank_here() const;
  const Symbol* symbol_here() const;
  bool is_letter_here() const;
  void advance(std::size_t bytes);
  void advance_to_line_end();
  bool skip_blank();
  bool skip_comment();
  void skip_long_comment();
  void keep_title();
  void read_token();
  void read_word();
  void read_quoted();
  void read_unknown();
  void push(TokenKind kind, std::size_t begin, SourceSpan start,
            std::string_view text);
  void report(std::string_view code, SourceSpan span, std::string message,
              std::string label, std::string help);

  const SourceText& source_;
  std::string_view text_;
  TokenList result_;
  std::size_t at_ = 0;
  int line_ = 1;
  int column_ = 1;
  int line_of_last_token_ = 0;
};

TokenList Lexer::run() {
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

std::size_t Lexer::blank_here() const {
  for (const std::string_view blank : kBlanks) {
    if (starts_with(blank)) return blank.size();
  }
  return 0;
}

const Symbol* Lexer::symbol_here() const {
  for (const Symbol& symbol : kSymbols) {
    if (starts_with(symbol.text)) return &symbol;
  }
  return nullptr;
}

bool Lexer::is_letter_here() const {
  const char c = text_[at_];
  if (is_ascii_letter(c) || is_digit(c)) return true;
  const bool is_ascii = static_cast<unsigned char>(c) < 0x80;
  return !is_ascii && blank_here() == 0 && symbol_here() == nullptr;
}

void Lexer::advance(std::size_t bytes) {
  for (std::size_t i = 0; i < bytes && at_ < text_.size(); ++i, ++at_) {
    if (text_[at_] == '\n') {
      ++line_;
      column_ = 1;
    } else if (!continues_character(text_[at_])) {
      ++column_;
    }
  }
}

void Lexer::advance_to_line_end() {
  advance(std::min(text_.find('\n', at_), text_.size()) - at_);
}

bool Lexer::skip_blank() {
  const std::size_t length = blank_here();
  advance(length);
  return length > 0;
}

bool Lexer::skip_comment() {
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

void Lexer::skip_long_comment() {
  const std::size_t close = text_.find("*/", at_ + 2);
  if (close == std::string_view::npos) {
    report("BT1207", {line_, column_, 2}, "this comment is never closed",
           "opened here", "close it with `*/`");
    at_ = text_.size();
    return;
  }
  advance(close + 2 - at_);
}

void Lexer::keep_title() {
  if (line_of_last_token_ == line_) return;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  result_.titles.push_back(
      {line_, trimmed(text_.substr(at_ + 2, end - at_ - 2))});
}

void Lexer::read_token() {
  if (text_[at_] == '"') return read_quoted();
  if (is_letter_here()) return read_word();
  const Symbol* symbol = symbol_here();
  if (symbol == nullptr) return read_unknown();
  const std::size_t begin = at_;
  const SourceSpan start{line_, column_, 1};
  advance(symbol->text.size());
  push(symbol->kind, begin, start, symbol->text);
}

void Lexer::read_word() {
  const std::size_t begin = at_;
  const SourceSpan start{line_, column_, 1};
  bool is_number = true;
  while (at_ < text_.size() &&
         (continues_character(text_[at_]) || is_letter_here())) {
    is_number = is_number && is_digit(text_[at_]);
    advance(1);
  }
  push(is_number ? TokenKind::Number : TokenKind::Word, begin, start,
       text_.substr(begin, at_ - begin));
}

void Lexer::read_quoted() {
  const std::size_t begin = at_;
  const SourceSpan start{line_, column_, 1};
  const std::size_t close = text_.find_first_of("\"\n", at_ + 1);
  if (close == std::string_view::npos || text_[close] == '\n') {
    advance_to_line_end();
    push(TokenKind::Unknown, begin, start, text_.substr(begin, at_ - begin));
    report("BT1207", result_.tokens.back().span, "this name is never closed",
           "no second `\"` on the line", "close it with `\"`");
    return;
  }
  advance(close + 1 - at_);
  push(TokenKind::Quoted, begin, start,
       text_.substr(begin + 1, close - begin - 1));
  if (close == begin + 1) {
    result_.tokens.back().kind = TokenKind::Unknown;
    report("BT1207", result_.tokens.back().span, "a name cannot be empty",
           "nothing between the quotes", "");
  }
}

void Lexer::read_unknown() {
  const std::size_t begin = at_;
  const SourceSpan start{line_, column_, 1};
  while (at_ < text_.size() && blank_here() == 0 && !is_letter_here() &&
         symbol_here() == nullptr && text_[at_] != '"' && text_[at_] != '#' &&
         text_[at_] != ';') {
    advance(1);
  }
  const std::string_view text = text_.substr(begin, at_ - begin);
  push(TokenKind::Unknown, begin, start, text);
  report("BT1208", result_.tokens.back().span,
         fmt::format("`{}` means nothing in a property", text),
         "no such operator",
         text == "&"   ? "write `and`"
         : text == "|" ? "write `or`"
         : text.find_first_of("+*%^") != std::string_view::npos
             ? "a property compares variables, it does not calculate"
             : "a name with other characters than letters, digits "
               "and _ is written in double quotes");
}

void Lexer::push(TokenKind kind, std::size_t begin, SourceSpan start,
                 std::string_view text) {
  start.length = column_ - start.column;
  result_.tokens.push_back(
      {kind, line_of_last_token_ != start.line, begin, at_, start, text});
  line_of_last_token_ = start.line;
}

void Lexer::report(std::string_view code, SourceSpan span, std::string message,
                   std::string label, std::string help) {
  if (result_.findings.size() == kMaxFindings) return;
  result_.findings.push_back(
      source_.diagnostic(Severity::Error, code, span, std::move(message),
                         std::move(label), std::move(help)));
}

}  // namespace

TokenList tokenize(const SourceText& source) { return Lexer(source).run(); }

}  // namespace btcheck
