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
#include "trace/logs/log_run.hpp"
#include "trace/watch/recorded_watch.hpp"

namespace btcheck {
namespace {

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
RecordedRun run_up_to(const RecordedRun& heading, Recording recording,
                      const PropertyFile& rules, const SourceText& source,
                      std::size_t rule, std::size_t decided,
                      const WatchedRule& told, const Play& play) {
  auto again = RecordedWatch::make(heading, recording, rules, source);
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

// A log, and behind it, where the tree has ended, the time that goes on.
// Whether another last tick is over is not known.
void play_log(
    RecordedWatch& watch, const BehaviorLog& log, std::int64_t tick_time,
    const std::function<bool(const LogPlayer&, const RecordedState&)>& show,
    std::int64_t pause = kTickPause) {
  LogPlayer player(log, tick_time, pause);
  const auto see = [&](const RecordedState& state) {
    watch.see(state, [&](std::size_t n) { return player.unseen(n); });
    return show(player, state);
  };
  bool goes_on = true;
  player.play([&] { return goes_on = see(player.state()); });
  RecordedState later = player.state();
  const bool has_ended =
      later.locations[0] == "success" || later.locations[0] == "failure";
  if (!goes_on || !has_ended) return;
  ++later.time;
  later.mover.reset();
  later.event.clear();
  later.step = "time passes";
  see(later);
}

// Whether some pause may part two ticks or stand within one: the executor may
// have slept, or a function blocked.
bool has_doubtful_ticks(const BehaviorLog& log, std::int64_t tick_time) {
  const std::int64_t most = std::max(most_pause(tick_time), kTickPause + 1);
  const auto is_doubtful = [&](const LogTransition& one,
                               const LogTransition& next) {
    const std::int64_t pause = next.time - one.time;
    return pause >= kLeastPause && pause < most;
  };
  return !is_own(log) &&
         std::ranges::adjacent_find(log.transitions, is_doubtful) !=
             log.transitions.end();
}

// Takes back what is decided otherwise where all doubtful pauses part two
// ticks, or none does.
void take_back_guesses(const RecordedRun& heading, const BehaviorLog& log,
                       std::int64_t tick_time, const PropertyFile& rules,
                       const SourceText& source,
                       std::vector<WatchedRule>& told) {
  if (!has_doubtful_ticks(log, tick_time)) return;
  for (const std::int64_t pause : {kLeastPause, most_pause(tick_time)}) {
    auto made = RecordedWatch::make(heading, Recording::Log, rules, source);
    RecordedWatch& watch = **made.value;
    const auto go_on = [](const LogPlayer&, const RecordedState&) {
      return true;
    };
    play_log(watch, log, tick_time, go_on, pause);
    for (std::size_t i = 0; i < told.size(); ++i) {
      WatchedRule& rule = told[i];
      if (rule.outlook == Outlook::Open ||
          watch.rules()[i].run.outlook() == rule.outlook) {
        continue;
      }
      rule.outlook = Outlook::Open;
      rule.is_guessed = true;
      rule.record.reset();
    }
  }
}

// The branches of a Parallel of a .btf tree go side by side, and a log that is
// written of them has their records one branch after another. The engine itself
// ticks one after the other.
std::optional<Diagnostic> unordered(const BehaviorLog& log,
                                    const SourceText& source) {
  const auto side_by_side =
      std::ranges::find_if(log.nodes, [](const LogNode& node) {
        return node.type == "Parallel" || node.type == "ParallelAll";
      });
  if (!is_own(log) || side_by_side == log.nodes.end()) return std::nullopt;
  return source.diagnostic(
      Severity::Error, "BT1805", {},
      fmt::format("this log does not show in which order the branches of `{}` "
                  "went on",
                  side_by_side->name),
      "", "ask the ITF file of the run");
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

Result<WatchReport> watch_log(const std::string& file, const BehaviorLog& log,
                              std::int64_t tick_time, const PropertyFile& rules,
                              const SourceText& source) {
  RecordedRun heading = LogPlayer(log, tick_time).heading();
  heading.tree = file;
  return watch_log_as(heading, file, log, tick_time, rules, source);
}

Result<WatchReport> watch_log_as(const RecordedRun& heading,
                                 const std::string& file,
                                 const BehaviorLog& log, std::int64_t tick_time,
                                 const PropertyFile& rules,
                                 const SourceText& source) {
  if (auto refused = unordered(log, source)) {
    return {std::nullopt, {std::move(*refused)}};
  }
  auto made = RecordedWatch::make(heading, Recording::Log, rules, source);
  Result<WatchReport> result{std::nullopt, std::move(made.diagnostics)};
  if (!made.value) return result;
  RecordedWatch& watch = **made.value;
  std::vector<std::pair<LogPlace, int>> decided(watch.rules().size());
  int ticks = 0;
  play_log(watch, log, tick_time,
           [&](const LogPlayer& player, const RecordedState& state) {
             ticks = state.tick;
             for (std::size_t i = 0; i < decided.size(); ++i) {
               const auto& at = watch.rules()[i].decided;
               if (at && *at + 1 == watch.states()) {
                 decided[i] = {player.place(), state.tick};
               }
             }
             return true;
           });
  WatchReport report;
  report.heading =
      fmt::format("{}: {}, {}, {}", file, counted(log.nodes.size(), "node"),
                  counted(log.transitions.size(), "record"),
                  counted(static_cast<std::size_t>(ticks), "tick"));
  for (std::size_t i = 0; i < watch.rules().size(); ++i) {
    const RecordedWatch::Seen& seen = watch.rules()[i];
    WatchedRule rule = described(seen);
    const LogPlace& place = decided[i].first;
    if (place.record) rule.record = *place.record + 1;
    rule.tick = decided[i].second;
    rule.time = place.time;
    report.rules.push_back(std::move(rule));
  }
  take_back_guesses(heading, log, tick_time, rules, source, report.rules);
  for (std::size_t i = 0; i < report.rules.size(); ++i) {
    WatchedRule& rule = report.rules[i];
    if (rule.outlook != Outlook::Violated) continue;
    rule.run =
        run_up_to(heading, Recording::Log, rules, source, i,
                  watch.rules()[i].decided.value_or(0), rule,
                  [&](RecordedWatch& again, const Show& show) {
                    play_log(again, log, tick_time,
                             [&](const LogPlayer&, const RecordedState& state) {
                               return show(state);
                             });
                  });
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
      rule.run = run_up_to(run, Recording::Run, rules, source, i,
                           seen.decided.value_or(0), rule, play);
    }
    report.rules.push_back(std::move(rule));
  }
  result.value = std::move(report);
  return result;
}

// --- Told ----------------------------------------------------------------

namespace {

constexpr std::string_view kIndent = "           ";

std::string word_of(const WatchedRule& rule) {
  return std::string(kOutlookNames[static_cast<std::size_t>(rule.outlook)]);
}

std::string moment_of(const WatchedRule& rule) {
  if (rule.outlook == Outlook::Open) {
    if (rule.is_guessed) {
      return fmt::format(
          "  (a pause may be between two ticks or within one; {} says how long "
          "they are)",
          word(Choice::TickMs));
    }
    if (!rule.has_unknown) return "";
    return "  (what it asks for is not known in each state)";
  }
  const std::string tick = rule.tick == 0 ? "before the first tick"
                                          : fmt::format("tick {}", rule.tick);
  if (!rule.record) return fmt::format("  ({})", tick);
  return fmt::format("  (record {}, {}, after {}.{:06} s)", *rule.record, tick,
                     rule.time / 1'000'000, rule.time % 1'000'000);
}

// What happened last, up to the moment.
std::string events_of(const RecordedRun& run) {
  constexpr std::size_t kMostTold = 12;
  std::deque<std::string> lines;
  for (const RecordedState& state : run.states) {
    if (state.event.empty()) continue;
    lines.push_back(
        fmt::format("    tick {:<4} {}\n", state.tick, state.event));
    if (lines.size() > kMostTold) lines.pop_front();
  }
  std::string text = "\n";
  for (const std::string& line : lines) text += line;
  return text + "    -- " + run.end_words + "\n\n";
}

}  // namespace

std::string watch_text(const WatchReport& report) {
  std::string text = report.heading + "\n";
  std::array<std::size_t, 4> counts{};
  for (const WatchedRule& rule : report.rules) {
    ++counts[static_cast<std::size_t>(rule.outlook)];
    text += fmt::format("{:<10} {}{}{}\n", word_of(rule), rule.name,
                        moment_of(rule),
                        rule.is_expected ? "  (expected violated)" : "");
    if (!rule.title.empty()) text += fmt::format("{}{}\n", kIndent, rule.title);
    if (rule.outlook != Outlook::Violated) continue;
    text += fmt::format("{}{}\n", kIndent, rule.text);
    if (rule.run) text += events_of(*rule.run);
  }
  text += fmt::format("\n{}: {} satisfied, {} violated, {} open",
                      counted(report.rules.size(), "rule"), counts[1],
                      counts[2], counts[0]);
  if (counts[3] > 0) text += fmt::format(", {} excluded", counts[3]);
  return text + "\n";
}

bool is_broken(const WatchReport& report) {
  return std::ranges::any_of(report.rules, [](const WatchedRule& rule) {
    return rule.outlook == Outlook::Violated && !rule.is_expected;
  });
}

}  // namespace btcheck
