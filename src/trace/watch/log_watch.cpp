// SPDX-License-Identifier: MIT
#include "trace/watch/log_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace btcheck {
namespace {

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

Result<std::unique_ptr<LogWatch>> LogWatch::make(
    const RecordedRun& names, const BehaviorLog& log, const LogReading& reading,
    const PropertyFile& rules, const SourceText& source, TickWays ways) {
  if (auto refused = unordered(log, source)) {
    return {std::nullopt, {std::move(*refused)}};
  }
  RecordedRun run = names;
  const bool is_marked = log.marks.has_value();
  if (is_marked) take_entries(run, *log.marks);
  auto watch = RecordedWatch::make(
      run, is_marked ? Recording::MarkedLog : Recording::Log, rules, source);
  Result<std::unique_ptr<LogWatch>> result{std::nullopt,
                                           std::move(watch.diagnostics)};
  if (!watch.value) return result;
  std::unique_ptr<LogWatch> made(new LogWatch(log, reading, ways));
  made->watch_ = std::move(*watch.value);
  made->moments_.resize(made->rules().size());
  result.value = std::move(made);
  return result;
}

bool LogWatch::show(const RecordedState& state, const See& see) {
  watch_->see(
      state, [&](std::size_t n) { return player_.unseen(n); },
      player_.is_possible());
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    const auto& at = rules()[i].decided;
    if (at && *at + 1 == watch_->states()) {
      moments_[i] = {player_.place(), state.tick};
    }
  }
  return !see || player_.is_possible() || see(state);
}

void LogWatch::play_on(std::span<const LogTransition> records, const See& see) {
  const auto each = [&] { return show(player_.state(), see); };
  goes_on_ = goes_on_ && player_.play_on(records, each);
}

void LogWatch::play_marks(const See& see) {
  const auto each = [&] { return show(player_.state(), see); };
  goes_on_ = goes_on_ && player_.play_marks(each);
}

void LogWatch::play(const See& see) {
  if (log_.marks) {
    play_marks(see);
  } else {
    play_on(log_.transitions, see);
  }
  play_end(see);
}

void LogWatch::play_end(const See& see) {
  const auto each = [&] { return show(player_.state(), see); };
  goes_on_ = goes_on_ && player_.play_end(each);
  if (!goes_on_ || log_.marks || !player_.has_ended()) return;
  RecordedState later = player_.state();
  ++later.time;
  later.mover.reset();
  later.event.clear();
  later.step = "time passes";
  show(later, see);
}

bool LogWatch::is_guessed(std::size_t rule) const {
  const RecordedWatch::Seen& seen = rules()[rule];
  return seen.has_ways && seen.run.is_torn();
}

}  // namespace btcheck
