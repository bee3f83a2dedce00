// SPDX-License-Identifier: MIT
//
// Collects the diagnostics of a file that is read in several passes.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "text/diagnostic.hpp"

namespace btcheck {

// A diagnostic without its place and severity.
struct Wording {
  std::string_view code;
  std::string message;
  std::string label;
  std::string help;
  std::vector<Repair> repairs = {};
  std::vector<Releases> refused_by = {};
  bool is_doubtful = false;
};

// Keeps one diagnostic per place and message, at most 20 errors and 20
// warnings. `take` returns them in the order of the text, with a note at the
// end when there were more.
class Findings {
 public:
  explicit Findings(const SourceText& source) : source_(source) {}
  // Goes on from what was found in the same text, when it had no name.
  Findings(const SourceText& source, const Findings& so_far)
      : source_(source),
        errors_(so_far.errors_),
        warnings_(so_far.warnings_),
        seen_(so_far.seen_),
        diagnostics_(named(so_far.diagnostics_, source.name())) {}

  void error(SourceSpan span, Wording wording);
  void warning(SourceSpan span, Wording wording);
  void note(SourceSpan span, Wording wording);  // counted as a warning
  // BT1007: `written` stands where `declared` was meant, up to case. Says
  // nothing when they are equal.
  void case_warning(SourceSpan span, std::string_view written,
                    std::string_view declared);

  bool has_error() const { return errors_ > 0; }
  // No further error will be shown.
  bool is_full() const { return errors_ > kMostShown; }
  std::vector<Diagnostic> take();

 private:
  static constexpr int kMostShown = 20;

  void add(Severity severity, SourceSpan span, Wording wording, int& count);

  const SourceText& source_;
  int errors_ = 0;
  int warnings_ = 0;
  std::set<std::tuple<int, int, std::string>> seen_;
  std::vector<Diagnostic> diagnostics_;
};

// "a", "a and b", "a, b and c".
std::string enumerated(const std::vector<std::string>& names);

// "`a`, `b` and `c`", shortened after the first eight.
std::string listed(const std::vector<std::string>& words);

}  // namespace btcheck
