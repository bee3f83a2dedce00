// SPDX-License-Identifier: MIT
//
// Time orders the text: a heading for each unit of it, under it the events of
// that instant in the order in which they happen, and the loop marked where it
// begins and where it closes.
#include "trace/text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "trace/event.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kChosenColumn = 62;
constexpr std::size_t kMostShown = 400;  // steps; longer texts are cut

class Teller {
 public:
  Teller(const Network& network, const TextStyle& style)
      : unit_(network.ticks == TickSemantics::Root ? "tick" : "time"),
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

// What happens for ever in a loop in which nothing is told.
std::string_view silent_loop(const Run& run) {
  for (std::size_t i = run.loop; i < run.steps.size(); ++i) {
    if (run.steps[i].step.edge != kTimeStep) {
      return "this repeats for ever";
    }
  }
  return "the run stays here for ever while time passes";
}

}  // namespace

std::string run_text(const BehaviorTree& tree, const Network& network,
                     const Run& run, const TextStyle& style) {
  Teller teller(network, style);
  std::size_t told = 0;
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    if (style.trigger_state == i) teller.line("-- " + style.trigger_words);
    if (run.loop == i) teller.mark("the loop begins");
    const RunStep& step = run.steps[i];
    if (step.step.elapsed > 0) teller.pass_time();
    const auto event = event_of(tree, network, run.state(i), step);
    if (!event && style.detail == Detail::Events) continue;
    if (told++ >= kMostShown) continue;
    if (event) {
      teller.line(event->text, event->is_chosen ? "chosen" : "");
    } else {
      teller.line(step_text(network, step));
    }
  }
  if (told > kMostShown) {
    teller.mark(fmt::format("{} more steps", told - kMostShown));
  }
  if (style.trigger_state == run.steps.size()) {
    teller.line("-- " + style.trigger_words);
  }
  if (run.loop != kNoLoop) teller.mark(silent_loop(run));
  return teller.take();
}

}  // namespace btcheck
