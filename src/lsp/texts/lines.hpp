// SPDX-License-Identifier: MIT
//
// Places in a text as an editor names them: lines and characters from 0, where
// a character is one of the units that were agreed upon.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "serve/message.hpp"
#include "text/diagnostic.hpp"
#include "text/json.hpp"

namespace btcheck::lsp {

// What a character is (PositionEncodingKind): a byte, one or two of UTF-16, or
// a code point.
enum class Encoding : std::uint8_t { Utf8, Utf16, Utf32 };

struct Position {
  std::size_t line = 0;
  std::size_t character = 0;

  bool operator==(const Position&) const = default;
};

struct Range {
  Position begin;
  Position end;

  bool operator==(const Range&) const = default;
};

// The lines of a text. What a file was parsed into (FileText::parsed).
class Lines {
 public:
  // The text must outlive it.
  explicit Lines(const std::string& text);

  // Lines end with \n, \r\n or \r, as the protocol has it.
  std::size_t count() const { return starts_.size(); }
  // Of line `number` from 0, without its end; "" behind the last.
  std::string_view line(std::size_t number) const;

  // The byte of a place; of one behind a line its end, of one behind the text
  // the end of that.
  std::size_t offset(Position place, Encoding encoding) const;
  Position position(std::size_t offset, Encoding encoding) const;
  Range range(TextStretch part, Encoding encoding) const {
    return {position(part.begin, encoding), position(part.end, encoding)};
  }

  // The stretch that a diagnostic names, by lines and code points from 1; of
  // line 0 the first line.
  TextStretch stretch(std::size_t line, std::size_t column,
                      std::size_t length) const;
  TextStretch stretch(const SourceSpan& span) const;

  std::string_view text() const { return text_; }
  // Bytes [begin of line, behind its end).
  TextStretch whole_line(std::size_t number) const;

 private:
  const std::string_view text_;
  std::vector<std::size_t> starts_;
};

// What has changed from one text to another: all but a beginning and an end
// that both have.
class Shift {
 public:
  Shift(std::string_view before, std::string_view after);

  // Where a stretch of the text before stands now: nothing is left of one that
  // has been changed, but its place.
  TextStretch moved(TextStretch before) const;
  // That was changed, of the text before.
  TextStretch part() const { return {begin_, end_}; }

 private:
  std::size_t begin_ = 0;
  std::size_t end_ = 0;  // of the part before
  std::size_t new_end_ = 0;
};

// --- As JSON ----------------------------------------------------------------

Json json_of(Position place);
Json json_of(const Range& range);
// {"range": …, "newText": …}
Json text_edit(const Range& range, std::string_view text);
// Throws RpcError where there is no such place.
Position position_in(const JsonValue& params, std::string_view name);
Range range_in(const JsonValue& params, std::string_view name);

}  // namespace btcheck::lsp
