// SPDX-License-Identifier: MIT
//
// Text between tags is passed over, and so are comments, declarations and
// CDATA: nothing of what a log says stands there.
#include "trace/logs/xml_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace btcheck {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool ends_word(char c) {
  return is_blank(c) || c == '=' || c == '/' || c == '>' || c == '<' ||
         c == '"' || c == '\'';
}

// UTF-8; '?' for what is no character.
void append_character(std::string& to, std::uint32_t code) {
  const auto add = [&](std::uint32_t byte) { to += static_cast<char>(byte); };
  const bool is_surrogate = code >= 0xD800 && code < 0xE000;
  if (code == 0 || is_surrogate || code >= 0x110000) {
    to += '?';
  } else if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xC0 | (code >> 6));
    add(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    add(0xE0 | (code >> 12));
    add(0x80 | ((code >> 6) & 0x3F));
    add(0x80 | (code & 0x3F));
  } else {
    add(0xF0 | (code >> 18));
    add(0x80 | ((code >> 12) & 0x3F));
    add(0x80 | ((code >> 6) & 0x3F));
    add(0x80 | (code & 0x3F));
  }
}

// What stands for `entity`, the text between & and ;. False: it is unknown.
bool append_entity(std::string& to, std::string_view entity) {
  constexpr std::pair<std::string_view, char> kNamed[] = {
      {"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}};
  for (const auto& [name, character] : kNamed) {
    if (name != entity) continue;
    to += character;
    return true;
  }
  if (!entity.starts_with('#')) return false;
  const bool is_hex = entity.substr(1, 1) == "x";
  entity.remove_prefix(is_hex ? 2 : 1);
  std::uint32_t code = 0;
  const char* end = entity.data() + entity.size();
  const auto [stop, error] =
      std::from_chars(entity.data(), end, code, is_hex ? 16 : 10);
  if (error != std::errc() || stop != end) return false;
  append_character(to, code);
  return true;
}

std::string unescaped(std::string_view raw) {
  constexpr std::size_t kLongestEntity = 10;
  std::string value;
  for (std::size_t at = 0; at < raw.size(); ++at) {
    const std::size_t end = raw[at] == '&'
                                ? raw.substr(at, kLongestEntity).find(';')
                                : std::string_view::npos;
    if (end != std::string_view::npos &&
        append_entity(value, raw.substr(at + 1, end - 1))) {
      at += end;
    } else {
      value += raw[at];
    }
  }
  return value;
}

}  // namespace

const std::string* XmlTag::find(std::string_view attribute) const {
  for (const auto& [word, value] : attributes) {
    if (word == attribute) return &value;
  }
  return nullptr;
}

std::size_t XmlScanner::line() const {
  const auto before = text_.substr(0, begin_);
  return 1 + static_cast<std::size_t>(
                 std::count(before.begin(), before.end(), '\n'));
}

std::optional<XmlTag> XmlScanner::refuse(std::string_view why) {
  flaw_ = why;
  at_ = text_.size();
  return std::nullopt;
}

bool XmlScanner::skip_past(std::string_view end) {
  const std::size_t found = text_.find(end, at_);
  if (found == std::string_view::npos) return false;
  at_ = found + end.size();
  return true;
}

void XmlScanner::skip_blanks() {
  while (!at_end() && is_blank(here())) ++at_;
}

std::string_view XmlScanner::word() {
  const std::size_t begin = at_;
  while (!at_end() && !ends_word(here())) ++at_;
  return text_.substr(begin, at_ - begin);
}

// Passes over what begins with <! or <?. False: it does not end.
bool XmlScanner::skip_other() {
  const std::string_view rest = text_.substr(at_);
  if (rest.starts_with("<!--")) return at_ += 4, skip_past("-->");
  if (rest.starts_with("<![CDATA[")) return skip_past("]]>");
  return skip_past(rest.starts_with("<?") ? "?>" : ">");
}

bool XmlScanner::read_attribute(XmlTag& tag) {
  const std::string_view name = word();
  skip_blanks();
  if (name.empty() || at_end() || here() != '=') return false;
  ++at_;
  skip_blanks();
  if (at_end() || (here() != '"' && here() != '\'')) return false;
  const char quote = here();
  const std::size_t begin = ++at_;
  if (!skip_past(std::string_view(&quote, 1))) return false;
  tag.attributes.emplace_back(name,
                              unescaped(text_.substr(begin, at_ - 1 - begin)));
  return true;
}

std::optional<XmlTag> XmlScanner::next() {
  for (;;) {
    at_ = std::min(text_.find('<', at_), text_.size());
    begin_ = at_;
    if (at_end()) return std::nullopt;
    const char second = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
    if (second != '!' && second != '?') break;
    if (!skip_other()) return refuse("a comment or declaration does not end");
  }
  ++at_;
  XmlTag tag;
  tag.closes = !at_end() && here() == '/';
  tag.opens = !tag.closes;
  if (tag.closes) ++at_;
  tag.name = word();
  if (tag.name.empty()) return refuse("a `<` without a name");
  for (;;) {
    skip_blanks();
    if (at_end()) return refuse("a tag does not end");
    if (here() == '>') break;
    if (text_.substr(at_).starts_with("/>") && tag.opens) {
      tag.closes = true;
      ++at_;
      break;
    }
    if (!read_attribute(tag)) return refuse("an attribute without a value");
  }
  ++at_;
  return tag;
}

}  // namespace btcheck
