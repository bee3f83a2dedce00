// SPDX-License-Identifier: MIT
//
// Every text is made plain first; what follows deals only with the marks of its
// own format.
#include "report/formats/escapes.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <initializer_list>
#include <utility>

#include "text/utf8.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// Allowed in XML, and nothing that a terminal would act on.
bool is_plain(const CodePoint& point) {
  const char32_t c = point.value;
  if (!point.is_valid) return false;
  if (c < 0x20) return c == '\t' || c == '\n';
  return (c < 0x7F || c >= 0xA0) && c != 0xFFFE && c != 0xFFFF;
}

using Replacements = std::initializer_list<std::pair<char, std::string_view>>;

// The plain text with some of its characters replaced.
std::string replaced(std::string_view text, Replacements replacements) {
  std::string result;
  for (const char c : plain_text(text)) {
    std::string_view written(&c, 1);
    for (const auto& [from, to] : replacements) {
      if (c == from) written = to;
    }
    result += written;
  }
  return result;
}

}  // namespace

std::string plain_text(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint point = decode(text, at);
    if (text.substr(at).starts_with("\r\n")) {
      // The line feed follows.
    } else if (!is_plain(point)) {
      result += '?';
    } else {
      result += text.substr(at, point.length);
    }
    at += point.length;
  }
  return result;
}

// A report may be printed into a log of GitHub, which obeys lines that begin
// so.
std::string xml_text(std::string_view text) {
  std::string result = with_entities(plain_text(text));
  for (std::size_t at = 0; at < result.size();
       at = std::min(result.find('\n', at), result.size() - 1) + 1) {
    const std::size_t begin = result.find_first_not_of(" \t", at);
    if (begin == result.npos) break;
    if (result.compare(begin, 2, "::") == 0) result.replace(begin, 1, "&#58;");
  }
  return result;
}

std::string xml_attribute(std::string_view text) {
  return replaced(xml_text(text), {{'\n', "&#10;"}, {'\t', "&#9;"}});
}

std::string github_message(std::string_view text) {
  return replaced(text, {{'%', "%25"}, {'\n', "%0A"}});
}

std::string github_property(std::string_view text) {
  return replaced(github_message(text), {{':', "%3A"}, {',', "%2C"}});
}

std::string sarif_message(std::string_view text) {
  std::string result = replaced(text, {{'{', "{{"}, {'}', "}}"}});
  for (std::size_t at = 0; (at = result.find("](", at)) != result.npos;) {
    result.insert(at + 1, " ");
  }
  return result;
}

std::string markdown_text(std::string_view text) {
  std::string result;
  for (const char c : plain_text(text)) {
    const bool has_meaning = std::string_view("\\`*_{}[]()#+!|~<>&").find(c) !=
                             std::string_view::npos;
    if (c == '\n' || c == '\t') {
      result += ' ';
    } else if (has_meaning) {
      result += fmt::format("&#{};", static_cast<int>(c));
    } else {
      result += c;
    }
  }
  return result;
}

std::string path_from(std::string_view root, std::string_view directory,
                      std::string_view file) {
  namespace fs = std::filesystem;
  const fs::path here(directory);
  const fs::path path = (here / file).lexically_normal();
  const fs::path from_root = path.lexically_relative(here / root);
  const bool is_below = !from_root.empty() && *from_root.begin() != "..";
  if (is_below) return from_root.generic_string();
  const fs::path written(file);
  return written.is_absolute() ? path.generic_string()
                               : written.lexically_normal().generic_string();
}

std::string without_ending(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  const std::size_t slash = path.rfind('/');
  const bool has_ending =
      dot != path.npos && dot > 0 && (slash == path.npos || dot > slash + 1);
  return std::string(has_ending ? path.substr(0, dot) : path);
}

std::string uri_of(std::string_view path) {
  std::string uri = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    const std::string_view letter(&c, 1);
    const bool is_unreserved = plain_word(letter, "-.~/") == letter;
    uri += is_unreserved
               ? std::string(letter)
               : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

std::string fingerprint(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3;
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace btcheck
