// SPDX-License-Identifier: MIT
//
// Each verdict is one line that can be read alone; words carry the meaning,
// never colour.
#include "report/text/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "check/bind/bound_property.hpp"
#include "model/tree/granted.hpp"
#include "model/tree/node_types.hpp"
#include "report/text/conditions.hpp"
#include "text/choice.hpp"
#include "text/findings.hpp"
#include "text/utf8.hpp"
#include "trace/why/why.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kIndent = 11;  // of what is told below a verdict

std::string plural(std::uint64_t count, std::string_view word,
                   std::string_view words) {
  return fmt::format("{} {}", grouped(count), count == 1 ? word : words);
}

std::string time_text(int time, TickSemantics ticks) {
  const auto count = static_cast<std::uint64_t>(time);
  if (ticks == TickSemantics::Root) return plural(count, "tick", "ticks");
  return plural(count, "unit of time", "units of time");
}

// What the row has for the verdict, being by verdict; null where it ends
// before.
template <class Each>
const Each* found_for(const CheckedFile& file, const PropertyVerdict& verdict,
                      const std::vector<Each>& row) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (&file.verdicts[i] == &verdict) return &row[i];
  }
  return nullptr;
}

// The advice for the verdict, if there is any.
const TickAdvice* advice_for(const CheckedFile& file,
                             const PropertyVerdict& verdict) {
  const auto* const advice = found_for(file, verdict, file.advice);
  return advice != nullptr && *advice ? &**advice : nullptr;
}

// "for every num_attempts >= 2 of RetryUntilSuccessful, line 12"; with every
// detail also where nothing is known, and why.
std::string counts_text(const CheckResult& result, const CheckedFile& file,
                        const PropertyVerdict& verdict, Layout layout) {
  const bool tells_all = layout.detail == Detail::EveryStep;
  if (file.counts.empty()) return {};
  const CountClaims claims = claims_of(file, verdict);
  std::string text;
  const auto tell = [&](const std::string& line) {
    text += fmt::format("{:{}}{}\n", "", kIndent,
                        wrapped(line, kIndent, layout.width));
  };
  for (const CountClaim& claim : claims) {
    const std::string node =
        fmt::format("{}, {}", typed_name(result.tree->node(claim.node)),
                    line_of(*result.tree, claim.node));
    if (claim.from) {
      tell(fmt::format("for every {} >= {} of {}", claim.attribute, *claim.from,
                       node));
    } else if (tells_all) {
      tell(fmt::format("other {} of {}: not known, {}", claim.attribute, node,
                       claim.open));
    }
  }
  if (claims.empty() && tells_all) {
    tell("no node counts up to a number that is written in the tree");
  }
  return text;
}

// Why a property holds for another reason than its author had in mind.
std::string vacuity_text(const CheckedFile& file,
                         const PropertyVerdict& verdict) {
  if (advice_for(file, verdict) != nullptr) {
    return "vacuously: these never hold in the same instant";
  }
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

// A finite run that shows a missing answer ends with the unit in which it
// would have had to come.
bool ends_too_late(const PropertyVerdict& verdict) {
  const Property& property = *verdict.property;
  return property.form == PropertyForm::Timed &&
         property.timed.demand == Demand::Answer && !property.timed.closing &&
         verdict.run->loop == kNoLoop;
}

std::string run_note(const PropertyVerdict& verdict, TickSemantics ticks) {
  const Run& run = *verdict.run;
  // The unit in which a late answer would have had to come is one too many.
  int elapsed = ends_too_late(verdict) ? -1 : 0;
  const std::size_t end = std::min(run.loop, run.steps.size());
  for (std::size_t i = 0; i < end; ++i) elapsed += run.steps[i].step.elapsed;
  return fmt::format(
      "{}after {}{}", verdict.verdict == Verdict::Holds ? "witness " : "",
      time_text(elapsed, ticks), run.loop == kNoLoop ? "" : ", then for ever");
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
  if (!asks_of_states(property.form)) return "here the rule is broken";
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
    if (property.form != PropertyForm::Timed || has_occurrence(verdict)) {
      return {};
    }
    return fmt::format("it never happens: {}",
                       formula_text(*file.properties, property.timed.answer));
  }
  if (ends_too_late(verdict)) return "the time for an answer is over";
  if (property.form == PropertyForm::Ltl) {
    return "here the rule is broken, whatever comes then";
  }
  if (property.form == PropertyForm::Branching) return {};
  return state_words(file, property);
}

// "; battery == 12": the variables that the rule names, as they are in a state
// of the run, but for what the rule says itself.
std::string values_text(const CheckResult& result, const CheckedFile& file,
                        const PropertyVerdict& verdict, std::size_t state) {
  std::string text;
  for (const StateVariableId id : verdict.subjects.variables) {
    const StateVariable& variable = result.tree->variable(id);
    const VariableId here = file.network->state_variable[index(id)];
    const std::string value =
        variable.value_name(verdict.run->state(state).variables[index(here)]);
    const auto says_it = [&](const WatchedPart& part) {
      if (!part.at[state]) return false;
      for (const std::string_view form :
           {"{} = {}", "{} == {}", "{} == \"{}\""}) {
        const std::string said =
            fmt::format(fmt::runtime(form), variable.name, value);
        if (part.text == said) return true;
      }
      return false;
    };
    if (std::ranges::any_of(verdict.watched, says_it)) continue;
    text += fmt::format("{} {} == {}", text.empty() ? ";" : ",", variable.name,
                        value);
  }
  return text;
}

// "; `land.running` is so, `height > 3` is not": the atoms of a rule of
// several, where some are so and others are not.
std::string parts_text(const PropertyVerdict& verdict, std::size_t state) {
  if (!asks_of_states(verdict.property->form)) return {};
  std::vector<std::string> so, not_so;
  for (const WatchedPart& part : verdict.watched) {
    if (&part == &verdict.watched.front()) continue;  // the rule itself
    (part.at[state] ? so : not_so).push_back("`" + part.text + "`");
  }
  if (not_so.empty() || so.size() + not_so.size() < 2) return {};
  const auto listed = [](std::vector<std::string>& parts) {
    constexpr std::size_t kMost = 3;
    if (parts.size() > kMost) {
      const std::size_t more = parts.size() - kMost + 1;
      parts.resize(kMost);
      parts.back() = fmt::format("{} others", more);
    }
    return enumerated(parts) + (parts.size() == 1 ? " is" : " are");
  };
  if (so.empty()) return fmt::format("; {} not so", listed(not_so));
  return fmt::format("; {} so, {} not", listed(so), listed(not_so));
}

std::string verdict_text(const CheckResult& result, const CheckedFile& file,
                         const PropertyVerdict& verdict, Layout layout) {
  const Property& property = *verdict.property;
  const std::string note = note_with_conditions(result, file, verdict);
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
  const std::string advice = advice_text(file, verdict);
  if (!advice.empty()) {
    text += fmt::format("{:{}}{}\n", "", kIndent,
                        wrapped(advice, kIndent, layout.width));
  }
  text += counts_text(result, file, verdict, layout);
  const bool is_news = !verdict.met_expectation();
  if (!verdict.run || (!is_news && layout.detail == Detail::Events))
    return text;
  return text + told_text(result, file, verdict, layout);
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

// How a search can end early: the word for programs, the words for people.
struct StopWords {
  std::string_view word;
  std::string_view text;  // with a brace pair for each limit that is named
  Choice limit = Choice::MaxStates;
  Choice other = Choice::MaxStates;
};
// In the order of StopReason. A text that begins with a colon follows "after
// 12 states".
constexpr std::array<StopWords, 8> kStops = {{
    {"", ""},
    {"max-states", ": the limit of {}; allow more"},
    {"memory", ": the limit of {}; allow more, or {}", Choice::Memory},
    {"timeout", ": the limit of {}; allow more", Choice::Timeout},
    {"interrupted", ": interrupted"},
    {"disk", ": the disk of {} is full or fails; name another one",
     Choice::Disk},
    {"formula-too-large",
     "its automaton is too large; split it into several properties"},
    {"open-entries", "what was found rests on values that are not known"},
}};

}  // namespace

std::string_view verdict_word(Verdict verdict) {
  constexpr std::array<std::string_view, 3> kWords = {"HOLDS", "VIOLATED",
                                                      "UNDECIDED"};
  return kWords[static_cast<std::size_t>(verdict)];
}

CountClaims claims_of(const CheckedFile& file, const PropertyVerdict& verdict) {
  const CountClaims* const claims = found_for(file, verdict, file.counts);
  return claims == nullptr ? CountClaims{} : *claims;
}

std::string advice_text(const CheckedFile& file,
                        const PropertyVerdict& verdict) {
  const TickAdvice* const advice = advice_for(file, verdict);
  if (advice == nullptr) return {};
  return fmt::format(
      "did you mean: {}{}", advice->rule,
      advice->verdict == Verdict::Undecided
          ? ""
          : fmt::format(" (which {})", advice->verdict == Verdict::Holds
                                           ? "holds"
                                           : "is violated"));
}

std::string note_of(const CheckedFile& file, const PropertyVerdict& verdict) {
  const Property& property = *verdict.property;
  const TickSemantics ticks = file.network->ticks;
  if (verdict.verdict == Verdict::Undecided) {
    return stop_text(verdict.stopped, verdict.progress, verdict.open);
  }
  std::string note;
  if (verdict.run) {
    note = run_note(verdict, ticks);
  } else if (verdict.verdict == Verdict::Holds) {
    note = vacuity_text(file, verdict);
    if (!verdict.is_vacuous()) append(note, occurrence_text(verdict, ticks));
  } else if (verdict.no_run) {
    note = "no run satisfies the assumptions";
  } else if (property.form == PropertyForm::Possible) {
    note = "no reachable state is so";
  } else if (property.form == PropertyForm::Branching) {
    note = "no run is so";
  }
  if (!file.assumptions().empty() && !verdict.no_run) {
    append(note,
           fmt::format("assuming {}", fmt::join(file.assumptions(), ", ")));
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

std::vector<std::string> conditions_of(const CheckResult& result,
                                       const CheckedFile& file) {
  std::vector<std::string> all = file.assumptions();
  std::ranges::move(granted(*result.tree), std::back_inserter(all));
  return all;
}

std::string note_with_conditions(const CheckResult& result,
                                 const CheckedFile& file,
                                 const PropertyVerdict& verdict) {
  std::string note = note_of(file, verdict);
  const std::vector<std::string> needed = granted(*result.tree);
  if (verdict.verdict == Verdict::Holds && !needed.empty()) {
    append(note, fmt::format("assuming {}", fmt::join(needed, ", ")));
  }
  return note;
}

BrokenRule rule_of(const CheckedFile& file, const PropertyVerdict& verdict) {
  const auto& assumptions = file.properties->assumptions;
  const bool is_finite = verdict.run->loop == kNoLoop;
  const bool has_formula =
      std::ranges::any_of(assumptions, [](const Assumption& assumption) {
        return assumption.kind == Assumption::Kind::Formula;
      });
  if (has_formula && !is_finite) return {};
  const auto& rules = file.bound.properties;
  const auto found =
      std::ranges::find(rules, verdict.property, &BoundProperty::property);
  if (found == rules.end()) return {};
  return {&*found, !file.assumptions().empty()};
}

RunHeading heading_of(const CheckResult& result, const CheckedFile& file,
                      const PropertyVerdict& verdict) {
  const Property& property = *verdict.property;
  const Demand demand = property.timed.demand;
  RunHeading heading{{property.name, property.text,
                      std::string(verdict_word(verdict.verdict))}};
  heading.watched = verdict.watched;
  if (has_occurrence(verdict)) heading.trigger = verdict.trigger_state;
  if (verdict.verdict == Verdict::Violated) {
    heading.why =
        why(*result.tree, *file.network, *verdict.run, verdict.subjects,
            heading.trigger, rule_of(file, verdict));
  }
  heading.trigger_words =
      demand == Demand::Answer || demand == Demand::FirstAnswer
          ? "asked here, not answered"
          : "it begins here";
  heading.end_words = end_of_run(file, verdict);
  if (verdict.run->loop == kNoLoop) {
    heading.lost = verdict.run->steps.size();
    if (!heading.end_words.empty()) {
      heading.end_words += parts_text(verdict, *heading.lost) +
                           values_text(result, file, verdict, *heading.lost);
    }
  }
  return heading;
}

std::string told_text(const CheckResult& result, const CheckedFile& file,
                      const PropertyVerdict& verdict, Layout layout) {
  const std::string indent(kIndent, ' ');
  const RunHeading heading = heading_of(result, file, verdict);
  TextStyle style(layout);
  style.trigger_state = heading.trigger;
  style.trigger_words = heading.trigger_words;
  std::string text = indent + heading.formula + '\n';
  if (!heading.why.empty()) {
    text +=
        indent + wrapped("why: " + heading.why, kIndent, layout.width) + '\n';
  }
  text += '\n';
  text += run_text(*result.tree, *file.network, *verdict.run, style);
  if (!heading.end_words.empty()) {
    text += fmt::format("{}-- {}\n", style.indent, heading.end_words);
  }
  return text + '\n';
}

std::string typed_name(const Node& node) {
  const std::string_view type = type_name(node.type);
  return node.name.starts_with(type) ? node.name
                                     : fmt::format("{} {}", type, node.name);
}

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3) {
    digits.insert(at - 3, ",");
  }
  return digits;
}

std::string counted(std::uint64_t count, std::string_view one,
                    std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string stop_text(StopReason reason, const SearchProgress& progress,
                      const std::string& open) {
  const StopWords& words = kStops[static_cast<std::size_t>(reason)];
  std::string text = fmt::format(fmt::runtime(words.text), word(words.limit),
                                 word(words.other));
  if (text.empty() || text.starts_with(':')) {
    text.insert(0, fmt::format("after {} states", grouped(progress.states)));
  }
  return open.empty() ? text : text + ": " + open;
}

std::string_view stop_word(StopReason reason) {
  return kStops[static_cast<std::size_t>(reason)].word;
}

std::string heading_text(const CheckResult& result, const CheckedFile& file) {
  const BehaviorTree& tree = *result.tree;
  const std::vector<std::string> conditions = conditions_of(result, file);
  const std::string assumptions =
      conditions.empty()
          ? "no assumptions"
          : fmt::format("assuming {}", fmt::join(conditions, ", "));
  return fmt::format("{}: {}, {}; profile {}, tick {}, {}{}\n", tree.file,
                     plural(tree.nodes.size(), "node", "nodes"),
                     plural(tree.variables.size(), "variable", "variables"),
                     profile_name(tree.profile), tick_name(file.network->ticks),
                     assumptions,
                     result.start_text.empty() ? "" : ", " + result.start_text);
}

std::string verdicts_text(const CheckResult& result, const CheckedFile& file,
                          Layout layout) {
  std::string text;
  for (const PropertyVerdict& verdict : file.verdicts) {
    text += verdict_text(result, file, verdict, layout);
  }
  if (text.ends_with("\n\n")) text.pop_back();
  text += sums_text(file);
  if (file.fault_level) {
    text +=
        "\nSome runs end in a fault: an assignment out of range, a division by "
        "zero, or an\nexception. What would have followed is not judged. "
        "Without rules, btcheck shows\none.\n";
    if (file.fault_level == Severity::Error) {
      text += fmt::format("error[{}]: that is denied\n",
                          code_of(TreeQuestion::InRange));
    }
  }
  if (!file.open_fault.empty()) {
    text +=
        fmt::format("\nWhether some run ends in a fault is not known: {}.\n",
                    file.open_fault);
  }
  return text;
}

JudgedCount count_of(const Judged& judged) {
  JudgedCount count{judged.allowed, 0};
  for (const KnownFinding& each : judged.known) count.known += each.count;
  return count;
}

std::string judged_text(const JudgedCount& count) {
  std::string text;
  if (count.allowed > 0) text += fmt::format(", {} allowed", count.allowed);
  if (count.known > 0) text += fmt::format(", {} in the baseline", count.known);
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
  for (const TreeFinding& finding : file.findings) {
    if (finding.severity == Severity::Error) worsen(ExitCode::Missed);
  }
  if (file.fault_level == Severity::Error) worsen(ExitCode::Missed);
  if (!file.defaults) return code;
  if (!file.defaults->error.empty()) worsen(ExitCode::Internal);
  for (const TreeReport& report : file.defaults->tree) {
    if (is_fault(report)) worsen(ExitCode::Missed);
  }
  if (file.defaults->stopped != StopReason::None) worsen(ExitCode::Undecided);
  return code;
}

ExitCode exit_code_of(const CheckResult& result) {
  if (result.files.empty()) return ExitCode::BadInput;
  ExitCode code = result.judged.is_denied ? ExitCode::Missed : ExitCode::Met;
  for (const CheckedFile& file : result.files) {
    code = worst_of(code, exit_code_of(file));
  }
  return code;
}

StopReason stopped_by(const CheckedFile& file) {
  if (file.defaults) return file.defaults->stopped;
  StopReason reason = StopReason::None;
  for (const PropertyVerdict& verdict : file.verdicts) {
    if (verdict.stopped != StopReason::None) reason = verdict.stopped;
  }
  return reason;
}

ExitCode lint_code_of(const CheckResult& result) {
  if (result.is_broken) return ExitCode::BadInput;
  return std::ranges::any_of(result.diagnostics,
                             [](const Diagnostic& found) {
                               return found.severity != Severity::Note;
                             })
             ? ExitCode::Missed
             : ExitCode::Met;
}

ExitCode worst_of(ExitCode one, ExitCode other) {
  for (const ExitCode code : {ExitCode::Internal, ExitCode::BadInput,
                              ExitCode::Missed, ExitCode::Undecided}) {
    if (one == code || other == code) return code;
  }
  return ExitCode::Met;
}

}  // namespace btcheck
