// SPDX-License-Identifier: MIT
//
// What a diagnostic does to the line it quotes is what a picture needs as well:
// a name can neither move the cursor nor break the file it is written into.
#include "trace/run/shown_text.hpp"

#include "text/diagnostic.hpp"
#include "text/utf8.hpp"

namespace btcheck {
std::string one_line(std::string_view text) {
  return SourceText({}, text.substr(0, text.find_first_of("\r\n"))).line(1);
}

std::size_t letter_count(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text) count += !continues_character(c);
  return count;
}

std::string shortened(std::string_view text, std::size_t most) {
  if (letter_count(text) <= most) return std::string(text);
  std::size_t end = 0;
  for (std::size_t seen = 0; end < text.size(); ++end) {
    if (!continues_character(text[end]) && ++seen == most) break;
  }
  return std::string(text.substr(0, end)) + "…";
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string plain_word(std::string_view name, std::string_view also) {
  std::string word;
  for (const char c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') ||
                          also.find(c) != std::string_view::npos;
    if (!continues_character(c)) word += is_plain ? c : '_';
  }
  return word;
}

std::string xml_escaped(std::string_view text) {
  return with_entities(one_line(text));
}

}  // namespace btcheck
