// SPDX-License-Identifier: MIT
#include "style/lines.hpp"

#include <algorithm>
#include <utility>

#include "text/utf8.hpp"

namespace btcheck::style {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f\v";

std::string_view without_blanks_behind(std::string_view text) {
  const std::size_t last = text.find_last_not_of(kBlanks);
  return text.substr(0, last == text.npos ? 0 : last + 1);
}

}  // namespace

std::string_view line_end_of(std::string_view text) {
  bool is_any = false;
  for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; ++at) {
    if (at == 0 || text[at - 1] != '\r') return "\n";
    is_any = true;
  }
  return is_any ? "\r\n" : "\n";
}

std::optional<int> column_at(std::string_view text, std::size_t at) {
  constexpr std::size_t kLongest = 1000;
  std::size_t from = at;
  while (from > 0 && text[from - 1] != '\n') {
    if (at - --from > kLongest) return std::nullopt;
  }
  if (from == 0 && text.starts_with(kByteOrderMark)) from = 3;
  int column = 0;
  for (; from < at; ++from) {
    if (text[from] == '\t') {
      column += 8 - column % 8;
    } else if (!continues_character(text[from])) {
      ++column;
    }
  }
  return column;
}

Lines::Lines(std::string_view before) : line_end_(line_end_of(before)) {
  if (before.starts_with(kByteOrderMark)) text_ = kByteOrderMark;
  start_ = text_.size();
}

void Lines::add(std::string_view text) {
  text_ += text;
  const std::size_t last = text.rfind('\n');
  if (last != text.npos) {
    column_ = 0;
    text.remove_prefix(last + 1);
  }
  column_ += count_code_points(text);
}

void Lines::begin(int indent, int breaks) {
  if (!is_empty()) {
    text_ += line_end_;
    if (breaks > 1) text_ += line_end_;
  }
  text_.append(static_cast<std::size_t>(indent), ' ');
  column_ = indent;
}

std::string Lines::take() {
  if (!is_empty()) text_ += line_end_;
  return std::move(text_);
}

bool Gap::breaks_line() const {
  return breaks > 0 || std::ranges::any_of(comments, [](const Comment& each) {
           return each.breaks > 0;
         });
}

Gap gap_in(std::string_view text, TextStretch part, CommentLength length) {
  Gap gap;
  gap.is_blank = part.size() > 0;
  for (std::size_t at = part.begin; at < part.end;) {
    const std::size_t size = std::min(length(text.substr(at)), part.end - at);
    if (size == 0) {
      if (text[at] == '\n') ++gap.breaks;
      ++at;
      continue;
    }
    gap.comments.push_back(
        {without_blanks_behind(text.substr(at, size)), gap.breaks});
    const std::string_view before = text.substr(part.begin, at - part.begin);
    if (before.ends_with("  ") || before.ends_with('\t')) {
      gap.comments.back().column = column_at(text, at);
    }
    gap.breaks = 0;
    at += size;
  }
  return gap;
}

void add_behind(Lines& lines, const Comment& comment) {
  const int blanks = comment.column.value_or(0) - lines.column();
  lines.add(std::string(static_cast<std::size_t>(std::max(1, blanks)), ' '));
  lines.add(comment.text);
}

}  // namespace btcheck::style
