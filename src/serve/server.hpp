// SPDX-License-Identifier: MIT
//
// Requests of JSON-RPC, several at a time.
//
// One thread reads. What takes long goes to threads that work one request each,
// in the order in which they came; everything else is answered at once. A
// request ends early where it is cancelled, where the process holds too much
// memory, and where nobody listens any more.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "btcheck/check.hpp"
#include "serve/message.hpp"
#include "serve/wire.hpp"

namespace btcheck {

// One request that is worked on: hears that it is cancelled, and tells how far
// it is.
class Work final : public v1::Monitor {
 public:
  // A notification that tells how far it is; `token` is JSON text.
  using ProgressText = std::string (*)(const std::string& token,
                                       const v1::Progress& progress);
  Work(Wire& wire, std::string id, ProgressText progress_text)
      : wire_(wire), id_(std::move(id)), progress_text_(progress_text) {}

  bool goes_on(const v1::Progress& progress) override;

  const std::string& id() const { return id_; }
  void tell_progress(std::string token) { token_ = std::move(token); }
  void cancel() { is_cancelled_ = true; }
  bool is_cancelled() const { return is_cancelled_; }
  bool is_out_of_memory() const { return is_out_of_memory_; }

 private:
  Wire& wire_;
  const std::string id_;
  const ProgressText progress_text_;
  std::string token_;  // "" where nobody asks
  std::mutex telling_;
  double next_ = 0.2;  // seconds, when progress is told
  std::atomic<bool> is_cancelled_ = false;
  std::atomic<bool> is_out_of_memory_ = false;
};

struct MethodRow {
  std::string_view name;
  // The result as JSON text. Throws RpcError, and what btcheck/check.hpp
  // throws.
  std::string (*answer)(const JsonValue& params, Work& work);
  bool is_long = false;
  // Of those that notices stand between: it waits for what others do, and its
  // turn is another's.
  bool is_aside = false;
};

// What is told and not answered.
struct NoticeRow {
  std::string_view name;
  void (*take)(const JsonValue& params);
};

// What two protocols call the same.
struct Protocol {
  std::span<const MethodRow> methods;
  Work::ProgressText progress_text;
  std::string_view cancel;     // "$/cancelRequest"
  std::string_view cancel_id;  // its member: "id"
  std::string_view end;        // a notification that ends it; "" for none
  bool answers_cancelled;      // with an error
  // Taken in their turn among the long methods, in the order in which all came:
  // where there are any, one thread does all but what is aside.
  std::span<const NoticeRow> notices = {};
};

class Server {
 public:
  Server(Wire& wire, const Protocol& protocol, unsigned threads)
      : wire_(wire), protocol_(protocol), thread_count_(threads) {}

  // Until the input ends, the other side says so, or it stops listening. False
  // where what came could not be understood any more.
  bool run();

 private:
  struct Job {
    RpcMessage message;
    const MethodRow* method = nullptr;  // null of a notice
    const NoticeRow* notice = nullptr;
    std::shared_ptr<Work> work;
    std::uint64_t number = 0;  // in the order in which they came
  };

  // False at the end.
  bool take(const Wire::Received& received);
  void begin(RpcMessage message);
  void take_notice(RpcMessage message);
  void put(Job job);
  void cancel(const JsonValue& params);
  std::string answer_to(const Job& job) const;
  void work(bool is_aside);
  std::deque<Job>::iterator next_job(bool is_aside);
  void drain();

  Wire& wire_;
  const Protocol& protocol_;
  const unsigned thread_count_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> waiting_;
  std::map<std::string, std::shared_ptr<Work>> at_work_;  // by id
  std::uint64_t count_ = 0;
  std::uint64_t in_turn_ = UINT64_MAX;  // that is worked on in its turn, if any
  bool is_over_ = false;
  bool is_ended_ = false;  // by the other side, which has said so
};

}  // namespace btcheck
