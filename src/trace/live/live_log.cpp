// SPDX-License-Identifier: MIT
//
// A log is read as a whole each time, and played from where its player stands.
#include "trace/live/live_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ltl/monitor/monitor.hpp"
#include "trace/watch/watched_run.hpp"

namespace btcheck {
namespace {

// So many states are shown at once.
constexpr std::size_t kPiece = 1000;

constexpr std::string_view kOpen =
    kOutlookNames[static_cast<std::size_t>(Outlook::Open)];

// Whether the log is the one before, and perhaps more of it. A recording of
// ROS 2 gets a node when it is first heard of: its run begins anew.
bool goes_on(const BehaviorLog& before, const BehaviorLog& now) {
  const bool is_one = before.begin == now.begin || before.transitions.empty();
  return is_one && before.marks.has_value() == now.marks.has_value() &&
         before.xml == now.xml && before.nodes == now.nodes &&
         before.transitions.size() <= now.transitions.size() &&
         std::ranges::equal(
             before.transitions,
             std::span(now.transitions).first(before.transitions.size()));
}

bool is_pause(const RecordedState& state) {
  return !state.mover && state.time > 0;
}

}  // namespace

// What rules of one file say of the log.
struct LiveLog::Judge {
  LogInTree in_tree;
  std::unique_ptr<LogWatch> watch = {};
};

LiveLog::LiveLog(std::string file, const LogReading& reading, std::string topic,
                 std::vector<LiveRules> rules)
    : file_(std::move(file)),
      reading_(reading),
      topic_(std::move(topic)),
      rules_(std::move(rules)) {}

LiveLog::~LiveLog() = default;

RecordedRun LiveLog::beginning() const {
  RecordedRun run = titled(player_->heading(), file_, log_);
  if (!rules_.empty()) {
    run.formula = "a log of BehaviorTree.CPP, and rules asked of it";
  }
  if (!words_.empty()) run.formula = words_;
  if (!log_.marks) {
    run.variables = names_;
    run.is_number.assign(names_.size(), false);
  }
  return run;
}

std::vector<Diagnostic> LiveLog::take(std::string_view bytes,
                                      const std::string* marks) {
  auto read = read_log(file_, bytes, topic_);
  if (!read.value) return std::move(read.diagnostics);
  BehaviorLog& now = *read.value;
  if (marks != nullptr) {
    auto flaws = read_marks(file_ + std::string(kMarksEnding), *marks, now);
    if (has_error(flaws)) return flaws;
  }
  if (!player_ || !goes_on(log_, now)) return begin(std::move(now));
  if (now.marks) {
    add_marks(std::move(now));
  } else {
    log_.begin = now.begin;  // of a .fbl, that of its first record
    const std::vector<LogTransition> all = std::move(now.transitions);
    add(std::span(all).subspan(log_.transitions.size()));
  }
  return {};
}

// The judges have logs of their own: places and names may be of a tree.
void LiveLog::add_marks(BehaviorLog log) {
  const bool is_more = log.marks->events.size() > log_.marks->events.size();
  log_ = std::move(log);
  if (!is_more) return;
  gather({});
  show();
  for (const auto& each : judges_) {
    each->in_tree.log = log_;
    each->watch->play_marks();
  }
  judge();
}

// A judge for each file of rules, of a log from its beginning on.
std::vector<Diagnostic> LiveLog::ask(const BehaviorLog& log) {
  std::vector<std::unique_ptr<Judge>> judges;
  for (const LiveRules& rules : rules_) {
    Result<LogInTree> placed;
    if (rules.place) {
      placed = rules.place(log);
    } else {
      RecordedRun names = LogPlayer(log, reading_).heading();
      names.tree = file_;
      placed.value = {std::move(names), log};
    }
    if (!placed.value) return std::move(placed.diagnostics);
    auto judge = std::make_unique<Judge>(Judge{std::move(*placed.value)});
    auto watch = LogWatch::make(judge->in_tree.names, judge->in_tree.log,
                                reading_, rules.file, rules.source);
    if (!watch.value) return std::move(watch.diagnostics);
    judge->watch = std::move(*watch.value);
    if (judge->in_tree.log.marks) {
      judge->watch->play_marks();
    } else {
      judge->watch->play_on(judge->in_tree.log.transitions);
    }
    judges.push_back(std::move(judge));
  }
  judges_ = std::move(judges);
  return {};
}

std::vector<Diagnostic> LiveLog::begin(BehaviorLog log) {
  std::vector<Diagnostic> flaws = ask(log);
  if (!flaws.empty()) return flaws;
  log_ = std::move(log);
  player_ = std::make_unique<LogPlayer>(log_, reading_);
  verdicts_.clear();
  is_open_ = true;
  states_.clear();
  places_.clear();
  forgotten_ = 0;
  gather(log_.transitions);
  RecordedRun run = beginning();
  run.states = {std::move(states_.front())};
  states_.erase(states_.begin());
  if (run_) {
    run_->begin_anew(std::move(run));
  } else {
    run_ = std::make_unique<LiveRun>(std::move(run));
  }
  show();
  judge();
  return {};
}

void LiveLog::add(std::span<const LogTransition> records, Shown shown) {
  if (records.empty()) return;
  if (!forgets_) {
    log_.transitions.insert(log_.transitions.end(), records.begin(),
                            records.end());
  }
  gather(records, shown);
  show();
  // A recording's records are of other nodes in a tree.
  if (!log_.has_places()) {
    ask(log_);
  } else {
    for (const auto& each : judges_) each->watch->play_on(records);
  }
  judge();
  if (!forgets_) return;
  forgotten_ += places_.size();
  places_.clear();
}

void LiveLog::know(const std::map<std::string, std::string>& entries) {
  const std::vector<std::string> before = values_;
  if (!is_open_) {
    names_.clear();
    for (const auto& [name, value] : entries) names_.push_back(name);
  }
  values_.clear();
  for (const std::string& name : names_) {
    const auto found = entries.find(name);
    values_.push_back(found == entries.end() ? "unset" : found->second);
  }
  if (!is_open_ || values_ == before) return;
  note_state();
  states_.back().mover.reset();
  states_.back().event.clear();
  states_.back().step = "entries";
  show();
}

void LiveLog::note_state() {
  const auto record = player_->place().record;
  states_.push_back(player_->state());
  if (!log_.marks) states_.back().values = values_;
  places_.emplace_back(record ? *record + 1 : 0, player_->state().tick);
}

// A pause of an hour is one state, and not each of its ticks.
void LiveLog::gather(std::span<const LogTransition> records, Shown shown) {
  const auto see = [&] {
    if (shown != Shown::Each) return true;
    const RecordedState& state = player_->state();
    if (!states_.empty() && is_pause(states_.back()) && is_pause(state)) {
      states_.pop_back();
      places_.pop_back();
    }
    note_state();
    return true;
  };
  if (log_.marks) {
    player_->play_marks(see);
  } else {
    player_->play_on(records, see);
    if (shown == Shown::Last) note_state();
  }
}

void LiveLog::show() {
  const std::span<const RecordedState> all(states_);
  for (std::size_t at = 0; at < all.size(); at += kPiece) {
    run_->add(all.subspan(at, std::min(kPiece, all.size() - at)));
  }
  states_.clear();
}

// The last one in which it may be told: of the record, and of the tick.
std::size_t LiveLog::state_of(const LogWatch& watch, std::size_t rule) const {
  const LogWatch::Moment& moment = watch.moment(rule);
  std::size_t records = moment.place.record ? *moment.place.record + 1 : 0;
  if (records > 0 && !log_.has_places()) {
    const auto later = std::ranges::upper_bound(
        log_.transitions, moment.place.time, {}, &LogTransition::time);
    records = static_cast<std::size_t>(later - log_.transitions.begin());
  }
  int tick = moment.tick;
  if (!watch.knows_ticks()) {
    const auto first = std::ranges::lower_bound(
        places_, records, {}, &std::pair<std::size_t, int>::first);
    if (first != places_.end()) tick = first->second;
  }
  const auto later = std::ranges::partition_point(
      places_, [&](const std::pair<std::size_t, int>& place) {
        return place.first <= records && place.second <= tick;
      });
  const auto state =
      forgotten_ + static_cast<std::size_t>(later - places_.begin());
  return state == 0 ? 0 : state - 1;
}

void LiveLog::judge() {
  if (judges_.empty()) return;
  const std::vector<LiveVerdict> before = std::exchange(verdicts_, {});
  for (const auto& each : judges_) {
    for (std::size_t i = 0; i < each->watch->rules().size(); ++i) {
      const std::size_t number = verdicts_.size();
      if (number < before.size() && before[number].verdict != kOpen) {
        verdicts_.push_back(before[number]);  // for good
        continue;
      }
      const WatchedRule rule = watched_rule(*each->watch, i);
      LiveVerdict& told = verdicts_.emplace_back();
      told.name = rule.name;
      told.text = rule.text;
      told.verdict = kOutlookNames[static_cast<std::size_t>(rule.outlook)];
      told.moment = moment_text(rule);
      told.is_expected = rule.is_expected;
      if (rule.outlook != Outlook::Open) {
        told.state = state_of(*each->watch, i);
      }
    }
  }
  run_->judge(verdicts_);
}

std::string LiveLog::verdicts_text() const {
  std::string text;
  for (const LiveVerdict& rule : verdicts_) {
    text +=
        verdict_line(rule.verdict, rule.name, rule.moment, rule.is_expected);
  }
  return text;
}

bool LiveLog::is_broken() const {
  return std::ranges::any_of(verdicts_, [](const LiveVerdict& rule) {
    return rule.verdict == "VIOLATED" && !rule.is_expected;
  });
}

void LiveLog::close() {
  if (!std::exchange(is_open_, false)) return;
  player_->play_end([this] {
    note_state();
    return true;
  });
  show();
  for (const auto& each : judges_) each->watch->play_end();
  judge();
}

void LiveLog::end(std::string_view words) {
  close();
  run_->end(words);
}

}  // namespace btcheck
