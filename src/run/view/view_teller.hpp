// SPDX-License-Identifier: MIT
//
// Shows a run of an engine while it goes on.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "check/bind/verdict.hpp"
#include "check/replay/replay.hpp"
#include "explore/state/step.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "run/engine/tree_engine.hpp"
#include "trace/live/live_run.hpp"
#include "trace/run/record.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

struct TreeInput;

// The run as it begins: its first state, and `how` it is made.
RecordedRun beginning_of_run(const BehaviorTree& tree, const Network& network,
                             const TreeInput& input, const std::string& how);

// A step costs the engine what RunRecorder's do: eight bytes are kept. A thread
// takes them, executes them again and makes the states; it is never waited for.
// Where an engine is so much faster that `most_steps` have come together, the
// view ends there.
class ViewTeller : public EngineObserver {
 public:
  // `run` is what beginning_of_run gives. All must outlive it.
  ViewTeller(const BehaviorTree& tree, const Network& network, LiveRun& run,
             std::size_t most_steps = kMostSteps);
  ~ViewTeller() override;
  ViewTeller(const ViewTeller&) = delete;
  ViewTeller& operator=(const ViewTeller&) = delete;

  void stepped(StateView, const Step& step) override;

  // The run is over, in these words. What cannot be shown within `patience` is
  // left out, and said to be.
  void finish(const std::string& words, std::chrono::milliseconds patience);

 private:
  static constexpr std::size_t kMostSteps = std::size_t{1} << 22;

  void follow();
  std::string show(const std::vector<Step>& steps);

  LiveRun& run_;
  const std::size_t most_steps_;

  std::mutex mutex_;  // of these
  std::vector<Step> steps_;
  bool is_left_behind_ = false;

  std::atomic<bool> is_over_ = false;
  std::atomic<std::chrono::steady_clock::time_point> until_;
  std::string words_;  // once it is over

  // Of the thread.
  NetworkInterpreter interpreter_;
  StateRecorder recorder_;
  Valuation state_;
  std::thread thread_;
};

}  // namespace btcheck
