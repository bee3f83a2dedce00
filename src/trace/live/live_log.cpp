// SPDX-License-Identifier: MIT
//
// A log is read as a whole each time, and played from where its player stands.
#include "trace/live/live_log.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace btcheck {
namespace {

// So many states are shown at once.
constexpr std::size_t kPiece = 1000;

// Whether the log is the one before, and perhaps more of it. A recording of
// ROS 2 gets a node when it is first heard of: its run begins anew.
bool goes_on(const BehaviorLog& before, const BehaviorLog& now) {
  const bool is_one = before.begin == now.begin || before.transitions.empty();
  return is_one && before.xml == now.xml && before.nodes == now.nodes &&
         before.transitions.size() <= now.transitions.size() &&
         std::ranges::equal(
             before.transitions,
             std::span(now.transitions).first(before.transitions.size()));
}

bool is_pause(const RecordedState& state) {
  return !state.mover && state.time > 0;
}

}  // namespace

RecordedRun LiveLog::beginning() const {
  RecordedRun run = player_->heading();
  run.tree = file_;
  run.property = log_.tree.empty() ? "log" : log_.tree;
  run.formula = "a log of BehaviorTree.CPP; no property is checked";
  run.verdict = "LOG";
  return run;
}

std::vector<Diagnostic> LiveLog::take(std::string_view bytes) {
  auto read = read_log(file_, bytes, topic_);
  if (!read.value) return std::move(read.diagnostics);
  if (player_ && goes_on(log_, *read.value)) {
    log_ = std::move(*read.value);
    gather();
    show();
    return {};
  }
  log_ = std::move(*read.value);
  player_ = std::make_unique<LogPlayer>(log_, tick_time_);
  played_ = 0;
  states_.clear();
  gather();
  RecordedRun run = beginning();
  run.states = {std::move(states_.front())};
  states_.erase(states_.begin());
  if (run_) {
    run_->begin_anew(std::move(run));
  } else {
    run_ = std::make_unique<LiveRun>(std::move(run));
  }
  show();
  return {};
}

// A pause of an hour is one state, and not each of its ticks.
void LiveLog::gather() {
  const auto records = std::span(log_.transitions).subspan(played_);
  played_ = log_.transitions.size();
  player_->play_on(records, [this] {
    const RecordedState& state = player_->state();
    if (!states_.empty() && is_pause(states_.back()) && is_pause(state)) {
      states_.back() = state;
    } else {
      states_.push_back(state);
    }
    return true;
  });
}

void LiveLog::show() {
  const std::span<const RecordedState> all(states_);
  for (std::size_t at = 0; at < all.size(); at += kPiece) {
    run_->add(all.subspan(at, std::min(kPiece, all.size() - at)));
  }
  states_.clear();
}

void LiveLog::end(std::string_view words) {
  player_->play_end([this] {
    states_.push_back(player_->state());
    return true;
  });
  show();
  run_->end(words);
}

}  // namespace btcheck
