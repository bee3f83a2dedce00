// SPDX-License-Identifier: MIT
#include "cli/trace_command.hpp"

#include <fmt/format.h>

#include "trace/formats/chrome.hpp"
#include "trace/formats/mcap.hpp"
#include "trace/formats/text.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/logs/btlog.hpp"
#include "trace/pictures/pictures.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/recorded_run.hpp"
#include "trace/run/substitution.hpp"
#include "trace/viewer/html.hpp"

namespace btcheck {
namespace {

// The verdict, the property, why, and the run: as `check` tells them.
std::string told(const RecordedRun& run, Detail detail) {
  std::string text =
      fmt::format("{}: {}  {}\n", run.tree, run.verdict, run.property);
  if (run.formula != run.property) text += fmt::format("  {}\n", run.formula);
  if (!run.why.empty()) text += fmt::format("  why: {}\n", run.why);
  TextStyle style;
  style.detail = detail;
  if (run.trigger != kNoState) style.trigger_state = run.trigger;
  style.trigger_words = run.trigger_words;
  text += '\n' + run_text(run, style);
  if (!run.end_words.empty()) {
    text += fmt::format("{}-- {}\n", style.indent, run.end_words);
  }
  return text;
}

// The last state of a tick; without one, the state that counts.
std::optional<std::size_t> state_at(const RecordedRun& run,
                                    std::optional<int> tick) {
  if (!tick) return shown_state(run);
  std::optional<std::size_t> found;
  for (const std::size_t end : tick_ends(run)) {
    if (run.states[end].tick == *tick) found = end;
  }
  return found;
}

Result<std::string> written(const std::string& file, const RecordedRun& run,
                            const Options& options) {
  const auto at = state_at(run, options.trace_tick);
  if (!at) {
    return {std::nullopt,
            {SourceText(file, {}).diagnostic(
                Severity::Error, "BT1305", {},
                fmt::format("the run has no tick {}", *options.trace_tick), {},
                fmt::format("its last tick is {}", run.states.back().tick))}};
  }
  switch (options.trace_format) {
    case TraceFormat::Text:
      return {
          told(run, options.is_verbose ? Detail::EveryStep : Detail::Events),
          {}};
    case TraceFormat::Html:
      return {html_text(run), {}};
    case TraceFormat::Itf:
      return {itf_text(run), {}};
    case TraceFormat::Svg:
      return {svg_text(run, *at), {}};
    case TraceFormat::Strip:
      return {svg_strip(run), {}};
    case TraceFormat::Dot:
      return {dot_text(run, *at), {}};
    case TraceFormat::Mermaid:
      return {mermaid_text(run, *at), {}};
    case TraceFormat::Btlog:
      return {btlog_bytes(run), {}};
    case TraceFormat::Chrome:
      return {chrome_text(run, ChromeForm::Tracks), {}};
    case TraceFormat::ChromeStack:
      return {chrome_text(run, ChromeForm::Stack), {}};
    case TraceFormat::Mcap:
      return {mcap_bytes(run), {}};
    case TraceFormat::Substitution:
      return {substitution_text(run), {}};
  }
  return {};
}

bool is_log(const InputFile& file) {
  return file.text.starts_with(kBtlogMagic) || file.name.ends_with(".fbl") ||
         file.name.ends_with(".btlog");
}

Result<std::string> converted_log(const InputFile& file,
                                  const Options& options) {
  if (options.trace_format != TraceFormat::Text) {
    return {std::nullopt,
            {SourceText(file.name, {})
                 .diagnostic(Severity::Error, "BT1306", {},
                             "a log of BehaviorTree.CPP can be printed and "
                             "nothing else",
                             {}, "write --to text")}};
  }
  Result<BehaviorLog> read = read_log(file.name, file.text);
  Result<std::string> result{std::nullopt, std::move(read.diagnostics)};
  if (read.value) result.value = log_text(*read.value);
  return result;
}

}  // namespace

Result<std::string> converted(const InputFile& file, const Options& options) {
  if (is_log(file)) return converted_log(file, options);
  Result<RecordedRun> read = read_itf(file.name, file.text);
  if (!read.value) return {std::nullopt, std::move(read.diagnostics)};
  return written(file.name, *read.value, options);
}

}  // namespace btcheck
