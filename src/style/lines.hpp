// SPDX-License-Identifier: MIT
//
// What the styles of all languages share: a text that is written line by line,
// and what stands between two words of one that was read.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"

namespace btcheck::style {

inline constexpr int kWidth = 100;
inline constexpr int kIndent = 2;
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// How a text ends its lines: by "\r\n" where all of them end so.
std::string_view line_end_of(std::string_view text);

// The column where text[at] stands, from 0; a tab goes on to the next multiple
// of eight. Nothing where its line is so long that no column is meant.
std::optional<int> column_at(std::string_view text, std::size_t at);

class Lines {
 public:
  // Written like `before`, with its byte order mark.
  explicit Lines(std::string_view before);

  int column() const { return column_; }
  // Nothing is written yet.
  bool is_empty() const { return text_.size() == start_; }
  // May be of several lines, which stay as they are.
  void add(std::string_view text);
  // Begins a line, where something is written; behind an empty one where
  // `breaks`, the line breaks that stood here, are more than one.
  void begin(int indent, int breaks);

  std::string take();

 private:
  std::string text_;
  std::string_view line_end_;
  std::size_t start_ = 0;
  int column_ = 0;
};

struct Comment {
  std::string_view text;
  int breaks = 0;  // between what stands before it and itself
  // Where it stands, if that is apart from what is before it in its line.
  std::optional<int> column = {};
};

// What stands between two words.
struct Gap {
  std::vector<Comment> comments;
  int breaks = 0;  // behind the last comment
  bool is_blank = false;

  bool breaks_line() const;
};

// How long the comment is that begins here, 0 for none.
using CommentLength = std::size_t (*)(std::string_view text);
Gap gap_in(std::string_view text, TextStretch part, CommentLength length);

// A comment behind something in a line: where it stood, if it stood apart and
// what is before it leaves that free; else one blank behind.
void add_behind(Lines& lines, const Comment& comment);

}  // namespace btcheck::style
