// SPDX-License-Identifier: MIT
//
// A reader goes on after an error, in several passes over the same forms, and
// reads a subtree once for every place that uses it: it may report the same
// thing twice. The order of the passes means nothing to the user, so the
// diagnostics are sorted by position.
#include "text/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace btcheck {

void Findings::error(SourceSpan span, Wording wording) {
  add(Severity::Error, span, std::move(wording), errors_);
}

void Findings::warning(SourceSpan span, Wording wording) {
  add(Severity::Warning, span, std::move(wording), warnings_);
}

void Findings::note(SourceSpan span, Wording wording) {
  add(Severity::Note, span, std::move(wording), warnings_);
}

void Findings::case_warning(SourceSpan span, std::string_view written,
                            std::string_view declared) {
  if (written == declared) return;
  warning(
      span,
      {"BT1007", fmt::format("`{}` is written `{}` here", declared, written),
       "upper and lower case differ", fmt::format("write `{}`", declared)});
}

void Findings::add(Severity severity, SourceSpan span, Wording wording,
                   int& count) {
  // Beyond the limit nothing is remembered, so that memory stays bounded.
  if (count < kMostShown) {
    const bool is_new =
        seen_.emplace(span.line, span.column, wording.message).second;
    if (!is_new) return;
    diagnostics_.push_back(source_.diagnostic(
        severity, wording.code, span, std::move(wording.message),
        std::move(wording.label), std::move(wording.help)));
    diagnostics_.back().repairs = std::move(wording.repairs);
    diagnostics_.back().refused_by = std::move(wording.refused_by);
    diagnostics_.back().is_doubtful = wording.is_doubtful;
  } else if (seen_.contains({span.line, span.column, wording.message})) {
    return;
  }
  ++count;
}

std::vector<Diagnostic> Findings::take() {
  sort_by_place(diagnostics_);
  if (errors_ > kMostShown || warnings_ > kMostShown) {
    diagnostics_.push_back(source_.diagnostic(
        Severity::Note, "", SourceSpan{},
        fmt::format("only the first {} {} are shown", kMostShown,
                    errors_ > kMostShown ? "errors" : "warnings")));
  }
  return std::exchange(diagnostics_, {});
}

std::string enumerated(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i];
  }
  return text;
}

std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t kMost = 8;
  const std::size_t shown = std::min(words.size(), kMost);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    const bool is_last = i + 1 == words.size();
    text += i == 0 ? "" : is_last ? " and " : ", ";
    text += fmt::format("`{}`", words[i]);
  }
  return words.size() > kMost ? text + " and more" : text;
}

}  // namespace btcheck
