// SPDX-License-Identifier: MIT
#include "text/json.hpp"

#include <fmt/format.h>

#include "text/utf8.hpp"

namespace btcheck {
namespace {

// How many bytes are no code point but begin like one; at least 1. That many
// are replaced together, as the Unicode standard recommends.
std::size_t broken_length(std::string_view text, std::size_t at) {
  std::size_t length = 1;
  const auto begins_one = [&](std::string part) {
    return decode(part + "\x80\x80", 0).is_valid ||
           decode(part + "\xBF\xBF", 0).is_valid;
  };
  while (at + length < text.size() && continues_character(text[at + length]) &&
         begins_one(std::string(text.substr(at, length + 1)))) {
    ++length;
  }
  return length;
}

}  // namespace

std::string valid_utf8(std::string_view text) {
  std::string valid;
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint point = decode(text, at);
    const std::size_t length =
        point.is_valid ? point.length : broken_length(text, at);
    valid += point.is_valid ? text.substr(at, length) : "\ufffd";
    at += length;
  }
  return valid;
}

Json::Json(std::initializer_list<std::pair<std::string_view, Json>> members)
    : text_("{}") {
  for (const auto& [name, value] : members) add(name, value);
}

Json Json::raw(std::string_view text) {
  Json json;
  json.text_ = text;
  return json;
}

void Json::append_quoted(std::string_view text) {
  constexpr std::string_view kEscaped = "\"\\\b\f\n\r\t";
  text_ += '"';
  for (const char c : valid_utf8(text)) {
    const std::size_t mark = kEscaped.find(c);
    if (mark != std::string_view::npos) {
      text_ += {'\\', "\"\\bfnrt"[mark]};
    } else if (static_cast<unsigned char>(c) < 0x20) {
      text_ += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      text_ += c;
    }
  }
  text_ += '"';
}

// Takes the last bracket away for what comes next.
void Json::reopen() {
  const bool was_empty = is_empty();
  text_.pop_back();
  if (!was_empty) text_ += ',';
}

Json& Json::push(const Json& element) {
  reopen();
  text_ += element.text_;
  text_ += ']';
  return *this;
}

Json& Json::add(std::string_view name, const Json& value) {
  reopen();
  append_quoted(name);
  text_ += ':';
  text_ += value.text_;
  text_ += '}';
  return *this;
}

std::string Json::indented(std::size_t by) const {
  std::string result;
  std::size_t depth = 0;
  bool is_quoted = false;
  const auto new_line = [&] { result += '\n' + std::string(depth * by, ' '); };
  for (std::size_t at = 0; at < text_.size(); ++at) {
    const char c = text_[at];
    const std::string_view two = std::string_view(text_).substr(at, 2);
    if (is_quoted || two == "{}" || two == "[]") {
      result += c;
      if (!is_quoted || c == '\\') result += text_[++at];
      is_quoted = is_quoted && c != '"';
      continue;
    }
    is_quoted = c == '"';
    if (c == '}' || c == ']') {
      --depth;
      new_line();
    }
    result += c;
    if (c == '{' || c == '[') ++depth;
    if (c == '{' || c == '[' || c == ',') new_line();
    if (c == ':') result += ' ';
  }
  return result;
}

}  // namespace btcheck
