// SPDX-License-Identifier: MIT
//
// Text as code points: decoding, counting, breaking into lines.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace btcheck {

struct CodePoint {
  char32_t value = 0;
  std::size_t length = 1;  // bytes
  bool is_valid = false;   // an invalid one is a single byte
};

// The code point that begins at text[at]; `at` must be below the size.
CodePoint decode(std::string_view text, std::size_t at);

// How many there are, each invalid byte counted as one.
int count_code_points(std::string_view text);

// Control characters, and invisible ones that reorder or hide their neighbours.
bool is_harmful(char32_t c);

// The text with replaced(bytes, point) for each harmful code point and each
// byte that is no UTF-8.
template <class Replaced>
std::string with_harmful(std::string_view text, Replaced replaced) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint point = decode(text, at);
    const std::string_view bytes = text.substr(at, point.length);
    if (point.is_valid && !is_harmful(point.value)) {
      result += bytes;
    } else {
      result += replaced(bytes, point);
    }
    at += point.length;
  }
  return result;
}

// The text with each harmful code point but line feeds and tabs written out, as
// \u{1b}, and each byte that is no UTF-8 as \xff.
std::string harmless(std::string_view text);

// Not the first byte of a code point.
constexpr bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0u) == 0x80;
}

// Of ASCII.
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }
constexpr bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || is_capital(c);
}
constexpr char lowered(char c) {
  return is_capital(c) ? static_cast<char>(c - 'A' + 'a') : c;
}
std::string lowered(std::string_view word);

// The text as it stands in XML, between tags or in an attribute.
std::string with_entities(std::string_view text);

inline constexpr std::size_t kLineWidth = 80;

// The words of a text in lines of at most `width` columns (a longer word has a
// line of its own), without a newline at the end. Each line but the first
// begins with `indent` blanks; the caller has written those of the first.
std::string wrapped(std::string_view text, std::size_t indent,
                    std::size_t width = kLineWidth);

// The text with each line feed written out, as `harmless` writes all that it
// does not leave: "\u{a}". A name is one line, wherever it is shown: every
// reader does this to the names that it reads, so that none of them begins a
// line of a report.
std::string unbroken(std::string_view text);

}  // namespace btcheck
