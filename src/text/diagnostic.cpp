// SPDX-License-Identifier: MIT
//
// Positions in a text, and diagnostics as they are shown.
//
// A position is a line and a column of code points, found from a byte offset
// through the table of line starts. Every quotation is cleaned first: each
// control character, broken byte and invisible direction mark becomes one '?'.
// So a hostile file can neither move the cursor nor reorder the line it is
// shown in, and a column still counts one per code point. A long line is shown
// through a window around its carets.
#include "text/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <utility>

#include "text/utf8.hpp"

namespace btcheck {
namespace {

// One shown character per code point.
std::string cleaned(std::string_view text) {
  return with_harmful(text, [](std::string_view bytes, CodePoint) {
    return bytes == "\t" ? ' ' : '?';
  });
}

// The bytes of the code points [begin, end) of a text.
std::string_view code_points(std::string_view text, int begin, int end) {
  std::size_t at = 0;
  std::size_t start = text.size();
  for (int count = 0; at < text.size() && count < end; ++count) {
    if (count == begin) start = at;
    at += decode(text, at).length;
  }
  start = std::min(start, at);
  return text.substr(start, at - start);
}

// The number of a line, the bar behind it, and `...` on both sides.
constexpr std::size_t kFrame = 16;

// The part of a line that is shown, and where its carets start (from 0).
struct Quote {
  std::string text;
  int column = 0;
  int length = 1;
};

Quote quote(const Diagnostic& diagnostic, std::size_t columns) {
  const int width =
      static_cast<int>(std::max(columns, kQuoteWidth + kFrame) - kFrame);
  constexpr int kBefore = 30;
  const int column = std::max(diagnostic.span.column - 1, 0);
  const int length = std::max(diagnostic.span.length, 1);
  const int total = count_code_points(diagnostic.source_line);
  if (total <= width) {
    return {cleaned(diagnostic.source_line), std::min(column, total),
            std::min(length, std::max(total - column, 1))};
  }
  const int begin = std::clamp(column - kBefore, 0, total);
  const int end = std::min(begin + width, total);
  const std::string_view left = begin > 0 ? "..." : "";
  const std::string_view right = end < total ? "..." : "";
  const int start = std::min(column, total) - begin;
  return {fmt::format("{}{}{}", left,
                      cleaned(code_points(diagnostic.source_line, begin, end)),
                      right),
          start + static_cast<int>(left.size()),
          std::clamp(length, 1, std::max(end - begin - start, 1))};
}

std::string heading(const Diagnostic& diagnostic) {
  const std::string code =
      diagnostic.code.empty() ? "" : fmt::format("[{}]", diagnostic.code);
  return fmt::format("{}{}: {}\n", severity_name(diagnostic.severity),
                     cleaned(code), cleaned(diagnostic.message));
}

// The quoted line with its carets, and the empty frame lines around it.
std::string excerpt(const Diagnostic& diagnostic, const std::string& margin,
                    std::size_t width) {
  const Quote shown = quote(diagnostic, width);
  const std::string bar = margin + " |";
  const std::string label =
      diagnostic.label.empty() ? "" : " " + cleaned(diagnostic.label);
  return fmt::format(
      "{}\n{} |{}{}\n{} {:{}}{}{}\n", bar, diagnostic.span.line,
      shown.text.empty() ? "" : " ", shown.text, bar, "", shown.column,
      std::string(static_cast<std::size_t>(shown.length), '^'), label);
}

// The help, or what it is; what follows its first line stands below its first
// word.
std::string advice(std::string_view title, const std::string& help,
                   const std::string& margin) {
  std::string result = fmt::format("{} = {}: ", margin, title);
  const std::string indent(margin.size() + title.size() + 5, ' ');
  std::size_t at = 0;
  for (std::size_t end; (end = help.find('\n', at)) != std::string::npos;
       at = end + 1) {
    result += cleaned(std::string_view(help).substr(at, end - at));
    result += "\n" + indent;
  }
  return result + cleaned(std::string_view(help).substr(at)) + "\n";
}

// The help, and the lines that it comes to.
std::string repair_text(const Diagnostic& diagnostic, const std::string& margin,
                        std::size_t most) {
  constexpr std::string_view kTitle = "repair, checked";
  const CheckedRepair& repair = *diagnostic.repair;
  if (!repair.comes_from.empty()) {
    return advice(kTitle, "that of " + repair.comes_from, margin);
  }
  std::string result = advice(kTitle, diagnostic.help, margin);
  const std::string indent(margin.size() + 3, ' ');
  for (const std::string& line : diff_lines(repair, most)) {
    result += indent + cleaned(line) + "\n";
  }
  return result;
}

}  // namespace

std::string_view severity_name(Severity severity) {
  constexpr std::string_view kNames[] = {"error", "warning", "note"};
  return kNames[static_cast<std::size_t>(severity)];
}

bool is_among(int release, const std::vector<Releases>& stretches) {
  return std::ranges::any_of(
      stretches, [&](const Releases& each) { return each.has(release); });
}

std::vector<Diagnostic> named(std::vector<Diagnostic> found,
                              std::string_view file) {
  for (Diagnostic& each : found) each.file = file;
  return found;
}

SourceText::SourceText(std::string_view name, std::string_view text)
    : name_(name), text_(text), line_starts_{0} {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\n') line_starts_.push_back(at + 1);
  }
}

SourceSpan SourceText::span(std::size_t begin, std::size_t end) const {
  begin = std::min(begin, text_.size());
  const auto next =
      std::upper_bound(line_starts_.begin(), line_starts_.end(), begin);
  assert(next != line_starts_.begin());
  const std::size_t start = *std::prev(next);
  const std::size_t line_end =
      std::min(text_.find_first_of("\r\n", begin), text_.size());
  const auto piece = [&](std::size_t from, std::size_t to) {
    return count_code_points(text_.substr(from, to - from));
  };
  return {static_cast<int>(next - line_starts_.begin()),
          piece(start, begin) + 1,
          std::max(piece(begin, std::clamp(end, begin, line_end)), 1)};
}

std::optional<std::size_t> SourceText::offset(int line, int column) const {
  if (line < 1 || static_cast<std::size_t>(line) > line_starts_.size()) {
    return std::nullopt;
  }
  std::size_t at = line_starts_[static_cast<std::size_t>(line) - 1];
  for (int passed = 1; passed < column; ++passed) {
    if (at >= text_.size() || text_[at] == '\n') return std::nullopt;
    at += decode(text_, at).length;
  }
  return at;
}

std::string SourceText::line(int number) const {
  if (number < 1 || static_cast<std::size_t>(number) > line_starts_.size()) {
    return "";
  }
  const std::size_t start = line_starts_[static_cast<std::size_t>(number) - 1];
  const std::size_t end = std::min(text_.find('\n', start), text_.size());
  std::string_view raw = text_.substr(start, end - start);
  if (raw.ends_with('\r')) raw.remove_suffix(1);
  return cleaned(raw);
}

Diagnostic SourceText::diagnostic(Severity severity, std::string_view code,
                                  SourceSpan span, std::string message,
                                  std::string label, std::string help) const {
  return {severity, std::string(code), std::move(message), std::string(name_),
          span,     line(span.line),   std::move(label),   std::move(help)};
}

std::optional<Diagnostic> SourceText::refuse_binary() const {
  for (std::size_t at = 0; at < text_.size();) {
    const CodePoint point = decode(text_, at);
    if (!point.is_valid || point.value == 0) {
      return diagnostic(Severity::Error, "BT1000", span(at, at + 1),
                        "this file is not text",
                        point.is_valid ? "a NUL byte" : "not UTF-8",
                        "save the file as UTF-8 text");
    }
    at += point.length;
  }
  return std::nullopt;
}

Diagnostic file_error(std::string_view code, const std::string& name,
                      std::string message, std::string help) {
  return {
      Severity::Error, std::string(code), std::move(message), name, {}, {}, {},
      std::move(help)};
}

bool has_error(std::span<const Diagnostic> diagnostics) {
  return std::any_of(
      diagnostics.begin(), diagnostics.end(),
      [](const Diagnostic& d) { return d.severity == Severity::Error; });
}

void sort_by_place(std::vector<Diagnostic>& diagnostics) {
  std::stable_sort(diagnostics.begin(), diagnostics.end(),
                   [](const Diagnostic& left, const Diagnostic& right) {
                     return std::pair(left.span.line, left.span.column) <
                            std::pair(right.span.line, right.span.column);
                   });
}

std::string render(const Diagnostic& diagnostic, std::size_t most,
                   std::size_t width) {
  const SourceSpan& span = diagnostic.span;
  const bool has_line = span.line > 0;
  const std::string margin(has_line ? fmt::formatted_size("{}", span.line) : 1,
                           ' ');
  std::string result = heading(diagnostic);
  if (has_line || !diagnostic.file.empty()) {
    result += fmt::format("{} --> {}", margin, cleaned(diagnostic.file));
    if (has_line) result += fmt::format(":{}:{}", span.line, span.column);
    result += "\n";
  }
  if (has_line) result += excerpt(diagnostic, margin, width);
  if (diagnostic.help.empty() && !diagnostic.repair) return result;
  if (has_line) result += margin + " |\n";
  return result + (diagnostic.repair ? repair_text(diagnostic, margin, most)
                                     : advice("help", diagnostic.help, margin));
}

// Optimal string alignment, in three rows.
std::size_t edit_distance(std::string_view left, std::string_view right) {
  std::vector<std::size_t> before_last(right.size() + 1);
  std::vector<std::size_t> last(right.size() + 1);
  std::vector<std::size_t> row(right.size() + 1);
  for (std::size_t j = 0; j <= right.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= left.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= right.size(); ++j) {
      const bool same = left[i - 1] == right[j - 1];
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + !same});
      if (i > 1 && j > 1 && left[i - 1] == right[j - 2] &&
          left[i - 2] == right[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return row[right.size()];
}

namespace {

// The letters that one word has and the other has not: it takes as many edits
// at least.
std::size_t letters_apart(std::string_view left, std::string_view right) {
  std::array<int, 256> count{};
  for (const char c : left) ++count[static_cast<unsigned char>(c)];
  for (const char c : right) --count[static_cast<unsigned char>(c)];
  int more = 0;
  int fewer = 0;
  for (const int each : count) {
    more += std::max(each, 0);
    fewer -= std::min(each, 0);
  }
  return static_cast<std::size_t>(std::max(more, fewer));
}

}  // namespace

std::optional<std::string> closest_match(
    std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t kLongest = 64;
  const std::string wanted = lowered(word);
  std::optional<std::string> nearest;
  std::size_t least = kLongest;
  for (const std::string& candidate : candidates) {
    const auto shorter = std::min(candidate.size(), wanted.size());
    const auto longer = std::max(candidate.size(), wanted.size());
    const std::size_t allowed = longer / 3;
    if (longer > kLongest || longer - shorter > allowed) continue;
    const std::string other = lowered(candidate);
    const auto is_far = [&](std::size_t distance) {
      return distance > allowed || distance >= least;
    };
    if (is_far(letters_apart(wanted, other))) continue;
    const std::size_t distance = edit_distance(wanted, other);
    if (is_far(distance)) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string did_you_mean(std::string_view word,
                         std::span<const std::string> candidates,
                         std::string otherwise) {
  const auto nearest = closest_match(word, candidates);
  return nearest && *nearest != word
             ? fmt::format("did you mean `{}`?", *nearest)
             : otherwise;
}

bool equal_ignoring_case(std::string_view left, std::string_view right) {
  return std::equal(left.begin(), left.end(), right.begin(), right.end(),
                    [](char a, char b) { return lowered(a) == lowered(b); });
}

}  // namespace btcheck
