// SPDX-License-Identifier: MIT
//
// Verdicts first, each in one line that can be read alone; the run that
// explains it below. Words carry the meaning, never colour.
#include "cli/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace btcheck {
namespace {

std::string_view verdict_word(Verdict verdict) {
  switch (verdict) {
    case Verdict::Holds:
      return "HOLDS";
    case Verdict::Violated:
      return "VIOLATED";
    case Verdict::Undecided:
      return "UNDECIDED";
  }
  return "";
}

std::string plural(std::uint64_t count, std::string_view word,
                   std::string_view words) {
  return fmt::format("{} {}", grouped(count), count == 1 ? word : words);
}

std::string time_text(int time, TickSemantics ticks) {
  const auto count = static_cast<std::uint64_t>(time);
  if (ticks == TickSemantics::Root) return plural(count, "tick", "ticks");
  return plural(count, "unit of time", "units of time");
}

// How much time a run takes. One that shows a late answer ends with the unit
// in which it would have had to come, and that is one too many.
std::string ticks_text(const Run& run, TickSemantics ticks, bool is_late) {
  int elapsed = 0;
  const std::size_t end = run.loop == kNoLoop ? run.steps.size() : run.loop;
  for (std::size_t i = 0; i < end; ++i) elapsed += run.steps[i].step.elapsed;
  elapsed -= is_late ? 1 : 0;
  return time_text(elapsed, ticks);
}

// What stands after the name: how a verdict came about.
std::string note_of(const PropertyVerdict& verdict, TickSemantics ticks) {
  const Property& property = *verdict.property;
  std::string note;
  if (verdict.verdict == Verdict::Undecided) {
    return stop_text(verdict.stopped, verdict.progress);
  }
  if (verdict.run) {
    note =
        property.form == PropertyForm::Possible ? "witness after " : "after ";
    const bool is_late =
        property.form == PropertyForm::Response && verdict.run->loop == kNoLoop;
    note += ticks_text(*verdict.run, ticks, is_late);
    if (verdict.run->loop != kNoLoop) note += ", then for ever";
  } else if (property.form == PropertyForm::Response) {
    note = verdict.longest_answer < 0
               ? "its trigger never happens"
               : fmt::format("answered within {} of {}", verdict.longest_answer,
                             time_text(property.to, ticks));
  }
  if (property.form == PropertyForm::Possible &&
      verdict.verdict == Verdict::Violated) {
    note = "no reachable state is so";
  }
  if (property.expectation == Expectation::None) return note;
  const bool met = verdict.met_expectation();
  const std::string_view expected =
      property.expectation == Expectation::Holds ? "to hold" : "a violation";
  if (!note.empty()) note += "; ";
  return note + (met ? "as expected" : fmt::format("expected {}", expected));
}

std::string verdict_text(const CheckResult& result, const CheckedFile& file,
                         const PropertyVerdict& verdict, Detail detail) {
  const Property& property = *verdict.property;
  const std::string note = note_of(verdict, file.network->ticks);
  std::string text =
      fmt::format("{:<9}  {}", verdict_word(verdict.verdict), property.name);
  if (!note.empty()) text += fmt::format("  ({})", note);
  text += '\n';
  if (!property.title.empty()) {
    text += fmt::format("           {}\n", property.title);
  }
  if (!verdict.error.empty()) {
    return text + fmt::format("           internal error: {}\n", verdict.error);
  }
  const bool is_news =
      !verdict.met_expectation() || (verdict.verdict == Verdict::Violated &&
                                     property.expectation == Expectation::None);
  if (!verdict.run || (!is_news && detail == Detail::Events)) return text;
  TextStyle style;
  style.detail = detail;
  if (property.form == PropertyForm::Response) {
    style.trigger_state = verdict.trigger_state;
  }
  text += fmt::format("           {}\n\n", property.text);
  text += run_text(*result.tree, *file.network, *verdict.run, style);
  if (verdict.run->loop == kNoLoop && style.trigger_state) {
    text += style.indent + "-- the time for an answer is over\n";
  }
  return text + '\n';
}

std::string sums_text(const CheckedFile& file) {
  std::size_t holds = 0, violated = 0, undecided = 0, missed = 0;
  bool has_expectations = false;
  for (const PropertyVerdict& verdict : file.verdicts) {
    holds += verdict.verdict == Verdict::Holds;
    violated += verdict.verdict == Verdict::Violated;
    undecided += verdict.verdict == Verdict::Undecided;
    missed += !verdict.met_expectation();
    has_expectations |= verdict.property->expectation != Expectation::None;
  }
  std::string text =
      fmt::format("\n{}: {} hold, {} violated, {} undecided",
                  plural(file.verdicts.size(), "property", "properties"), holds,
                  violated, undecided);
  if (!has_expectations || (missed == 0 && undecided > 0)) return text + "\n";
  if (missed == 0) return text + "; all as expected\n";
  return text + fmt::format("; {} not as expected\n", missed);
}

}  // namespace

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3) {
    digits.insert(at - 3, ",");
  }
  return digits;
}

std::string stop_text(StopReason reason, const SearchProgress& progress) {
  const std::string covered =
      fmt::format("after {} states", grouped(progress.states));
  switch (reason) {
    case StopReason::MaxStates:
      return covered + ": the limit of --max-states; allow more";
    case StopReason::Memory:
      return covered + ": the limit of --memory; allow more, or --max-states";
    case StopReason::Timeout:
      return covered + ": the limit of --timeout; allow more";
    case StopReason::Interrupted:
      return covered + ": interrupted";
    case StopReason::FormulaTooLarge:
      return "its automaton is too large; split it into several properties";
    case StopReason::None:
      break;
  }
  return covered;
}

std::string heading_text(const CheckResult& result, const CheckedFile& file) {
  const BehaviorTree& tree = *result.tree;
  return fmt::format("{}: {}, {}; profile paper, tick {}, no assumptions\n",
                     tree.file, plural(tree.nodes.size(), "node", "nodes"),
                     plural(tree.variables.size(), "variable", "variables"),
                     tick_name(file.network->ticks));
}

std::string verdicts_text(const CheckResult& result, const CheckedFile& file,
                          Detail detail) {
  std::string text;
  for (const PropertyVerdict& verdict : file.verdicts) {
    text += verdict_text(result, file, verdict, detail);
  }
  if (text.ends_with("\n\n")) text.pop_back();
  text += sums_text(file);
  if (file.has_faults) {
    text +=
        "\nSome runs end in a fault: a division by zero, or an assignment out "
        "of range.\nWhat would have followed is not judged. Without --prop, "
        "btcheck shows one.\n";
  }
  return text;
}

ExitCode exit_code_of(const CheckedFile& file) {
  ExitCode code = ExitCode::Met;
  auto worsen = [&](ExitCode other) { code = worst_of(code, other); };
  for (const PropertyVerdict& verdict : file.verdicts) {
    if (!verdict.error.empty()) worsen(ExitCode::Internal);
    if (verdict.verdict == Verdict::Undecided) worsen(ExitCode::Undecided);
    if (!verdict.met_expectation()) worsen(ExitCode::Missed);
  }
  if (!file.defaults) return code;
  if (!file.defaults->error.empty()) worsen(ExitCode::Internal);
  for (const TreeReport& report : file.defaults->tree) {
    if (is_fault(report)) worsen(ExitCode::Missed);
  }
  if (file.defaults->stopped != StopReason::None) worsen(ExitCode::Undecided);
  return code;
}

ExitCode worst_of(ExitCode one, ExitCode other) {
  constexpr std::array<ExitCode, 5> kWorstFirst = {
      ExitCode::Internal, ExitCode::BadInput, ExitCode::Missed,
      ExitCode::Undecided, ExitCode::Met};
  for (const ExitCode code : kWorstFirst) {
    if (one == code || other == code) return code;
  }
  return ExitCode::Met;
}

}  // namespace btcheck
