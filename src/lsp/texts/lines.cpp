// SPDX-License-Identifier: MIT
#include "lsp/texts/lines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/utf8.hpp"

namespace btcheck::lsp {
namespace {

// The units of a code point.
std::size_t units(const CodePoint& point, Encoding encoding) {
  if (encoding == Encoding::Utf8) return point.length;
  return encoding == Encoding::Utf16 && point.value > 0xFFFF ? 2 : 1;
}

}  // namespace

Lines::Lines(const std::string& text) : text_(text) {
  starts_.push_back(0);
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool is_end =
        text[at] == '\n' ||
        (text[at] == '\r' && (at + 1 == text.size() || text[at + 1] != '\n'));
    if (is_end) starts_.push_back(at + 1);
  }
}

TextStretch Lines::whole_line(std::size_t number) const {
  if (number >= starts_.size()) return {text_.size(), text_.size()};
  return {starts_[number],
          number + 1 < starts_.size() ? starts_[number + 1] : text_.size()};
}

std::string_view Lines::line(std::size_t number) const {
  std::string_view text = whole_line(number).in(text_);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) {
    text.remove_suffix(1);
  }
  return text;
}

std::size_t Lines::offset(Position place, Encoding encoding) const {
  if (place.line >= starts_.size()) return text_.size();
  const std::string_view text = line(place.line);
  std::size_t at = 0;
  for (std::size_t passed = 0; at < text.size();) {
    const CodePoint point = decode(text, at);
    passed += units(point, encoding);
    if (passed > place.character) break;
    at += point.length;
  }
  return starts_[place.line] + at;
}

Position Lines::position(std::size_t offset, Encoding encoding) const {
  const auto behind = std::ranges::upper_bound(starts_, offset);
  const auto number = static_cast<std::size_t>(behind - starts_.begin()) - 1;
  const std::string_view text = line(number);
  const std::size_t end = std::min(offset - starts_[number], text.size());
  std::size_t character = 0;
  for (std::size_t at = 0; at < end;) {
    const CodePoint point = decode(text, at);
    character += units(point, encoding);
    at += point.length;
  }
  return {number, character};
}

TextStretch Lines::stretch(std::size_t line_number, std::size_t column,
                           std::size_t length) const {
  const std::size_t number = line_number == 0 ? 0 : line_number - 1;
  const std::size_t first = line_number == 0 || column == 0 ? 0 : column - 1;
  const std::size_t begin = offset({number, first}, Encoding::Utf32);
  if (line_number == 0) return {begin, begin + line(0).size()};
  return {begin, offset({number, first + length}, Encoding::Utf32)};
}

TextStretch Lines::stretch(const SourceSpan& span) const {
  const auto number = [](int value) {
    return static_cast<std::size_t>(std::max(0, value));
  };
  return stretch(number(span.line), number(span.column), number(span.length));
}

Shift::Shift(std::string_view before, std::string_view after) {
  const auto [left, right] = std::ranges::mismatch(before, after);
  begin_ = static_cast<std::size_t>(left - before.begin());
  const std::size_t most = std::min(before.size(), after.size()) - begin_;
  std::size_t behind = 0;
  while (behind < most && before[before.size() - 1 - behind] ==
                              after[after.size() - 1 - behind]) {
    ++behind;
  }
  end_ = before.size() - behind;
  new_end_ = after.size() - behind;
}

// What is put in before a stretch is not in it, nor what is put in behind.
TextStretch Shift::moved(TextStretch before) const {
  const auto behind = [&](std::size_t at) {
    return at >= end_ ? at - end_ + new_end_ : std::min(at, new_end_);
  };
  const std::size_t begin =
      before.begin < begin_ ? before.begin : behind(before.begin);
  const std::size_t end =
      before.end <= begin_ ? before.end : behind(before.end);
  return {begin, std::max(begin, end)};
}

// --- As JSON ----------------------------------------------------------------

Json json_of(Position place) {
  return {{"line", place.line}, {"character", place.character}};
}

Json json_of(const Range& range) {
  return {{"start", json_of(range.begin)}, {"end", json_of(range.end)}};
}

Json text_edit(const Range& range, std::string_view text) {
  return {{"range", json_of(range)}, {"newText", text}};
}

namespace {

const JsonValue& needed(const JsonValue& params, std::string_view name) {
  const JsonValue* found = params.member(name);
  if (found != nullptr) return *found;
  throw RpcError(rpc::kInvalidParams, fmt::format("`{}` is needed", name));
}

}  // namespace

Position position_in(const JsonValue& params, std::string_view name) {
  const JsonValue& place = needed(params, name);
  return {static_cast<std::size_t>(number_or(place, "line", 0, 0)),
          static_cast<std::size_t>(number_or(place, "character", 0, 0))};
}

Range range_in(const JsonValue& params, std::string_view name) {
  const JsonValue& range = needed(params, name);
  return {position_in(range, "start"), position_in(range, "end")};
}

}  // namespace btcheck::lsp
