// SPDX-License-Identifier: MIT
//
// The words and symbols of a property file, each with its place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"

namespace btcheck {

enum class TokenKind : std::uint8_t {
  End,      // stands right behind the last token
  Unknown,  // already reported
  Word,     // letters, digits and _, with at least one that is no digit
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
  Minus,  // negation, or the sign of a number
  Not,
  And,
  Or,
  Implies,
  Equivalent,
  Next,
  Eventually,
  Always,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual
};

struct Token {
  TokenKind kind = TokenKind::End;
  bool is_first_on_line = false;
  std::size_t begin = 0;  // bytes [begin, end) of the text
  std::size_t end = 0;
  SourceSpan span;
  std::string_view text;  // as written; a quoted name without its quotes
};

// A `##` comment that has its line to itself.
struct TitleLine {
  int line = 0;
  std::string_view text;  // blanks at both ends removed
};

struct TokenList {
  std::vector<Token> tokens;         // the last one is End
  std::vector<TitleLine> titles;     // by ascending line
  std::vector<Diagnostic> findings;  // at most 20
};

// Splits the text. Views in the result point into it.
TokenList tokenize(const SourceText& source);

}  // namespace btcheck
