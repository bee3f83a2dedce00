// SPDX-License-Identifier: MIT
//
// What btcheck says about its input: where, what, and what to do next.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/repair.hpp"

namespace btcheck {

enum class Severity : unsigned char { Error, Warning, Note };

// "error", "warning", "note".
std::string_view severity_name(Severity severity);

// A stretch of one line. Lines and columns count from 1, columns and the
// length in code points; line 0 means the file as a whole.
struct SourceSpan {
  int line = 0;
  int column = 0;
  int length = 1;
};

// Bytes [begin, end) of a text.
struct TextStretch {
  std::size_t begin = 0;
  std::size_t end = 0;

  std::size_t size() const { return end - begin; }
  std::string_view in(std::string_view text) const {
    return text.substr(begin, end - begin);
  }
};

// Releases of an engine, from one to before another; 4.8.4 is 40804.
struct Releases {
  int first = 0;
  int end = 0;

  constexpr bool has(int release) const {
    return first <= release && release < end;
  }
};

inline constexpr int kNoRelease = 1'000'000;  // later than any

// Whether one of the stretches has it.
bool is_among(int release, const std::vector<Releases>& stretches);

// One finding about an input, in the shape rustc made customary. The quoted
// line is kept inside, so a diagnostic can be shown after its text is gone.
struct Diagnostic {
  Severity severity = Severity::Error;
  std::string code;     // "BT1104"; `btcheck explain` knows each
  std::string message;  // lower case, no final period, names in backticks
  std::string file;
  SourceSpan span;
  std::string source_line;  // the text of span.line
  std::string label;        // what stands under the carets
  std::string help;         // what to do next; at most one
  // Repairs that are proposed, the best first; and one that was checked.
  std::vector<Repair> repairs = {};
  std::optional<CheckedRepair> repair = {};
  // The releases of an engine that refuse the file for it; empty: all of them,
  // or no engine is asked. Read for one of these it is an error, where it is no
  // note because it can be read over.
  std::vector<Releases> refused_by = {};
  // A warning that is one for all releases, if what a model in the files says
  // is so in the program.
  bool is_doubtful = false;
};

// The same of a file with a name, where it was read without one.
std::vector<Diagnostic> named(std::vector<Diagnostic> found,
                              std::string_view file);

// A text and its name. It owns neither: both must outlive the SourceText.
class SourceText {
 public:
  SourceText(std::string_view name, std::string_view text);

  std::string_view name() const { return name_; }
  std::string_view text() const { return text_; }

  // The span of text[begin, end); what runs past its line is cut there.
  SourceSpan span(std::size_t begin, std::size_t end) const;

  // The byte that a line and column name; nothing where there is none.
  std::optional<std::size_t> offset(int line, int column) const;

  // The text of a line without its end, "" when there is no such line. Control
  // characters are shown as '?', a tab as one blank.
  std::string line(int number) const;

  Diagnostic diagnostic(Severity severity, std::string_view code,
                        SourceSpan span, std::string message,
                        std::string label = {}, std::string help = {}) const;

  // The reason why this is not a text file (a NUL byte, broken UTF-8), or
  // nothing.
  std::optional<Diagnostic> refuse_binary() const;

 private:
  std::string_view name_;
  std::string_view text_;
  std::vector<std::size_t> line_starts_;  // byte offset of each line
};

// An error in a file as a whole, or about it.
Diagnostic file_error(std::string_view code, const std::string& name,
                      std::string message, std::string help = {});

// A value, and the diagnostics of reading it. Without a value, at least one of
// them is an error.
template <class T>
struct Result {
  std::optional<T> value;
  std::vector<Diagnostic> diagnostics;
};

// True when one of them is an error.
bool has_error(std::span<const Diagnostic> diagnostics);

// By line, then column; equal places keep their order.
void sort_by_place(std::vector<Diagnostic>& diagnostics);

// The text of a diagnostic as it is shown, several lines, ending in a newline:
//
//   error[BT1104]: unknown node `land_`
//     --> drone3.ltl:9:53
//     |
//   9 |     whenever critical then land_.ticked
//     |                            ^^^^^ no node or variable has this name
//     |
//     = help: did you mean `land`?
//
// Where a repair was checked, it stands below the help as a diff; of a long one
// `most` lines. Of a line longer than kQuoteWidth, or `width` where that is
// more, a part is quoted.
inline constexpr std::size_t kFewDiffLines = 8;
inline constexpr std::size_t kQuoteWidth = 100;
std::string render(const Diagnostic& diagnostic,
                   std::size_t most = kFewDiffLines,
                   std::size_t width = kQuoteWidth);

// In bytes, with insertion, deletion, exchange and the swap of neighbours.
std::size_t edit_distance(std::string_view left, std::string_view right);

// The candidate nearest to `word` by edit distance without regard to case, if
// at most a third of its letters differ.
std::optional<std::string> closest_match(
    std::string_view word, std::span<const std::string> candidates);

// "did you mean `x`?" for the closest match, else `otherwise`.
std::string did_you_mean(std::string_view word,
                         std::span<const std::string> candidates,
                         std::string otherwise = {});

// True when two words are equal without regard to ASCII case.
bool equal_ignoring_case(std::string_view left, std::string_view right);

}  // namespace btcheck
