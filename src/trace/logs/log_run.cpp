// SPDX-License-Identifier: MIT
//
// What the engine's TreeNode::setStatus tells a logger, told as what nodes do:
// a node with children is RUNNING once it is ticked, a leaf once it has
// answered so, or while its function is called; a node that goes from RUNNING
// to IDLE has been halted, and one that goes there from an answer has been
// reset, which is no event.
#include "trace/logs/log_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// So many units of time are told one by one between two records. No rule that
// can be monitored counts further.
constexpr std::int64_t kMostUnits = 1'000'000;

Phase phase_of(LogStatus answer) {
  if (answer == LogStatus::Success) return Phase::Success;
  return answer == LogStatus::Failure ? Phase::Failure : Phase::Skipped;
}

// "success"
const char* word_of(LogStatus answer) {
  if (answer == LogStatus::Success) return "success";
  return answer == LogStatus::Failure ? "failure" : "skipped";
}

}  // namespace

LogPlayer::LogPlayer(const BehaviorLog& log, std::int64_t tick_time,
                     std::int64_t pause)
    : log_(log), ticks_(log, tick_time, pause) {
  heading_.ticks = "root";
  const std::string tree = log.tree.empty() ? "tree" : log.tree;
  heading_.nodes.push_back({"", "BehaviorTree", tree, 0, 0, std::nullopt});
  std::vector<bool> has_children(log.nodes.size() + 1, false);
  is_silent_.push_back(false);
  for (const LogNode& node : log.nodes) {
    const std::size_t above = node.parent ? number_of(*node.parent) : 0;
    has_children[above] = true;
    is_silent_.push_back(node.is_silent);
    if (above == 0 && node.is_silent) is_silent_[0] = true;
    heading_.nodes.push_back({"", node.type,
                              node.name.empty() ? node.type : node.name, 0, 0,
                              static_cast<std::uint32_t>(above)});
  }
  const std::size_t count = heading_.nodes.size();
  for (std::size_t n = 0; n < count; ++n) {
    RecordedNode& node = heading_.nodes[n];
    node.key = fmt::format("{}_btn{}", plain_word(node.name), n);
    is_leaf_.push_back(!has_children[n]);
    if (is_leaf_[n]) node.type = "Action";
  }
  status_.assign(count, LogStatus::Idle);
  outcome_.assign(count, LogStatus::Idle);
  state_.phases.assign(count, Phase::Unvisited);
  state_.is_stale.assign(count, false);
  state_.statuses.assign(count, "idle");
  state_.locations.assign(count, "start_");
  state_.step = "start";
}

std::size_t LogPlayer::number_of(std::uint16_t uid) const {
  return static_cast<std::size_t>(log_.find(uid) - log_.nodes.data()) + 1;
}

Unseen LogPlayer::unseen(std::size_t node) const {
  if (is_silent_[node]) return Unseen::Anything;
  const std::string& here = state_.locations[node];
  if (here != "start_" && here != "called") return Unseen::Nothing;
  if (maybe_halted_ == node) return Unseen::Halted;
  if (node == 0) return Unseen::Nothing;
  if (status_[node] == LogStatus::Running) return Unseen::Running;
  if (here == "called" && status_[node] == LogStatus::Idle) {
    return Unseen::Skipped;
  }
  const bool is_kept = !is_own(log_) && is_completed(status_[node]);
  return is_kept ? Unseen::Repeated : Unseen::Nothing;
}

void LogPlayer::play(const std::function<bool()>& see) {
  if (play_on(log_.transitions, see)) play_end(see);
}

bool LogPlayer::play_on(std::span<const LogTransition> records,
                        const std::function<bool()>& see) {
  see_ = &see;
  if (!has_begun_ && !see()) return false;
  has_begun_ = true;
  for (const LogTransition& record : records) {
    if (!begin_tick(ticks_.tick_at(record.time))) return false;
    place_ = {played_++, record.time};
    if (!read(record)) return false;
  }
  return true;
}

// Whether the last tick is over is known only where the tree has ended in it.
bool LogPlayer::play_end(const std::function<bool()>& see) {
  see_ = &see;
  return is_over_ || !is_completed(answer_of_tick()) || end_tick();
}

bool LogPlayer::end_if_over(const std::function<bool()>& see) {
  see_ = &see;
  if (!settle()) return false;
  const LogStatus answer = answer_of_tick();
  if (is_over_ || !is_completed(answer)) return true;
  is_over_ = true;
  if (!let_go_below(0)) return false;
  state_.statuses[0] = word_of(answer);
  return reach(0, word_of(answer), phase_of(answer)) &&
         rest(0, phase_of(answer));
}

// What has been written down is shown, and the node gets its next location.
bool LogPlayer::show(std::size_t node, std::string event) {
  state_.mover = static_cast<std::uint32_t>(node);
  state_.step =
      fmt::format("{}: {}", heading_.nodes[node].key, state_.locations[node]);
  state_.event = std::move(event);
  state_.is_chosen = !state_.event.empty() && is_leaf_[node];
  return (*see_)();
}

bool LogPlayer::reach(std::size_t node, const char* location, Phase phase) {
  state_.locations[node] = location;
  state_.phases[node] = phase;
  state_.is_stale[node] = false;
  const bool is_answer = phase == Phase::Running || is_completed(phase) ||
                         phase == Phase::Halted || phase == Phase::Skipped;
  std::string event;
  if (is_answer && std::string_view(location) != "start_") {
    event = fmt::format("{} -> {}", heading_.nodes[node].name, location);
  }
  return show(node, std::move(event));
}

// Control is given back, and the node waits to be called again.
bool LogPlayer::rest(std::size_t node, Phase phase) {
  state_.locations[node] = "done";
  if (!show(node, "")) return false;
  state_.locations[node] = "start_";
  state_.phases[node] = phase;
  return show(node, "");
}

bool LogPlayer::begin_tick(std::int64_t tick) {
  if (tick == state_.tick) return true;
  if (!settle()) return false;
  if (state_.tick > 0 && !is_over_ && !end_tick()) return false;
  is_over_ = false;
  const std::int64_t passed = state_.tick == 0 ? tick - 1 : tick - state_.tick;
  state_.mover.reset();
  state_.event.clear();
  state_.step = "time passes";
  for (std::int64_t i = std::min(passed, kMostUnits); i > 0; --i) {
    ++state_.time;
    if (!(*see_)()) return false;
  }
  constexpr std::int64_t kGreatest = INT32_MAX;
  state_.tick = static_cast<int>(std::min(tick, kGreatest));
  for (std::size_t n = 0; n < is_leaf_.size(); ++n) {
    state_.is_stale[n] = state_.phases[n] != Phase::Unvisited;
  }
  outcome_.assign(outcome_.size(), LogStatus::Idle);
  if (!reach(0, "tick_node", Phase::Here)) return false;
  state_.phases[0] = Phase::Waiting;
  state_.locations[0] = "called";
  return show(0, "");
}

// The tree answers what its top node has.
LogStatus LogPlayer::answer_of_tick() const {
  LogStatus answer = LogStatus::Running;
  for (std::size_t n = 1; n < outcome_.size(); ++n) {
    if (heading_.nodes[n].parent == 0 && is_completed(outcome_[n])) {
      answer = outcome_[n];
    }
  }
  return answer;
}

bool LogPlayer::end_tick() {
  if (!let_go_below(0)) return false;
  const LogStatus answer = answer_of_tick();
  if (is_completed(answer)) {
    state_.statuses[0] = word_of(answer);
    return reach(0, word_of(answer), phase_of(answer));
  }
  state_.statuses[0] = "running";
  return reach(0, "running", Phase::Running) && rest(0, Phase::Running);
}

bool LogPlayer::read(const LogTransition& record) {
  const std::size_t node = number_of(record.uid);
  const bool is_answer =
      record.after != LogStatus::Running && record.after != LogStatus::Idle;
  if (taken_up_ == node && is_answer) {
    taken_up_.reset();
  } else if (!settle()) {
    return false;
  }
  const bool is_ticked = record.after != LogStatus::Idle;
  if (is_ticked && !is_own(log_) && !call_above(node)) return false;
  const LogStatus before = std::exchange(status_[node], record.after);
  const bool was_halted = halted_before_ && record.after == LogStatus::Idle &&
                          heading_.nodes[*halted_before_].parent == node;
  const bool is_clear = is_leaf_[node] || log_.version < 4 || was_halted;
  halted_before_.reset();
  switch (record.after) {
    case LogStatus::Running:
      return take_up(node, is_leaf_[node]);
    case LogStatus::Success:
    case LogStatus::Failure:
    case LogStatus::Skipped:
      return (before == LogStatus::Running ||
              state_.locations[node] == "called" ||
              reach(node, "tick_node", Phase::Here)) &&
             answer(node, record.after);
    case LogStatus::Idle:
      break;
  }
  state_.statuses[node] = "idle";
  if (before != LogStatus::Running) return show(node, "");
  halted_before_ = node;
  if (is_clear) {
    return reach(node, "halted", Phase::Halted) && rest(node, Phase::Halted);
  }
  maybe_halted_ = node;
  const bool goes_on = reach(node, "start_", Phase::Halted);
  maybe_halted_.reset();
  return goes_on;
}

bool LogPlayer::take_up(std::size_t node, bool is_leaf) {
  if (std::erase(called_, node) > 0) {
    state_.statuses[node] = "running";
    return show(node, "");
  }
  if (!reach(node, "tick_node", Phase::Here)) return false;
  state_.statuses[node] = "running";
  if (!is_leaf) return reach(node, "called", Phase::Waiting);
  taken_up_ = node;
  return !is_own(log_) || settle();  // ours says RUNNING as an answer only
}

// Nodes that leave no record before their child has one.
bool LogPlayer::call_above(std::size_t node) {
  std::vector<std::size_t> above;
  for (std::size_t n = *heading_.nodes[node].parent; n != 0;
       n = *heading_.nodes[n].parent) {
    if (is_silent_[n]) continue;
    if (state_.locations[n] != "start_") break;
    above.push_back(n);
  }
  for (; !above.empty(); above.pop_back()) {
    const std::size_t n = above.back();
    called_.push_back(n);
    if (!reach(n, "tick_node", Phase::Here) ||
        !reach(n, "called", Phase::Waiting)) {
      return false;
    }
  }
  return true;
}

bool LogPlayer::is_below(std::size_t node, std::size_t above) const {
  while (node != above && node != 0) node = *heading_.nodes[node].parent;
  return node == above;
}

// What was ticked without a record, and has none for its answer either, was
// skipped, or has answered what it had: its parent has gone on.
bool LogPlayer::let_go_below(std::size_t node) {
  const auto ended = std::partition(
      called_.begin(), called_.end(),
      [&](std::size_t n) { return n == node || !is_below(n, node); });
  const std::vector<std::size_t> below(ended, called_.end());
  called_.erase(ended, called_.end());
  return std::ranges::all_of(below, [&](std::size_t n) {
    state_.locations[n] = "start_";
    state_.phases[n] =
        status_[n] == LogStatus::Idle ? Phase::Skipped : phase_of(status_[n]);
    return show(n, "");
  });
}

// The leaf that became RUNNING last has answered so.
bool LogPlayer::settle() {
  const auto leaf = std::exchange(taken_up_, std::nullopt);
  return !leaf || (reach(*leaf, "running", Phase::Running) &&
                   rest(*leaf, Phase::Running));
}

bool LogPlayer::answer(std::size_t node, LogStatus status) {
  if (!let_go_below(node)) return false;
  std::erase(called_, node);
  outcome_[node] = status;
  state_.statuses[node] = word_of(status);
  if (status == LogStatus::Skipped) state_.statuses[node] = "idle";
  return reach(node, word_of(status), phase_of(status)) &&
         rest(node, phase_of(status));
}

}  // namespace btcheck
