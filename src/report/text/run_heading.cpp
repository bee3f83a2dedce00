// SPDX-License-Identifier: MIT
#include "report/text/run_heading.hpp"

#include "report/text/report.hpp"

namespace btcheck {
namespace {

// Where the property is lost, or the witness complete: the state that shows
// it, else the end of a finite run. In a loop it is lost nowhere in particular.
std::optional<std::size_t> decisive_state(const PropertyVerdict& verdict) {
  if (verdict.shown_at) return verdict.shown_at;
  if (verdict.run->loop != kNoLoop) return std::nullopt;
  return verdict.run->steps.size();
}

}  // namespace

RunHeading heading_of(const CheckResult& result, const CheckedFile& file,
                      const PropertyVerdict& verdict,
                      const std::string& source) {
  const RunRemarks remarks = remarks_on(result, file, verdict);
  RunHeading heading;
  heading.property = verdict.property->name;
  heading.formula = verdict.property->text;
  heading.verdict = verdict_word(verdict.verdict);
  heading.why = remarks.reason;
  heading.source = source;
  heading.watched = verdict.watched;
  heading.trigger = remarks.state;
  heading.trigger_words = remarks.words;
  heading.end_words = remarks.end;
  heading.lost = decisive_state(verdict);
  return heading;
}

}  // namespace btcheck
