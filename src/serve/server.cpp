// SPDX-License-Identifier: MIT
#include "serve/server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <utility>

#include "cli/inputs/process_limits.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostWaiting = 1000;
constexpr auto kLookInterval = std::chrono::milliseconds(100);
constexpr double kTellInterval = 0.5;  // seconds

// The result, or why there is none.
std::string answer_text(const RpcMessage& message, const MethodRow& method,
                        Work& work) {
  try {
    std::string result;
    if (!work.is_cancelled()) result = method.answer(message.params, work);
    if (work.is_out_of_memory()) {
      throw RpcError(rpc::kOutOfMemory,
                     "the process holds more than --memory allows");
    }
    if (work.is_cancelled()) throw RpcError(rpc::kCancelled, "cancelled");
    return result_text(message.id, result);
  } catch (const RpcError& fault) {
    return error_text(message.id, fault);
  } catch (const std::invalid_argument& fault) {
    return error_text(message.id, {rpc::kInvalidParams, fault.what()});
  } catch (const std::bad_alloc&) {
    return error_text(message.id, {rpc::kOutOfMemory, "out of memory"});
  } catch (const std::exception& fault) {
    return error_text(message.id, {rpc::kInternalError, fault.what()});
  }
}

}  // namespace

bool Work::goes_on(const v1::Progress& progress) {
  if (limits_of_command().overdrawn() == Spent::Memory) {
    is_out_of_memory_ = true;
  }
  if (is_cancelled_ || is_out_of_memory_) return false;
  const std::unique_lock lock(telling_, std::try_to_lock);
  if (token_.empty() || !lock || progress.seconds < next_) return true;
  next_ = progress.seconds + kTellInterval;
  return wire_.send(progress_text_(token_, progress));
}

bool Server::run() {
  std::vector<std::jthread> threads;
  for (unsigned i = 0; i < thread_count_; ++i) {
    threads.emplace_back([this, i] { work(i > 0); });
  }
  try {
    for (bool goes_on = true; goes_on;) {
      const auto received = wire_.next();
      goes_on = received && take(*received);
    }
  } catch (...) {
    drain();
    throw;
  }
  if (!wire_.fault().empty()) {
    wire_.send(error_text("", {rpc::kParseError, wire_.fault()}));
  }
  drain();
  return wire_.fault().empty();
}

// What was asked for is answered, as long as somebody listens.
void Server::drain() {
  std::unique_lock lock(mutex_);
  // Who has told of what is not asked for has no use for it any more.
  if (is_ended_ && !protocol_.notices.empty()) {
    for (const auto& [id, work] : at_work_) work->cancel();
  }
  while (!at_work_.empty() || !waiting_.empty()) {
    changed_.wait_for(lock, kLookInterval);
    if (wire_.is_heard()) continue;
    for (const auto& [id, work] : at_work_) work->cancel();
  }
  is_over_ = true;
  changed_.notify_all();
}

bool Server::take(const Wire::Received& received) {
  std::string id;
  try {
    if (!received.refused.empty()) {
      throw RpcError(rpc::kInvalidRequest, received.refused);
    }
    RpcMessage message = read_message(received.text, id);
    if (message.is_answer) return true;
    if (!message.id.empty()) {
      begin(std::move(message));
    } else if (message.method == protocol_.cancel) {
      cancel(message.params);
    } else if (message.method == protocol_.end) {
      is_ended_ = true;
      return false;
    } else {
      take_notice(std::move(message));
    }
    return true;
  } catch (const RpcError& fault) {
    return wire_.send(error_text(id, fault));
  } catch (const std::bad_alloc&) {
    return wire_.send(error_text(id, {rpc::kOutOfMemory, "out of memory"}));
  }
}

void Server::begin(RpcMessage message) {
  const auto method =
      std::ranges::find(protocol_.methods, message.method, &MethodRow::name);
  if (method == protocol_.methods.end()) {
    throw RpcError(
        rpc::kMethodNotFound,
        fmt::format("there is no method `{}`", message.method.substr(0, 80)));
  }
  auto work =
      std::make_shared<Work>(wire_, message.id, protocol_.progress_text);
  Job job{std::move(message), &*method, nullptr, std::move(work), 0};
  if (!method->is_long) {
    wire_.send(answer_to(job));
    return;
  }
  const std::scoped_lock lock(mutex_);
  if (waiting_.size() >= kMostWaiting) {
    throw RpcError(rpc::kOverload,
                   fmt::format("{} requests wait already", kMostWaiting));
  }
  if (!at_work_.emplace(job.message.id, job.work).second) {
    throw RpcError(rpc::kInvalidRequest,
                   "a request with this `id` is not answered yet");
  }
  put(std::move(job));
}

// One that nobody knows is passed over. However many wait, none is lost: what
// is told later rests on it.
void Server::take_notice(RpcMessage message) {
  const auto notice =
      std::ranges::find(protocol_.notices, message.method, &NoticeRow::name);
  if (notice == protocol_.notices.end()) return;
  const std::scoped_lock lock(mutex_);
  put({std::move(message), nullptr, &*notice, nullptr, 0});
}

void Server::put(Job job) {
  job.number = ++count_;
  waiting_.push_back(std::move(job));
  changed_.notify_all();
}

// Whoever cancels what is unknown, or answered, or cancelled, came too late.
void Server::cancel(const JsonValue& params) {
  const JsonValue* id = params.member(protocol_.cancel_id);
  if (id == nullptr) return;
  const std::string text =
      id->is(JsonValue::Kind::Text) ? Json(id->text).text() : id->text;
  Job job;
  {
    const std::scoped_lock lock(mutex_);
    const auto found = at_work_.find(text);
    if (found == at_work_.end()) return;
    found->second->cancel();
    const auto waits = std::ranges::find(
        waiting_, text, [](const Job& each) { return each.message.id; });
    if (waits == waiting_.end()) return;
    job = std::move(*waits);
    waiting_.erase(waits);
    at_work_.erase(found);
  }
  // It need not wait for its turn.
  const std::string answer = answer_to(job);
  if (!answer.empty()) wire_.send(answer);
}

std::string Server::answer_to(const Job& job) const {
  if (job.notice != nullptr) {
    try {
      job.notice->take(job.message.params);
    } catch (const std::exception&) {
      // There is nobody to tell: a notification has no answer.
    }
    return {};
  }
  const std::string text = answer_text(job.message, *job.method, *job.work);
  return job.work->is_cancelled() && !protocol_.answers_cancelled
             ? std::string()
             : text;
}

// The first that waits for a thread of this kind.
std::deque<Server::Job>::iterator Server::next_job(bool is_aside) {
  if (protocol_.notices.empty()) return waiting_.begin();
  const auto is_aside_job = [](const Job& job) {
    return job.method != nullptr && job.method->is_aside;
  };
  const auto next = std::ranges::find_if(
      waiting_, [&](const Job& job) { return is_aside_job(job) == is_aside; });
  if (!is_aside || next == waiting_.end()) return next;
  // What came before it has been done.
  const bool is_early = in_turn_ < next->number ||
                        !std::all_of(waiting_.begin(), next, is_aside_job);
  return is_early ? waiting_.end() : next;
}

void Server::work(bool is_aside) {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(
        lock, [&] { return is_over_ || next_job(is_aside) != waiting_.end(); });
    const auto next = next_job(is_aside);
    if (next == waiting_.end()) return;
    const Job job = std::move(*next);
    waiting_.erase(next);
    if (!is_aside) in_turn_ = job.number;
    lock.unlock();
    const std::string text = answer_to(job);
    lock.lock();
    // Nothing of it is left when its answer is read: its id may be used again.
    if (job.method != nullptr) at_work_.erase(job.message.id);
    lock.unlock();
    if (!text.empty()) wire_.send(text);
    lock.lock();
    if (!is_aside) in_turn_ = UINT64_MAX;
    changed_.notify_all();
  }
}

}  // namespace btcheck
