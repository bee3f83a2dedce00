// SPDX-License-Identifier: MIT
//
// A log is gone through once for the verdicts and, for each rule that it
// breaks, once more for the states that are shown: all of a long log would not
// fit into memory.
#include "trace/watch/watched_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <utility>

#include "text/choice.hpp"
#include "trace/watch/log_watch.hpp"
#include "trace/watch/recorded_watch.hpp"

namespace btcheck {
namespace {

// What happened last is told, up to the moment.
constexpr std::size_t kMostTold = 12;

std::string at_tick(const RecordedState& state) {
  return fmt::format("tick {:<4} {}", state.tick, state.event);
}

std::string counted(std::size_t count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

WatchedRule described(const RecordedWatch::Seen& seen) {
  WatchedRule watched = watched_rule(*seen.rule, seen.run.outlook());
  watched.has_unknown = seen.has_unknown;
  return watched;
}

// The end of a run that breaks a rule, made ready to be shown.
RecordedRun shown_run(RecordedRun heading, std::deque<RecordedState> states,
                      const WatchedRule& rule, std::vector<std::string> atoms) {
  RecordedRun run = std::move(heading);
  run.property = rule.name;
  run.formula = rule.text;
  run.verdict = "VIOLATED";
  run.atoms = std::move(atoms);
  run.states.assign(std::make_move_iterator(states.begin()),
                    std::make_move_iterator(states.end()));
  run.lost = run.states.size() - 1;
  run.trigger = kNoState;
  run.trigger_words.clear();
  run.loop = kNoState;
  run.end_words = "violated here, whatever comes then";
  return run;
}

// The states up to the one that decides a rule.
class Window {
 public:
  Window(const RecordedWatch& watch, std::size_t rule)
      : watch_(watch), rule_(rule) {}

  void add(const RecordedState& state) {
    states_.push_back(state);
    states_.back().atoms = watch_.truths(rule_);
    if (states_.size() > kMostShown) states_.pop_front();
  }
  std::deque<RecordedState> take() { return std::move(states_); }

 private:
  const RecordedWatch& watch_;
  std::size_t rule_;
  std::deque<RecordedState> states_;
};

// Shows a watch the states of a run, one after another, until show() is false.
using Show = std::function<bool(const RecordedState&)>;
using Play = std::function<void(RecordedWatch&, const Show&)>;

// Of a rule that has been decided in that state.
RecordedRun run_up_to(const RecordedRun& heading, const PropertyFile& rules,
                      const SourceText& source, std::size_t rule,
                      std::size_t decided, const WatchedRule& told,
                      const Play& play) {
  auto again = RecordedWatch::make(heading, Recording::Run, rules, source);
  RecordedWatch& watch = **again.value;
  Window window(watch, rule);
  play(watch, [&](const RecordedState& state) {
    window.add(state);
    return watch.states() <= decided;
  });
  RecordedRun alone = heading;
  alone.states.clear();
  return shown_run(std::move(alone), window.take(), told, watch.texts(rule));
}

// Of a log: up to where a rule has been decided, or, where ticks are only
// likely, to the record with which it was.
RecordedRun run_of_log(const RecordedRun& names, const BehaviorLog& log,
                       const LogReading& reading, const PropertyFile& rules,
                       const SourceText& source, std::size_t rule,
                       const LogWatch& watched, WatchedRule& told) {
  const bool is_known = watched.knows_ticks();
  auto made = LogWatch::make(names, log, reading, rules, source,
                             is_known ? TickWays::All : TickWays::Likely);
  LogWatch& again = **made.value;
  Window window(again.watch(), rule);
  std::deque<std::string> events;
  const auto see = [&](const RecordedState& state) {
    const auto& at = again.player().place().record;
    const auto last = watched.moment(rule).place.record;
    if (!is_known && at.has_value() && (!last || *at > *last)) return false;
    window.add(state);
    if (!state.event.empty()) {
      events.push_back(is_known || !at ? at_tick(state)
                                       : fmt::format("record {:<4} {}", *at + 1,
                                                     state.event));
      if (events.size() > kMostTold) events.pop_front();
    }
    return !is_known ||
           again.watch().states() <= watched.rules()[rule].decided.value_or(0);
  };
  again.play(see);
  told.events.assign(events.begin(), events.end());
  RecordedRun alone = names;
  if (log.marks) take_entries(alone, *log.marks);
  alone.states.clear();
  RecordedRun run = shown_run(std::move(alone), window.take(), told,
                              again.watch().texts(rule));
  if (!is_known) run.end_words += "; where ticks begin is not logged";
  return run;
}

}  // namespace

WatchedRule watched_rule(const BoundProperty& rule, Outlook outlook) {
  WatchedRule watched;
  watched.name = rule.property->name;
  watched.title = rule.property->title;
  watched.text = rule.property->text;
  watched.outlook = outlook;
  watched.is_question = rule.form == PropertyForm::Possible;
  watched.is_expected = rule.property->expectation == Expectation::Violated;
  return watched;
}

WatchedRule watched_rule(const LogWatch& watch, std::size_t rule) {
  WatchedRule watched = described(watch.rules()[rule]);
  const LogWatch::Moment& moment = watch.moment(rule);
  if (moment.place.record) watched.record = *moment.place.record + 1;
  if (watch.knows_ticks()) watched.tick = moment.tick;
  watched.time = moment.place.time;
  if (watch.is_guessed(rule)) {
    watched.guess = watch.knows_ticks() ? TickGuess::Count : TickGuess::Begin;
  }
  return watched;
}

Result<WatchReport> watch_log(const std::string& file, const BehaviorLog& log,
                              const LogReading& reading,
                              const PropertyFile& rules,
                              const SourceText& source) {
  RecordedRun heading = LogPlayer(log, reading).heading();
  heading.tree = file;
  return watch_log_as(heading, file, log, reading, rules, source);
}

Result<WatchReport> watch_log_as(const RecordedRun& heading,
                                 const std::string& file,
                                 const BehaviorLog& log,
                                 const LogReading& reading,
                                 const PropertyFile& rules,
                                 const SourceText& source) {
  auto made = LogWatch::make(heading, log, reading, rules, source);
  Result<WatchReport> result{std::nullopt, std::move(made.diagnostics)};
  if (!made.value) return result;
  LogWatch& watch = **made.value;
  watch.play();
  WatchReport report;
  report.heading =
      fmt::format("{}: {}, {}", file, counted(log.nodes.size(), "node"),
                  counted(log.transitions.size(), "record"));
  if (watch.knows_ticks()) {
    const auto ticks = static_cast<std::size_t>(watch.player().state().tick);
    report.heading += ", " + counted(ticks, "tick");
  }
  for (std::size_t i = 0; i < watch.rules().size(); ++i) {
    WatchedRule rule = watched_rule(watch, i);
    if (rule.outlook == Outlook::Violated) {
      rule.run =
          run_of_log(heading, log, reading, rules, source, i, watch, rule);
    }
    report.rules.push_back(std::move(rule));
  }
  result.value = std::move(report);
  return result;
}

Result<WatchReport> watch_run(const std::string& file, const RecordedRun& run,
                              const PropertyFile& rules,
                              const SourceText& source) {
  auto made = RecordedWatch::make(run, Recording::Run, rules, source);
  Result<WatchReport> result{std::nullopt, std::move(made.diagnostics)};
  if (!made.value) return result;
  RecordedWatch& watch = **made.value;
  // A loop may take time that its states do not count.
  std::vector<RecordedState> states;
  const int period = run.loop == kNoState
                         ? 0
                         : run.states.back().time + run.back_elapsed -
                               run.states[run.loop].time;
  for (const Passing& passing : unrolled(run, 2)) {
    RecordedState state = run.states[passing.state];
    if (states.size() >= run.states.size()) state.time += period;
    state.tick = passing.tick;
    state.atoms.clear();
    states.push_back(std::move(state));
  }
  const Play play = [&](RecordedWatch& seeing, const Show& show) {
    for (const RecordedState& state : states) {
      seeing.see(state);
      if (!show(state)) return;
    }
  };
  play(watch, [](const RecordedState&) { return true; });
  WatchReport report;
  report.heading = fmt::format(
      "{}: {}, {}, {}", file, counted(run.nodes.size(), "node"),
      counted(run.states.size(), "state"),
      counted(static_cast<std::size_t>(run.states.back().tick), "tick"));
  for (std::size_t i = 0; i < watch.rules().size(); ++i) {
    const RecordedWatch::Seen& seen = watch.rules()[i];
    WatchedRule rule = described(seen);
    if (seen.decided) rule.tick = states[*seen.decided].tick;
    if (rule.outlook == Outlook::Violated) {
      rule.run = run_up_to(run, rules, source, i, seen.decided.value_or(0),
                           rule, play);
      std::deque<std::string> events;
      for (const RecordedState& state : rule.run->states) {
        if (!state.event.empty()) events.push_back(at_tick(state));
        if (events.size() > kMostTold) events.pop_front();
      }
      rule.events.assign(events.begin(), events.end());
    }
    report.rules.push_back(std::move(rule));
  }
  result.value = std::move(report);
  return result;
}

// --- Told ----------------------------------------------------------------

namespace {

constexpr std::string_view kIndent = "           ";

}  // namespace

std::string moment_text(const WatchedRule& rule) {
  if (rule.outlook == Outlook::Open) {
    if (rule.guess == TickGuess::Begin) {
      return fmt::format(
          "where ticks begin is not logged, and decides it: attach "
          "btcheck::observer to the tree, or say {}",
          word(Choice::TickGap, "MS"));
    }
    if (rule.guess == TickGuess::Count) {
      return fmt::format(
          "ticks without a record are not logged, and decide it: attach "
          "btcheck::observer to the tree, or say {}",
          word(Choice::TickMs, "MS"));
    }
    if (!rule.has_unknown) return "";
    return "what it asks for is not known in each state";
  }
  const std::string tick = !rule.tick ? ""
                           : *rule.tick == 0
                               ? "before the first tick"
                               : fmt::format("tick {}", *rule.tick);
  if (!rule.record) {
    return tick.empty() ? "before the first record" : tick;
  }
  return fmt::format("record {}, {}{}after {} s", *rule.record, tick,
                     tick.empty() ? "" : ", ", seconds_text(rule.time));
}

std::string verdict_line(std::string_view verdict, std::string_view name,
                         std::string_view moment, bool is_expected) {
  return fmt::format("{:<10} {}{}{}\n", verdict, name,
                     moment.empty() ? "" : fmt::format("  ({})", moment),
                     is_expected ? "  (expected violated)" : "");
}

std::string rule_totals(const std::array<std::size_t, 4>& counts) {
  std::string text = fmt::format(
      "{}: {} satisfied, {} violated, {} open",
      counted(counts[0] + counts[1] + counts[2] + counts[3], "rule"), counts[1],
      counts[2], counts[0]);
  if (counts[3] > 0) text += fmt::format(", {} excluded", counts[3]);
  return text + "\n";
}

std::string watch_text(const WatchReport& report) {
  std::string text = report.heading + "\n";
  std::array<std::size_t, 4> counts{};
  for (const WatchedRule& rule : report.rules) {
    ++counts[static_cast<std::size_t>(rule.outlook)];
    text += verdict_line(kOutlookNames[static_cast<std::size_t>(rule.outlook)],
                         rule.name, moment_text(rule), rule.is_expected);
    if (!rule.title.empty()) text += fmt::format("{}{}\n", kIndent, rule.title);
    if (rule.outlook != Outlook::Violated) continue;
    text += fmt::format("{}{}\n", kIndent, rule.text);
    if (!rule.run) continue;
    text += "\n";
    for (const std::string& event : rule.events) text += "    " + event + "\n";
    text += "    -- " + rule.run->end_words + "\n\n";
  }
  return text + "\n" + rule_totals(counts);
}

bool is_broken(const WatchReport& report) {
  return std::ranges::any_of(report.rules, [](const WatchedRule& rule) {
    return rule.outlook == Outlook::Violated && !rule.is_expected;
  });
}

}  // namespace btcheck
