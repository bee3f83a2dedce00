// SPDX-License-Identifier: MIT
#include "run/view/view_teller.hpp"

#include <exception>
#include <utility>

#include "run/record/recorder.hpp"

namespace btcheck {
namespace {

using Clock = std::chrono::steady_clock;

// Between two looks for steps: shorter than what an eye notices.
constexpr std::chrono::milliseconds kLook{25};
// So many states are told at once.
constexpr std::size_t kPiece = 1000;

}  // namespace

RecordedRun beginning_of_run(const BehaviorTree& tree, const Network& network,
                             const TreeInput& input, const std::string& how) {
  RunWords words = run_words(how);
  add_sources(words, tree, input);
  RecordedRun run = recorded_heading(tree, network, words);
  run.states.push_back(StateRecorder(tree, network)
                           .begin(NetworkInterpreter(network).initial()));
  return run;
}

ViewTeller::ViewTeller(const BehaviorTree& tree, const Network& network,
                       LiveRun& run, std::size_t most_steps)
    : run_(run),
      most_steps_(most_steps),
      until_(Clock::time_point::max()),
      interpreter_(network),
      recorder_(tree, network),
      state_(interpreter_.initial()),
      thread_([this] {
        try {
          follow();
        } catch (const std::exception& fault) {
          // The run goes on, whatever becomes of its view.
          run_.end(fault.what());
        }
      }) {}

ViewTeller::~ViewTeller() { finish("", std::chrono::milliseconds(0)); }

void ViewTeller::stepped(StateView, const Step& step) {
  const std::lock_guard lock(mutex_);
  if (is_left_behind_) return;
  if (steps_.size() < most_steps_) {
    steps_.push_back(step);
  } else {
    is_left_behind_ = true;
  }
}

void ViewTeller::finish(const std::string& words,
                        std::chrono::milliseconds patience) {
  if (!thread_.joinable()) return;
  words_ = words;
  until_ = Clock::now() + patience;
  is_over_ = true;
  thread_.join();
}

void ViewTeller::follow() {
  std::vector<Step> steps;
  for (;;) {
    const bool was_over = is_over_;
    bool was_left_behind = false;
    {
      const std::lock_guard lock(mutex_);
      std::swap(steps, steps_);
      was_left_behind = is_left_behind_;
    }
    const std::string flaw = show(steps);
    if (!flaw.empty()) return run_.end(flaw);
    if (was_left_behind) {
      return run_.end("the run goes on faster than it can be shown");
    }
    if (was_over) return run_.end(words_);
    steps.clear();
    std::this_thread::sleep_for(kLook);
  }
}

// Why the view ends before all of them are shown; "" where it does not.
std::string ViewTeller::show(const std::vector<Step>& steps) {
  std::vector<RecordedState> states;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    auto after = interpreter_.taken(state_, steps[i]);
    if (!after) return "a step cannot be executed again";
    const RunStep step{steps[i], std::move(*after)};
    states.push_back(recorder_.take(state_, step));
    state_ = step.after;
    const bool is_last = i + 1 == steps.size();
    if (states.size() < kPiece && !is_last) continue;
    run_.add(states);
    states.clear();
    if (!is_last && Clock::now() >= until_.load()) {
      return words_ + "; its last steps came too fast to be shown";
    }
  }
  return "";
}

}  // namespace btcheck
