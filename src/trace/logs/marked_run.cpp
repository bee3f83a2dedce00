// SPDX-License-Identifier: MIT
//
// A log with marks, played: each tick, each answer and each entry is told, so
// nothing has happened unseen.
#include <algorithm>
#include <utility>

#include "trace/logs/log_run.hpp"
#include "trace/logs/marks.hpp"

namespace btcheck {

bool LogPlayer::play_marks(const std::function<bool()>& see) {
  see_ = &see;
  if (!has_begun_ && !see()) return false;
  has_begun_ = true;
  const std::vector<LogMark>& events = log_.marks->events;
  while (mark_ < events.size()) {
    if (!play(events[mark_++])) return false;
  }
  return true;
}

bool LogPlayer::play(const LogMark& mark) {
  const bool is_entry = mark.kind == MarkKind::Entry;
  if (mark.kind != MarkKind::Record && !is_entry) has_said_.reset();
  if (mark.kind != MarkKind::NodeAnswers && !is_entry) has_set_.reset();
  switch (mark.kind) {
    case MarkKind::TickBegins:
    case MarkKind::TickIsWoken:
      place_.time = mark.time;
      return enter_tick(std::int64_t{state_.tick} + 1);
    case MarkKind::TickEnds:
      place_.time = mark.time;
      return end_with(mark.status);
    case MarkKind::TickIsLeft:
      place_.time = mark.time;
      return leave_tick(log_.marks->texts[mark.number]);
    case MarkKind::NodeBegins:
      return begin_node(number_of(mark.uid));
    case MarkKind::NodeAnswers:
      return hear_answer(number_of(mark.uid), mark.status);
    case MarkKind::Record:
      return change(log_.transitions[played_]);
    case MarkKind::WasBefore:
      take_as_given(log_.transitions[played_++]);
      return true;
    case MarkKind::Entry:
      state_.values[mark.number] =
          log_.marks->texts[static_cast<std::size_t>(mark.time)];
      return true;
    case MarkKind::TickAgain:
      return play_again(mark);
    case MarkKind::End:
    case MarkKind::Lost:
      break;  // are not among the events
  }
  return true;
}

// All of a tick, from its first mark to the one that ends it.
bool LogPlayer::play_again(const LogMark& again) {
  const std::vector<LogMark>& events = log_.marks->events;
  for (std::size_t i = again.number;; ++i) {
    LogMark mark = events[i];
    const bool is_end = mark.kind == MarkKind::TickEnds;
    if (is_end || begins_tick(mark)) mark.time = again.time;
    if (!play(mark)) return false;
    if (is_end) return true;
  }
}

bool LogPlayer::begin_node(std::size_t node) {
  if (!call_above(node)) return false;
  if (state_.locations[node] != "start_") return true;
  if (!let_go_below(*heading_.nodes[node].parent)) return false;
  called_.push_back(node);
  return reach(node, "tick_node", Phase::Here) &&
         (is_leaf_[node] || reach(node, "called", Phase::Waiting));
}

bool LogPlayer::hear_answer(std::size_t node, LogStatus status) {
  const auto set = std::exchange(has_set_, std::nullopt);
  if (set == std::pair(node, status)) return true;
  if (!call_above(node)) return false;
  if (state_.locations[node] == "start_" &&
      !(let_go_below(*heading_.nodes[node].parent) &&
        reach(node, "tick_node", Phase::Here))) {
    return false;
  }
  has_said_ = {node, status};
  if (!let_go_below(node)) return false;
  std::erase(called_, node);
  outcome_[node] = status;
  if (status != LogStatus::Skipped) state_.statuses[node] = word_of(status);
  return reach(node, word_of(status), phase_of(status)) &&
         rest(node, phase_of(status));
}

// A record: of an answer that was heard, of a status that a node sets within
// its tick, or of one that is set from outside.
bool LogPlayer::change(const LogTransition& record) {
  place_ = {played_++, record.time};
  const std::size_t node = number_of(record.uid);
  const auto said = std::exchange(has_said_, std::nullopt);
  const LogStatus before = std::exchange(status_[node], record.after);
  switch (record.after) {
    case LogStatus::Running:
      if (said == std::pair(node, record.after)) return true;
      if (!begin_node(node)) return false;
      state_.statuses[node] = "running";
      return show(node, "");
    case LogStatus::Success:
    case LogStatus::Failure:
    case LogStatus::Skipped:
      if (said == std::pair(node, record.after)) return true;
      if (!hear_answer(node, record.after)) return false;
      has_said_.reset();
      has_set_ = {node, record.after};
      return true;
    case LogStatus::Idle:
      break;
  }
  state_.statuses[node] = "idle";
  if (before == LogStatus::Running && state_.locations[node] == "start_") {
    return reach(node, "halted", Phase::Halted) && rest(node, Phase::Halted);
  }
  return show(node, "");
}

// What was so before the log began.
void LogPlayer::take_as_given(const LogTransition& record) {
  const std::size_t node = number_of(record.uid);
  status_[node] = record.after;
  switch (record.after) {
    case LogStatus::Running:
      state_.statuses[node] = "running";
      break;
    case LogStatus::Success:
      state_.statuses[node] = "success";
      break;
    case LogStatus::Failure:
      state_.statuses[node] = "failure";
      break;
    case LogStatus::Idle:
    case LogStatus::Skipped:
      state_.statuses[node] = "idle";
      break;
  }
}

bool LogPlayer::end_with(LogStatus status) {
  if (!let_go_below(0)) return false;
  is_over_ = is_completed(status);
  outcome_[0] = status;
  state_.statuses[0] = word_of(status);
  return reach(0, word_of(status), phase_of(status)) &&
         rest(0, phase_of(status)) && pass_time();
}

// By an exception: nobody in it has answered.
bool LogPlayer::leave_tick(const std::string& why) {
  called_.push_back(0);
  for (const std::size_t node : std::exchange(called_, {})) {
    state_.locations[node] = "start_";
    state_.phases[node] = Phase::Unvisited;
  }
  if (!show(0, "the tick is left by an exception: " + why)) return false;
  return pass_time();
}

}  // namespace btcheck
