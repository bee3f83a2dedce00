// SPDX-License-Identifier: MIT
//
// Verdicts first, each in one line that can be read alone; the run that
// explains it below. Words carry the meaning, never colour.
#include "report/text/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "trace/why/why.hpp"

namespace btcheck {
namespace {

std::string plural(std::uint64_t count, std::string_view word,
                   std::string_view words) {
  return fmt::format("{} {}", grouped(count), count == 1 ? word : words);
}

std::string time_text(int time, TickSemantics ticks) {
  const auto count = static_cast<std::uint64_t>(time);
  if (ticks == TickSemantics::Root) return plural(count, "tick", "ticks");
  return plural(count, "unit of time", "units of time");
}

// Lines of at most 80 columns, each after the indent.
std::string wrapped(std::string_view words, std::string_view indent) {
  constexpr std::size_t kWidth = 80;
  std::string text;
  std::string line(indent);
  while (!words.empty()) {
    const std::string_view word = words.substr(0, words.find(' '));
    words.remove_prefix(std::min(words.size(), word.size() + 1));
    if (line.size() > indent.size() && line.size() + 1 + word.size() > kWidth) {
      text += line + '\n';
      line = indent;
    }
    if (line.size() > indent.size()) line += ' ';
    line += word;
  }
  return text + line + '\n';
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

// How a property came to hold for another reason than its author had in mind.
std::string vacuity_text(const PropertyVerdict& verdict) {
  if (verdict.no_run) return "vacuously: no run satisfies the assumptions";
  if (!verdict.idle.empty()) {
    return fmt::format("vacuously: `{}` never happens", verdict.idle);
  }
  // What makes the property idle goes before what it merely does not need.
  for (const bool idle : {true, false}) {
    for (const VacuousPart& part : verdict.vacuous) {
      if (idle == (part.as_if_true || part.is_scope)) continue;
      return fmt::format("{}it would hold even if `{}` were {} so",
                         idle ? "vacuously: " : "", part.text,
                         part.as_if_true ? "always" : "never");
    }
  }
  return {};
}

// How often it was put to the test, and how long answers took.
std::string occurrence_text(const PropertyVerdict& verdict,
                            TickSemantics ticks) {
  const TimedClaim& timed = verdict.property->timed;
  const bool is_timed = verdict.property->form == PropertyForm::Timed;
  std::string text;
  if (verdict.triggers && (!is_timed || timed.trigger)) {
    text = fmt::format("asked in {}",
                       plural(*verdict.triggers, "state", "states"));
  }
  if (!is_timed || verdict.longest_answer < 0 || timed.to == kNoEnd) {
    return text;
  }
  return fmt::format("{}{}answered within {} of {}", text,
                     text.empty() ? "" : ", ", verdict.longest_answer,
                     time_text(timed.to, ticks));
}

bool waits_for_answer(const Property& property) {
  return property.timed.demand == Demand::Answer ||
         property.timed.demand == Demand::FirstAnswer;
}

// A finite run that shows a missing answer ends with the unit in which it
// would have had to come.
bool ends_too_late(const PropertyVerdict& verdict) {
  const Property& property = *verdict.property;
  return property.form == PropertyForm::Timed &&
         property.timed.demand == Demand::Answer && !property.timed.closing &&
         verdict.run->loop == kNoLoop;
}

std::string run_note(const PropertyVerdict& verdict, TickSemantics ticks) {
  std::string note =
      verdict.verdict == Verdict::Holds ? "witness after " : "after ";
  note += ticks_text(*verdict.run, ticks, ends_too_late(verdict));
  if (verdict.run->loop != kNoLoop) note += ", then for ever";
  return note;
}

void append(std::string& text, const std::string& more) {
  if (!text.empty() && !more.empty()) text += "; ";
  text += more;
}

// Nothing occurs on a run on which `present P lasting d` waits for P for ever.
bool has_occurrence(const PropertyVerdict& verdict) {
  const Property& property = *verdict.property;
  return property.form == PropertyForm::Timed &&
         !(property.timed.must_open && verdict.run->loop != kNoLoop);
}

// What a single state shows.
std::string state_words(const CheckedFile& file, const Property& property) {
  if (property.form == PropertyForm::DeadlockFree) {
    return "here nothing can happen any more";
  }
  if (property.form != PropertyForm::Never &&
      property.form != PropertyForm::Possible &&
      property.form != PropertyForm::Invariant) {
    return "here the rule is broken";
  }
  return fmt::format("here it is {}so: {}",
                     property.form == PropertyForm::Invariant ? "not " : "",
                     formula_text(*file.properties, property.formula));
}

// What the last state of a finite run shows.
std::string end_of_run(const CheckedFile& file,
                       const PropertyVerdict& verdict) {
  const Property& property = *verdict.property;
  if (!verdict.unshown.empty()) return verdict.unshown;
  if (verdict.run->loop != kNoLoop) {
    const bool is_missing =
        property.form == PropertyForm::Timed && !has_occurrence(verdict);
    return is_missing ? fmt::format("it never happens: {}",
                                    formula_text(*file.properties,
                                                 property.timed.answer))
                      : std::string();
  }
  switch (property.form) {
    case PropertyForm::Never:
    case PropertyForm::Possible:
    case PropertyForm::Invariant:
    case PropertyForm::DeadlockFree:
      return state_words(file, property);
    case PropertyForm::Timed:
      return ends_too_late(verdict) ? "the time for an answer is over"
                                    : "here the rule is broken";
    case PropertyForm::Ltl:
      return "here the rule is broken, whatever comes then";
    default:
      return {};
  }
}

// Up to the state that shows it, where there is one.
Run run_to_explain(const PropertyVerdict& verdict) {
  Run run = *verdict.run;
  if (!verdict.shown_at) return run;
  run.steps.resize(*verdict.shown_at);
  run.loop = kNoLoop;
  return run;
}

std::string verdict_text(const CheckResult& result, const CheckedFile& file,
                         const PropertyVerdict& verdict, Detail detail) {
  const Property& property = *verdict.property;
  const std::string note = note_of(file, verdict);
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
  return text + told_text(result, file, verdict, detail);
}

std::string sums_text(const CheckedFile& file) {
  std::size_t holds = 0, vacuous = 0, violated = 0, undecided = 0, missed = 0;
  bool has_expectations = false;
  for (const PropertyVerdict& verdict : file.verdicts) {
    holds += verdict.verdict == Verdict::Holds;
    vacuous += verdict.is_vacuous();
    violated += verdict.verdict == Verdict::Violated;
    undecided += verdict.verdict == Verdict::Undecided;
    missed += !verdict.met_expectation();
    has_expectations |= verdict.property->expectation != Expectation::None;
  }
  std::string text =
      fmt::format("\n{}: {} hold{}, {} violated, {} undecided",
                  plural(file.verdicts.size(), "property", "properties"), holds,
                  vacuous == 0 ? "" : fmt::format(" ({} vacuously)", vacuous),
                  violated, undecided);
  if (!has_expectations || (missed == 0 && undecided > 0)) return text + "\n";
  if (missed == 0) return text + "; all as expected\n";
  return text + fmt::format("; {} not as expected\n", missed);
}

}  // namespace

std::string with_open(std::string text, const std::string& open) {
  if (!open.empty()) text += ": " + open;
  return text;
}

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

std::string note_of(const CheckedFile& file, const PropertyVerdict& verdict) {
  const Property& property = *verdict.property;
  const TickSemantics ticks = file.network->ticks;
  if (verdict.verdict == Verdict::Undecided) {
    return with_open(stop_text(verdict.stopped, verdict.progress),
                     verdict.open);
  }
  std::string note;
  if (verdict.run) {
    note = run_note(verdict, ticks);
  } else if (verdict.verdict == Verdict::Holds) {
    note = vacuity_text(verdict);
    if (!verdict.is_vacuous()) append(note, occurrence_text(verdict, ticks));
  } else if (verdict.no_run) {
    note = "no run satisfies the assumptions";
  } else if (property.form == PropertyForm::Possible) {
    note = "no reachable state is so";
  } else if (property.form == PropertyForm::Branching) {
    note = "no run is so";
  }
  if (!file.assumptions.empty() && !verdict.no_run) {
    append(note, fmt::format("assuming {}", fmt::join(file.assumptions, ", ")));
  }
  if (property.expectation == Expectation::None) return note;
  const bool met = verdict.met_expectation();
  append(note, met ? "as expected"
                   : fmt::format("expected {}",
                                 property.expectation == Expectation::Holds
                                     ? "to hold"
                                     : "a violation"));
  return note;
}

RunRemarks remarks_on(const CheckResult& result, const CheckedFile& file,
                      const PropertyVerdict& verdict) {
  const Property& property = *verdict.property;
  RunRemarks remarks;
  if (has_occurrence(verdict)) remarks.state = verdict.trigger_state;
  if (verdict.verdict == Verdict::Violated) {
    remarks.reason = why(*result.tree, *file.network, run_to_explain(verdict),
                         verdict.subjects, remarks.state);
  }
  remarks.words = waits_for_answer(property) ? "asked here, not answered"
                                             : "it begins here";
  if (verdict.shown_at) {
    remarks.state = verdict.shown_at;
    remarks.words = state_words(file, property);
  }
  remarks.end = end_of_run(file, verdict);
  return remarks;
}

std::string told_text(const CheckResult& result, const CheckedFile& file,
                      const PropertyVerdict& verdict, Detail detail) {
  const RunRemarks remarks = remarks_on(result, file, verdict);
  TextStyle style;
  style.detail = detail;
  style.trigger_state = remarks.state;
  style.trigger_words = remarks.words;
  std::string text = fmt::format("           {}\n", verdict.property->text);
  if (!remarks.reason.empty()) {
    text += wrapped("why: " + remarks.reason, "           ");
  }
  text += '\n';
  text += run_text(*result.tree, *file.network, *verdict.run, style);
  if (!remarks.end.empty()) {
    text += fmt::format("{}-- {}\n", style.indent, remarks.end);
  }
  return text + '\n';
}

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
    case StopReason::Disk:
      return covered +
             ": the disk of --on-disk is full or fails; name another one";
    case StopReason::Timeout:
      return covered + ": the limit of --timeout; allow more";
    case StopReason::Interrupted:
      return covered + ": interrupted";
    case StopReason::FormulaTooLarge:
      return "its automaton is too large; split it into several properties";
    case StopReason::OpenEntries:
      return "what was found rests on values that are not known";
    case StopReason::None:
      break;
  }
  return covered;
}

std::string_view stop_word(StopReason reason) {
  switch (reason) {
    case StopReason::MaxStates:
      return "max-states";
    case StopReason::Memory:
      return "memory";
    case StopReason::Disk:
      return "disk";
    case StopReason::Timeout:
      return "timeout";
    case StopReason::Interrupted:
      return "interrupted";
    case StopReason::FormulaTooLarge:
      return "formula-too-large";
    case StopReason::OpenEntries:
      return "open-entries";
    case StopReason::None:
      break;
  }
  return "";
}

std::string heading_text(const CheckResult& result, const CheckedFile& file) {
  const BehaviorTree& tree = *result.tree;
  const std::string assumptions =
      file.assumptions.empty()
          ? "no assumptions"
          : fmt::format("assuming {}", fmt::join(file.assumptions, ", "));
  return fmt::format("{}: {}, {}; profile {}, tick {}, {}\n", tree.file,
                     plural(tree.nodes.size(), "node", "nodes"),
                     plural(tree.variables.size(), "variable", "variables"),
                     profile_name(tree.profile), tick_name(file.network->ticks),
                     assumptions);
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
        "\nSome runs end in a fault: an assignment out of range, a division by "
        "zero, or an\nexception. What would have followed is not judged. "
        "Without --prop, btcheck shows\none.\n";
  }
  if (!file.open_fault.empty()) {
    text +=
        fmt::format("\nWhether some run ends in a fault is not known: {}.\n",
                    file.open_fault);
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
