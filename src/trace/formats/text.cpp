// SPDX-License-Identifier: MIT
//
// Time orders the text: a heading for each unit of it, under it the events of
// that instant in the order in which they happen, and the loop marked where it
// begins and where it closes.
#include "trace/formats/text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "trace/run/event.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kChosenColumn = 62;
constexpr std::size_t kMostShown = 400;  // steps; longer texts are cut

class Teller {
 public:
  Teller(std::string_view ticks, const TextStyle& style)
      : unit_(ticks == tick_name(TickSemantics::Root) ? "tick" : "time"),
        style_(style) {}

  void pass_time() {
    ++time_;
    is_new_time_ = true;
  }

  void line(std::string_view text, std::string_view note = {}) {
    std::string heading;
    if (is_new_time_) {
      heading = time_ > 0 ? fmt::format("{} {}", unit_, time_) : "start";
    }
    is_new_time_ = false;
    std::string line = fmt::format("{}{:<8} {}", style_.indent, heading, text);
    if (!note.empty()) {
      line.resize(std::max(line.size() + 1, kChosenColumn), ' ');
      line += note;
    }
    text_ += line + '\n';
  }

  void mark(std::string_view text) {
    text_ += fmt::format("{}-- {}\n", style_.indent, text);
    is_new_time_ = true;
  }

  std::string take() { return std::move(text_); }

 private:
  std::string_view unit_;
  const TextStyle& style_;
  std::string text_;
  int time_ = 0;
  bool is_new_time_ = true;
};

// A step of the run: to its next state, or back to where the loop begins.
struct ToldStep {
  const std::string& step;
  const std::string& event;
  bool is_chosen = false;
  int elapsed = 0;
};

std::size_t step_count(const RecordedRun& run) {
  return run.states.size() - (run.loop == kNoState ? 1 : 0);
}

ToldStep step_from(const RecordedRun& run, std::size_t i) {
  if (i + 1 == run.states.size()) {
    return {run.back, run.back_event, run.back_is_chosen, run.back_elapsed};
  }
  const RecordedState& next = run.states[i + 1];
  return {next.step, next.event, next.is_chosen,
          next.time - run.states[i].time};
}

// What happens for ever in a loop in which nothing is told.
std::string_view silent_loop(const RecordedRun& run) {
  for (std::size_t i = run.loop; i < step_count(run); ++i) {
    if (step_from(run, i).step != kTimePasses) return "this repeats for ever";
  }
  return "the run stays here for ever while time passes";
}

}  // namespace

std::string run_text(const RecordedRun& run, const TextStyle& style) {
  Teller teller(run.ticks, style);
  std::size_t told = 0;
  for (std::size_t i = 0; i < step_count(run); ++i) {
    if (style.trigger_state == i) teller.line("-- " + style.trigger_words);
    if (run.loop == i) teller.mark("the loop begins");
    const ToldStep step = step_from(run, i);
    if (step.elapsed > 0) teller.pass_time();
    const bool is_silent = step.event.empty();
    if (is_silent && style.detail == Detail::Events) continue;
    if (told++ >= kMostShown) continue;
    teller.line(is_silent ? step.step : step.event,
                step.is_chosen ? "chosen" : "");
  }
  if (told > kMostShown) {
    teller.mark(fmt::format("{} more steps", told - kMostShown));
  }
  if (style.trigger_state == step_count(run)) {
    teller.line("-- " + style.trigger_words);
  }
  if (run.loop != kNoState) teller.mark(silent_loop(run));
  return teller.take();
}

std::string run_text(const BehaviorTree& tree, const Network& network,
                     const Run& run, const TextStyle& style) {
  return run_text(recorded(tree, network, run, {}), style);
}

}  // namespace btcheck
