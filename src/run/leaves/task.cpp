// SPDX-License-Identifier: MIT
//
// The thread waits for a call to be wanted. Calls are counted, so that a result
// belongs to one; what a stopped call returns is dropped. The next
// std::stop_source is made by the thread, not by who starts.
#include "run/leaves/task.hpp"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <utility>

namespace btcheck {

struct Task::Shared {
  Work work;
  mutable std::mutex mutex;
  std::condition_variable changed;
  std::stop_source stop;
  std::vector<GivenArgument> next;   // of the call that is wanted
  std::vector<GivenArgument> given;  // of the one under way
  int tick = 0;
  std::uint64_t wanted = 0;  // the call that was started last; 0: none
  std::uint64_t begun = 0;
  std::uint64_t dropped = 0;  // calls up to this one are of no interest
  std::uint64_t ended = 0;
  TaskResult result;
  bool is_over = false;  // the thread is to end
  bool has_left = false;

  void serve() {
    std::unique_lock lock(mutex);
    while (true) {
      changed.wait(lock, [&] { return is_over || wanted > begun; });
      if (is_over) break;
      begun = wanted;
      if (begun > dropped) serve_call(lock);
      ended = begun;
      changed.notify_all();
    }
    has_left = true;
    changed.notify_all();
  }

  void serve_call(std::unique_lock<std::mutex>& lock) {
    std::swap(given, next);
    const TaskCall with{given, tick};
    const std::stop_token token = stop.get_token();
    lock.unlock();
    TaskResult found = result_of([&] { return work(with, token); });
    std::optional<std::stop_source> fresh;
    if (token.stop_requested()) fresh.emplace();
    lock.lock();
    // It may have been stopped just now.
    if (stop.stop_requested()) stop = fresh ? *fresh : std::stop_source();
    result = std::move(found);
  }
};

Task::Task(Work work, std::size_t arguments, std::chrono::milliseconds patience)
    : shared_(std::make_shared<Shared>()), patience_(patience) {
  shared_->work = std::move(work);
  shared_->next.resize(arguments);
  shared_->given.resize(arguments);
  thread_ = std::thread([shared = shared_] { shared->serve(); });
}

Task::~Task() {
  if (end()) {
    thread_.join();
  } else {
    thread_.detach();
  }
}

bool Task::end() {
  stop();
  std::unique_lock lock(shared_->mutex);
  shared_->is_over = true;
  shared_->changed.notify_all();
  return shared_->changed.wait_for(lock, patience_,
                                   [&] { return shared_->has_left; });
}

void Task::start(const TaskCall& call) {
  const std::lock_guard lock(shared_->mutex);
  std::copy(call.arguments.begin(), call.arguments.end(),
            shared_->next.begin());
  shared_->tick = call.tick;
  ++shared_->wanted;
  shared_->changed.notify_all();
}

std::optional<TaskResult> Task::result(std::chrono::milliseconds within) {
  std::unique_lock lock(shared_->mutex);
  const auto is_there = [&] { return shared_->ended == shared_->wanted; };
  if (!is_there() && (within.count() == 0 ||
                      !shared_->changed.wait_for(lock, within, is_there))) {
    return std::nullopt;
  }
  return std::move(shared_->result);
}

// Callbacks of the token run here, without the lock.
void Task::stop() {
  std::unique_lock lock(shared_->mutex);
  shared_->dropped = shared_->wanted;
  if (shared_->begun == shared_->ended) return;
  std::stop_source stop = shared_->stop;
  lock.unlock();
  stop.request_stop();
}

bool Task::is_busy() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->begun > shared_->ended;
}

void Task::wait_until(std::chrono::steady_clock::time_point until) const {
  std::unique_lock lock(shared_->mutex);
  shared_->changed.wait_until(lock, until,
                              [&] { return shared_->begun == shared_->ended; });
}

}  // namespace btcheck
