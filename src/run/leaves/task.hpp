// SPDX-License-Identifier: MIT
//
// A function on a thread of its own, called again and again, each time told to
// stop by a std::stop_token.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "run/engine/leaves.hpp"

namespace btcheck {

// What a function is called with. It lives as long as the call.
struct TaskCall {
  std::span<const GivenArgument> arguments;
  int tick = 0;
};

// What a call has come to: its value, or what it has thrown.
struct TaskResult {
  int value = 0;
  std::optional<std::string> thrown = {};
  bool is_wrong_value = false;  // thrown: a WrongValue
};

// Thrown for a value that a leaf of this kind cannot give.
class WrongValue : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What `work` has come to.
template <class Work>
TaskResult result_of(const Work& work) {
  try {
    return {work()};
  } catch (const WrongValue& wrong) {
    return {0, wrong.what(), true};
  } catch (const std::exception& thrown) {
    return {0, thrown.what()};
  } catch (...) {
    return {0, "something that is no std::exception"};
  }
}

// All but the function is called by one thread, and allocates nothing. A call
// that was stopped and does not return delays the next one.
class Task {
 public:
  using Work = std::function<int(const TaskCall&, const std::stop_token&)>;

  // `arguments`: how many a call has. std::system_error where the system has no
  // thread for it.
  Task(Work work, std::size_t arguments, std::chrono::milliseconds patience);
  ~Task();
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  // Calls the function; at once, or when a call that was stopped has returned.
  void start(const TaskCall& call);
  // The result of the call that was started last, once: nothing where it has
  // not returned within that time.
  std::optional<TaskResult> result(std::chrono::milliseconds within);
  // Its result is of no interest any more.
  void stop();
  // A call is under way.
  bool is_busy() const;
  // Waits until none is, but no longer than that.
  void wait_until(std::chrono::steady_clock::time_point until) const;
  // Stops it for good. False where the function has not returned with patience:
  // then it must not be destroyed, nor what the function uses.
  bool end();

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
  std::chrono::milliseconds patience_;
  std::thread thread_;
};

}  // namespace btcheck
