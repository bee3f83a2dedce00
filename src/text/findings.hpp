// SPDX-License-Identifier: MIT
//
// What is found on the way through a .btf file, until it is handed over.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "text/diagnostic.hpp"

namespace btcheck::btf {

// What a diagnostic says besides where and how bad.
struct Finding {
  std::string_view code;
  std::string message;
  std::string label;
  std::string help;
};

// Collects diagnostics: one per place and message, at most 20 errors and 20
// warnings. `take` hands them over in the order of the text, with a last note
// when there were more.
class Findings {
 public:
  explicit Findings(const SourceText& source) : source_(source) {}

  void error(SourceSpan span, Finding finding);
  void warning(SourceSpan span, Finding finding);
  void note(SourceSpan span, Finding finding);  // counted as a warning
  // BT1007: `written` stands where `declared` was meant, up to case. Says
  // nothing when they are equal.
  void case_warning(SourceSpan span, std::string_view written,
                    std::string_view declared);

  bool has_error() const { return errors_ > 0; }
  // True when no further error will be shown, so that none needs wording.
  bool is_full() const { return errors_ > kMostShown; }
  std::vector<Diagnostic> take();

 private:
  static constexpr int kMostShown = 20;

  void add(Severity severity, SourceSpan span, Finding finding, int& count);

  const SourceText& source_;
  int errors_ = 0;
  int warnings_ = 0;
  std::set<std::tuple<int, int, std::string>> seen_;
  std::vector<Diagnostic> diagnostics_;
};

// "did you mean `word`?" for the candidate nearest to `word`, or "".
std::string did_you_mean(std::string_view word,
                         const std::vector<std::string>& candidates);

// "`a`, `b` and `c`", shortened after the first eight.
std::string listed(const std::vector<std::string>& words);

}  // namespace btcheck::btf
