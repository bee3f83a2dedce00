// SPDX-License-Identifier: MIT
#include "text/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace btcheck {
namespace {

// Length in bytes that a first byte announces, 0 when it cannot be first.
std::size_t announced_length(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  if (first >= 0xF0 && first < 0xF5) return 4;
  return 0;
}

bool is_scalar(char32_t value, std::size_t length) {
  constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = value >= 0xD800 && value < 0xE000;
  return value >= kSmallest[length] && value < 0x110000 && !is_surrogate;
}

}  // namespace

CodePoint decode(std::string_view text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const std::size_t length = announced_length(first);
  if (length == 1) return {first, 1, true};
  if (length == 0 || text.size() - at < length) return {};
  char32_t value = first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if (!continues_character(text[at + i])) return {};
    value = (value << 6) | (static_cast<unsigned char>(text[at + i]) & 0x3Fu);
  }
  if (!is_scalar(value, length)) return {};
  return {value, length, true};
}

int count_code_points(std::string_view text) {
  int count = 0;
  for (std::size_t at = 0; at < text.size(); ++count) {
    at += decode(text, at).length;
  }
  return count;
}

bool is_harmful(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0xAD || c == 0x61C ||
         (c >= 0x200B && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E) ||
         (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF || c >= 0xE0000;
}

std::string harmless(std::string_view text) {
  return with_harmful(text, [](std::string_view bytes, CodePoint point) {
    if (bytes == "\n" || bytes == "\t") return std::string(bytes);
    if (point.is_valid) {
      return fmt::format("\\u{{{:x}}}",
                         static_cast<std::uint32_t>(point.value));
    }
    return fmt::format("\\x{:02x}", static_cast<unsigned char>(bytes[0]));
  });
}

std::string wrapped(std::string_view text, std::size_t indent,
                    std::size_t width) {
  std::string result;
  std::size_t column = indent;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end =
        std::min(text.find_first_of(" \n", at), text.size());
    const std::string_view word = text.substr(at, end - at);
    at = end + 1;
    if (word.empty()) continue;
    const auto letters = static_cast<std::size_t>(count_code_points(word));
    if (!result.empty()) {
      const bool fits = column + 1 + letters <= width;
      result += fits ? " " : '\n' + std::string(indent, ' ');
      column = fits ? column + 1 : indent;
    }
    result += word;
    column += letters;
  }
  return result;
}

std::string lowered(std::string_view word) {
  std::string result;
  std::transform(word.begin(), word.end(), std::back_inserter(result),
                 [](char c) { return lowered(c); });
  return result;
}

std::string with_entities(std::string_view text) {
  constexpr std::string_view kEntities[] = {"&amp;", "&lt;", "&gt;", "&quot;",
                                            "&apos;"};
  std::string result;
  for (const char c : text) {
    const std::size_t at = std::string_view("&<>\"'").find(c);
    result +=
        at < std::size(kEntities) ? kEntities[at] : std::string_view(&c, 1);
  }
  return result;
}

std::string unbroken(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n') {
      line += "\\u{a}";
    } else {
      line += c;
    }
  }
  return line;
}

}  // namespace btcheck
