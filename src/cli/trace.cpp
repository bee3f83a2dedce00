// SPDX-License-Identifier: MIT
//
// `btcheck trace FILE --to FORMAT`: converts a run that was written before. An
// ITF file of btcheck becomes any format, and so does a trace of LTSmin, when
// it has been executed again; a log of BehaviorTree.CPP or Nav2 becomes text,
// with the marks of btcheck::observer any format, or is shown while it is
// written.
#include "cli/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "check/check.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/recordings.hpp"
#include "cli/view.hpp"
#include "pins/model.hpp"
#include "pins/trace.hpp"
#include "text/budget.hpp"
#include "text/diagnostic.hpp"
#include "trace/formats/recordings.hpp"
#include "trace/formats/text.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/logs/log_run.hpp"
#include "trace/logs/marks.hpp"
#include "trace/pictures/pictures.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/record.hpp"
#include "trace/run/recorded_run.hpp"
#include "trace/viewer/html.hpp"

namespace btcheck {
namespace {

// The verdict, the property, the reason and the run, as `check` prints them.
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

// The run in that format; `state` is drawn where the format draws one.
std::string text_in(TraceFormat format, const RecordedRun& run,
                    std::size_t state, Detail detail) {
  switch (format) {
    case TraceFormat::Text:
      return told(run, detail);
    case TraceFormat::Html:
      return html_text(run);
    case TraceFormat::Itf:
      return itf_text(run);
    case TraceFormat::Svg:
      return svg_text(run, state);
    case TraceFormat::Strip:
      return svg_strip(run);
    case TraceFormat::Dot:
      return dot_text(run, state);
    case TraceFormat::Mermaid:
      return mermaid_text(run, state);
    case TraceFormat::Btlog:
      return btlog_bytes(run);
    case TraceFormat::Chrome:
      return chrome_text(run, ChromeForm::Tracks);
    case TraceFormat::ChromeStack:
      return chrome_text(run, ChromeForm::Stack);
    case TraceFormat::Mcap:
      return mcap_bytes(run);
    case TraceFormat::Substitution:
      return substitution_text(run);
  }
  return {};
}

Result<std::string> written(const std::string& file, const RecordedRun& run,
                            const Options& options) {
  const auto at = state_at(run, options.trace.tick);
  if (!at) {
    return {std::nullopt,
            {file_error(
                "BT1305", file,
                fmt::format("the run has no tick {}", *options.trace.tick),
                fmt::format("its last tick is {}", run.states.back().tick))}};
  }
  const Detail detail = options.is_verbose ? Detail::EveryStep : Detail::Events;
  return {text_in(options.trace.format, run, *at, detail), {}};
}

// All states of a log whose ticks and answers are known; nothing where they are
// too many for one run.
std::optional<RecordedRun> run_of_log(const std::string& file,
                                      const BehaviorLog& log,
                                      const LogReading& reading) {
  constexpr std::size_t kMostCells = std::size_t{1}
                                     << 22;  // states times nodes
  LogPlayer player(log, reading);
  RecordedRun run = titled(player.heading(), file, log);
  bool is_small = true;
  player.play([&] {
    ask_budget();
    run.states.push_back(player.state());
    is_small = run.states.size() * run.nodes.size() <= kMostCells;
    return is_small;
  });
  return is_small ? std::optional(std::move(run)) : std::nullopt;
}

Result<std::string> converted_log(const InputFile& file,
                                  const Options& options) {
  Result<BehaviorLog> read = read_whole_log(
      options, file.name, file.text, {.max_bytes = memory_limit(options)});
  Result<std::string> result{std::nullopt, std::move(read.diagnostics)};
  if (!read.value) return result;
  const BehaviorLog& log = *read.value;
  if (options.trace.format == TraceFormat::Text) {
    result.value = log_text(log, reading_of(options));
    return result;
  }
  if (!log.marks) {
    result.diagnostics.push_back(file_error(
        "BT1306", file.name,
        "a log of changes of status can be printed and nothing else: its ticks "
        "are not known",
        "write --to text; what btcheck::observer logs becomes any format "
        "(docs/robots.md)"));
    return result;
  }
  const auto run = run_of_log(file.name, log, reading_of(options));
  if (!run) {
    result.diagnostics.push_back(
        file_error("BT1306", file.name, "the log is too long for one run",
                   "write --to text, or log in smaller files: log_bytes of "
                   "btcheck::ObserverOptions"));
    return result;
  }
  Result<std::string> told = written(file.name, *run, options);
  std::ranges::move(told.diagnostics, std::back_inserter(result.diagnostics));
  result.value = std::move(told.value);
  return result;
}

Result<std::string> converted(const InputFile& file, const Options& options) {
  if (is_log(file.name, file.text)) return converted_log(file, options);
  Result<RecordedRun> read = read_itf(file.name, file.text);
  if (!read.value) return {std::nullopt, std::move(read.diagnostics)};
  return written(file.name, *read.value, options);
}

// No format has a way of its own to write control characters.
bool is_for_people(TraceFormat format) {
  return format == TraceFormat::Text || format == TraceFormat::Dot ||
         format == TraceFormat::Mermaid;
}

ExitCode write_result(const Options& options, Result<std::string> result) {
  show(options, result.diagnostics);
  if (!result.value) return ExitCode::BadInput;
  if (is_for_people(options.trace.format)) {
    result.value = readable(*result.value);
  }
  return write_output(options.output, *result.value);
}

// A trace of LTSmin, executed again and told.
ExitCode run_ltsmin_trace(const Options& options) {
  const std::string& name = options.input;
  if (name.ends_with(".gcf") || name.ends_with(".dir")) {
    show(options,
         {file_error(
             "BT1309", name, "an archive of LTSmin is not read",
             fmt::format("print it: ltsmin-printtrace {} RUN.csv", name))});
    return ExitCode::BadInput;
  }
  const auto model = load_model(options.trace.tree, words_of_environment());
  if (!model) return ExitCode::BadInput;
  const auto file = read_file(name);
  show(options, file.diagnostics);
  if (!file.value) return ExitCode::BadInput;
  const auto trace = read_trace(name, file.value->text, *model);
  show(options, trace.diagnostics);
  if (!trace.value) {
    return trace.diagnostics[0].code == "BT1310" ? ExitCode::Internal
                                                 : ExitCode::BadInput;
  }
  std::string error;
  const auto run = replayed(*model, *trace.value, error);
  if (!run) {
    show(options, {file_error("BT1310", name,
                              "the trace does not replay: " + error, "")});
    return ExitCode::Internal;
  }
  RunHeading heading;
  heading.property = name;
  heading.formula = name;
  heading.verdict = "REPLAYED";
  add_sources(heading, model->tree(), model->input());
  return write_result(
      options,
      written(name, recorded(model->tree(), model->network(), *run, heading),
              options));
}

}  // namespace

ExitCode run_trace(const Options& options) {
  if (!options.trace.tree.empty()) return run_ltsmin_trace(options);
  const auto file = read_file(options.input);
  show(options, file.diagnostics);
  if (!file.value) return ExitCode::BadInput;
  if (options.view) return view_log(options, *file.value);
  if (!options.properties.empty() || !options.rules.empty()) {
    return watch_recorded(options, *file.value);
  }
  return write_result(options, converted(*file.value, options));
}

}  // namespace btcheck
