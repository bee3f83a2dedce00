// SPDX-License-Identifier: MIT
//
// The words of a .btf file.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"
#include "text/findings.hpp"

namespace btcheck::btf {

enum class TokenKind : unsigned char {
  Open,      // (
  Close,     // )
  Keyword,   // :name, with its colon
  Interval,  // [2,5], with its brackets
  Quoted,    // "any text", with its quotes
  Word       // everything else: names, numbers, operators, :=
};

struct Token {
  TokenKind kind = TokenKind::Word;
  std::string_view text;  // a piece of the source
  SourceSpan span;
};

// Splits a text into its words. Comments, blanks and what cannot be a word are
// left out, the latter with an error.
std::vector<Token> split_words(std::string_view text, Findings& findings);

}  // namespace btcheck::btf
