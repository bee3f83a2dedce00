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

}  // namespace

RecordedRun titled(RecordedRun heading, const std::string& file,
                   const BehaviorLog& log) {
  heading.tree = file;
  heading.property = log.tree.empty() ? "log" : log.tree;
  heading.formula = "a log of BehaviorTree.CPP; no property is checked";
  heading.verdict = "LOG";
  return heading;
}

void take_entries(RecordedRun& run, const LogMarks& marks) {
  run.variables = marks.entries;
  run.is_number.assign(marks.entries.size(), false);
  run.has_entries = true;
}

Phase phase_of(LogStatus answer) {
  switch (answer) {
    case LogStatus::Success:
      return Phase::Success;
    case LogStatus::Failure:
      return Phase::Failure;
    case LogStatus::Running:
      return Phase::Running;
    case LogStatus::Idle:
    case LogStatus::Skipped:
      break;
  }
  return Phase::Skipped;
}

const char* word_of(LogStatus answer) {
  switch (answer) {
    case LogStatus::Success:
      return "success";
    case LogStatus::Failure:
      return "failure";
    case LogStatus::Running:
      return "running";
    case LogStatus::Idle:
    case LogStatus::Skipped:
      break;
  }
  return "skipped";
}

LogPlayer::LogPlayer(const BehaviorLog& log, const LogReading& reading,
                     TickWays ways)
    : log_(log),
      reading_(reading),
      has_all_ways_(ways == TickWays::All && !is_own(log) && !log.marks),
      ticks_(log, reading) {
  heading_.ticks = "root";
  const std::string tree = log.tree.empty() ? "tree" : log.tree;
  heading_.nodes.push_back({"", "BehaviorTree", tree, 0, 0, std::nullopt});
  std::vector<bool> has_children(log.nodes.size() + 1, false);
  is_silent_.push_back(false);
  for (const LogNode& node : log.nodes) {
    const std::size_t above = node.parent ? number_of(*node.parent) : 0;
    has_children[above] = true;
    if (above == 0) {
      ++tops_;
      top_ = heading_.nodes.size();
    }
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
  if (!log.marks) return;
  take_entries(heading_, *log.marks);
  state_.values.assign(log.marks->entries.size(), "unset");
}

std::size_t LogPlayer::number_of(std::uint16_t uid) const {
  return static_cast<std::size_t>(log_.find(uid) - log_.nodes.data()) + 1;
}

Unseen LogPlayer::unseen(std::size_t node) const {
  if (log_.marks) return Unseen::Nothing;
  if (is_silent_[node]) return Unseen::Anything;
  if (node == 0) {
    if (!is_root_known_) return Unseen::Anything;
    return is_status_known_ ? Unseen::Nothing : Unseen::Status;
  }
  const std::string& here = state_.locations[node];
  if (here != "start_" && here != "called") return Unseen::Nothing;
  if (maybe_halted_ == node) return Unseen::Halted;
  if (status_[node] == LogStatus::Running) return Unseen::Running;
  if (here == "called" && has_all_ways_ && !reading_.tick_gap) {
    return Unseen::Called;
  }
  if (here == "called" && status_[node] == LogStatus::Idle) {
    return Unseen::Skipped;
  }
  const bool is_kept = !is_own(log_) && is_completed(status_[node]);
  return is_kept ? Unseen::Repeated : Unseen::Nothing;
}

void LogPlayer::play(const std::function<bool()>& see) {
  if (log_.marks ? play_marks(see) : play_on(log_.transitions, see)) {
    play_end(see);
  }
}

bool LogPlayer::play_on(std::span<const LogTransition> records,
                        const std::function<bool()>& see) {
  see_ = &see;
  if (!has_begun_ && !see()) return false;
  has_begun_ = true;
  for (const LogTransition& record : records) {
    const bool goes_on = !has_all_ways_
                             ? begin_tick(ticks_.tick_at(record.time))
                         : reading_.tick_gap ? part_at_gap(record.time)
                                             : part_before(record);
    if (!goes_on) return false;
    place_ = {played_++, record.time};
    if (!read(record)) return false;
    const std::size_t node = number_of(record.uid);
    const bool is_end = heading_.nodes[node].parent == 0 && tops_ == 1 &&
                        is_completed(record.after) && !is_leaf_[node];
    if (has_all_ways_ && !reading_.tick_gap && is_end && !is_over_ &&
        !end_for_good()) {
      return false;
    }
  }
  return true;
}

// --- All ways ----------------------------------------------------------------

bool LogPlayer::pass_time() {
  state_.mover.reset();
  state_.event.clear();
  state_.step = "time passes";
  ++state_.time;
  return (*see_)();
}

// A pause that parts two ticks, as somebody says who knows; how many have been
// in it, without a record, is known where the time of one is.
bool LogPlayer::part_at_gap(std::int64_t time) {
  const int before = state_.tick;
  if (!begin_tick(ticks_.tick_at(time))) return false;
  const bool is_counted =
      before == 0 || before == state_.tick || reading_.is_time_said;
  return is_counted || may_part(true);
}

// Ticks may have ended and begun before any record.
bool LogPlayer::part_before(const LogTransition& record) {
  if (state_.tick == 0) {
    begin_ = record.time;
    return may_part(false) && enter_tick(1);
  }
  if (is_over_) return part_at_end(record);
  const bool is_answer =
      record.after != LogStatus::Running && record.after != LogStatus::Idle;
  const bool is_its_answer = is_answer && taken_up_ == number_of(record.uid);
  return (is_its_answer || settle()) && may_part(true);
}

// The tick is over: what is no reset of a node is of a later one.
bool LogPlayer::part_at_end(const LogTransition& record) {
  const bool is_counted = reading_.is_time_said && !has_answered_;
  if (!is_counted && !may_part(false)) return false;
  if (record.after == LogStatus::Idle) {
    is_time_open_ |= record.before == LogStatus::Running;
    return true;
  }
  std::int64_t passed = std::exchange(is_time_open_, false) ? 0 : 1;
  if (is_counted) {
    const std::int64_t half = reading_.tick_time / 2;
    passed = std::clamp((record.time - begin_ + half) / reading_.tick_time,
                        passed, kMostUnits);
  }
  for (; passed > 0; --passed) {
    if (!pass_time()) return false;
  }
  begin_ = record.time;
  return enter_tick(std::int64_t{state_.tick} + 1);
}

// An answer of the top node would have left a record, unless it is the one it
// had; then it may have been skipped as well. Nobody knows which of several.
bool LogPlayer::is_answer_known() const {
  return tops_ == 1 &&
         (is_completed(outcome_[top_]) || !is_completed(status_[top_]));
}

// The states of a tick that ends here, if one is under way, of time that
// passes, and of one that begins; none of that need be so.
bool LogPlayer::may_part(bool is_in_tick) {
  const RecordedState before = state_;
  const auto taken_up = taken_up_;
  const auto called = called_;
  const auto outcome = outcome_;
  const bool is_over = is_over_;
  is_possible_ = true;
  is_status_known_ = false;
  is_root_known_ = is_answer_known();
  const auto tell = [&] {
    if (is_in_tick) {
      return settle() && end_tick() && pass_time() && enter_tick(state_.tick);
    }
    const bool is_first = state_.tick == 0;
    return (is_first || pass_time()) && enter_tick(state_.tick) && end_tick() &&
           (!is_first || pass_time());
  };
  const bool goes_on = tell();
  const int time = state_.time;
  state_ = before;
  state_.time = time;
  taken_up_ = taken_up;
  called_ = called;
  outcome_ = outcome;
  is_over_ = is_over;
  is_possible_ = false;
  is_root_known_ = true;
  return goes_on;
}

bool LogPlayer::has_ended() const {
  return is_over_ || state_.locations[0] == "success" ||
         state_.locations[0] == "failure";
}

// Whether the last tick is over is known only where the tree has ended in it.
bool LogPlayer::play_end(const std::function<bool()>& see) {
  see_ = &see;
  return log_.marks || is_over_ || !is_completed(answer_of_tick()) ||
         end_tick();
}

bool LogPlayer::end_here(const std::function<bool()>& see) {
  see_ = &see;
  return settle() && (is_over_ || end_for_good());
}

bool LogPlayer::end_for_good() {
  is_over_ = is_status_known_ = true;
  const LogStatus answer = answer_of_tick();
  has_answered_ = is_completed(answer);
  is_root_known_ = !has_all_ways_ || is_answer_known();
  const bool goes_on =
      end_tick() && (!has_answered_ || rest(0, phase_of(answer)));
  is_root_known_ = true;
  return goes_on;
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
  const std::int64_t passed = state_.tick == 0 ? tick - 1 : tick - state_.tick;
  state_.mover.reset();
  state_.event.clear();
  state_.step = "time passes";
  for (std::int64_t i = std::min(passed, kMostUnits); i > 0; --i) {
    ++state_.time;
    if (!(*see_)()) return false;
  }
  return enter_tick(tick);
}

bool LogPlayer::enter_tick(std::int64_t tick) {
  is_over_ = false;
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

// The tree answers what its top node has. Where that has no record, it is
// RUNNING, or it was skipped.
LogStatus LogPlayer::answer_of_tick() const {
  LogStatus answer = LogStatus::Running;
  if (has_all_ways_ && status_[top_] != LogStatus::Running) {
    answer = is_completed(status_[top_]) ? status_[top_] : LogStatus::Skipped;
  }
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
  state_.statuses[0] = word_of(answer);
  return reach(0, word_of(answer), phase_of(answer)) &&
         (is_completed(answer) || rest(0, phase_of(answer)));
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
  const auto ended = std::stable_partition(
      called_.begin(), called_.end(),
      [&](std::size_t n) { return n == node || !is_below(n, node); });
  const std::vector<std::size_t> below(ended, called_.end());
  called_.erase(ended, called_.end());
  return std::ranges::all_of(below, [&](std::size_t n) {
    // A leaf that tells no answer, such as a CoroActionNode, and runs.
    if (log_.marks && is_leaf_[n] && status_[n] == LogStatus::Running) {
      return reach(n, "running", Phase::Running) && rest(n, Phase::Running);
    }
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
