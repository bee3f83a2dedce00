// SPDX-License-Identifier: MIT
//
// What a Groot2Publisher does, as far as its messages show it; and whatever
// else a test would have it say. It listens on two ports of this machine.
#pragma once

#include <zmq.h>

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "groot2/wire.hpp"
#include "trace/run/little_endian.hpp"

namespace btcheck {

// Sequence(a, b) as WriteTreeToXML writes it.
inline constexpr std::string_view kFakeTree =
    "<root BTCPP_format=\"4\">\n"
    "  <BehaviorTree ID=\"Fake\" _fullpath=\"\">\n"
    "    <Sequence name=\"Sequence\" _uid=\"1\">\n"
    "      <a name=\"a\" _uid=\"2\"/>\n"
    "      <b name=\"b\" _uid=\"3\"/>\n"
    "    </Sequence>\n"
    "  </BehaviorTree>\n"
    "</root>\n";

class FakePublisher {
 public:
  using Parts = groot2::Parts;
  // Instead of the usual reply, of which the first part is given; nothing: the
  // usual one. No parts: silence.
  using Answer = std::function<std::optional<Parts>(const Parts& request,
                                                    const std::string& head)>;

  explicit FakePublisher(std::uint16_t port = 0, Answer answer = {})
      : answer_(std::move(answer)), context_(zmq_ctx_new()) {
    for (std::uint16_t place = port == 0 ? 21667 : port;; place += 2) {
      replies_ = opened(ZMQ_ROUTER, place);
      news_ = replies_ == nullptr
                  ? nullptr
                  : opened(ZMQ_PUB, static_cast<std::uint16_t>(place + 1));
      if (news_ != nullptr) {
        port_ = place;
        break;
      }
      if (replies_ != nullptr) zmq_close(replies_);
      if (port != 0) {  // it is being given back
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        place = static_cast<std::uint16_t>(place - 2);
      }
    }
    static std::atomic<char> count = 0;  // each is another one
    id_[0] = ++count;
    thread_ = std::thread([this] { serve(); });
  }
  ~FakePublisher() {
    is_over_ = true;
    thread_.join();
    zmq_close(replies_);
    zmq_close(news_);
    zmq_ctx_term(context_);
  }
  FakePublisher(const FakePublisher&) = delete;
  FakePublisher& operator=(const FakePublisher&) = delete;

  groot2::Address address() const { return {"127.0.0.1", port_}; }
  std::uint16_t port() const { return port_; }

  // A node changes its status.
  void set(std::uint16_t uid, LogStatus status) {
    const std::lock_guard lock(mutex_);
    const LogStatus before = std::exchange(statuses_[uid], status);
    shown_[uid] = static_cast<char>(status == LogStatus::Idle
                                        ? 10 + static_cast<int>(before)
                                        : static_cast<int>(status));
    if (!is_recording_) return;
    time_ += 100;
    std::string record;
    append_number(record, static_cast<std::uint64_t>(time_), 6);
    append_number(record, uid, 2);
    record += static_cast<char>(status);
    changes_.push_back(record);
    while (changes_.size() > groot2::kMostKept) changes_.pop_front();
  }
  // Time passes until the next change.
  void wait(std::int64_t microseconds) {
    const std::lock_guard lock(mutex_);
    time_ += microseconds;
  }
  // Somebody else takes the changes.
  void forget_changes() {
    const std::lock_guard lock(mutex_);
    changes_.clear();
  }
  void set_tree(std::string xml) {
    const std::lock_guard lock(mutex_);
    xml_ = std::move(xml);
  }
  void set_entries(std::string packed) {
    const std::lock_guard lock(mutex_);
    entries_ = std::move(packed);
  }
  // A hook is reached.
  void reach(std::uint16_t uid) {
    const std::lock_guard lock(mutex_);
    reached_.push_back(uid);
  }

  bool is_recording() const { return is_recording_; }
  std::size_t requests(char kind) {
    const std::lock_guard lock(mutex_);
    return asked_[kind];
  }
  // Texts of the hooks that are there, by kind of request.
  std::vector<std::string> told(char kind) {
    const std::lock_guard lock(mutex_);
    return told_[kind];
  }
  // Of a request; the reply of the server itself.
  Parts usual(const Parts& request) {
    const std::lock_guard lock(mutex_);
    return reply_to(request);
  }
  std::string head_for(const Parts& request) const {
    return request[0] + std::string(id_.begin(), id_.end());
  }

 private:
  void* opened(int type, std::uint16_t port) {
    void* socket = zmq_socket(context_, type);
    const int none = 0;
    zmq_setsockopt(socket, ZMQ_LINGER, &none, sizeof(none));
    const std::string place = "tcp://127.0.0.1:" + std::to_string(port);
    if (zmq_bind(socket, place.c_str()) == 0) return socket;
    zmq_close(socket);
    return nullptr;
  }

  static Parts received(void* socket) {
    Parts parts;
    int more = 1;
    while (more != 0) {
      zmq_msg_t message;
      zmq_msg_init(&message);
      if (zmq_msg_recv(&message, socket, 0) < 0) return {};
      parts.emplace_back(static_cast<const char*>(zmq_msg_data(&message)),
                         zmq_msg_size(&message));
      more = zmq_msg_more(&message);
      zmq_msg_close(&message);
    }
    return parts;
  }

  static void send(void* socket, const Parts& parts) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      zmq_send(socket, parts[i].data(), parts[i].size(),
               i + 1 < parts.size() ? ZMQ_SNDMORE : 0);
    }
  }

  // A ROUTER has two parts more: who asks, and an empty one.
  void serve() {
    while (!is_over_) {
      {
        const std::lock_guard lock(mutex_);
        for (const std::uint16_t uid : std::exchange(reached_, {})) {
          send(news_, {groot2::request_head(groot2::Request::BreakReached, 7),
                       std::to_string(uid)});
        }
      }
      zmq_pollitem_t item{replies_, 0, ZMQ_POLLIN, 0};
      if (zmq_poll(&item, 1, 5) <= 0) continue;
      Parts parts = received(replies_);
      if (parts.size() < 3) continue;
      Parts reply(parts.begin(), parts.begin() + 2);
      parts.erase(parts.begin(), parts.begin() + 2);
      std::optional<Parts> said;
      if (answer_) said = answer_(parts, head_for(parts));
      if (!said) said = usual(parts);
      if (said->empty()) continue;
      reply.insert(reply.end(), said->begin(), said->end());
      send(replies_, reply);
    }
  }

  Parts reply_to(const Parts& request) {
    if (request[0].size() != 6) return {"error", "wrong request header"};
    const char kind = request[0][1];
    ++asked_[kind];
    if (request.size() > 1) told_[kind].push_back(request[1]);
    const std::string head = head_for(request);
    switch (kind) {
      case 'T':
        return {head, xml_};
      case 'S': {
        std::string all;
        for (const auto& [uid, status] : shown_) {
          append_number(all, uid, 2);
          all += status;
        }
        return {head, all};
      }
      case 'B':
        return {head, entries_};
      case 'r':
        if (request.at(1) == "start") {
          is_recording_ = true;
          changes_.clear();
          time_ = 0;
          return {head, "1700000000000000"};
        }
        is_recording_ = false;
        return {head};
      case 't': {
        std::string all;
        for (const std::string& change : changes_) all += change;
        changes_.clear();
        return {head, all};
      }
      case 'I':
      case 'R':
      case 'U':
        return {head};
      default:
        return {"error", "Request not recognized"};
    }
  }

  const Answer answer_;
  void* context_;
  void* replies_ = nullptr;
  void* news_ = nullptr;
  std::uint16_t port_ = 0;
  groot2::TreeId id_{};
  std::atomic<bool> is_over_ = false;
  std::atomic<bool> is_recording_ = false;
  std::thread thread_;

  std::mutex mutex_;
  std::string xml_{kFakeTree};
  std::string entries_ = "\xC0";
  std::map<std::uint16_t, LogStatus> statuses_;
  std::map<std::uint16_t, char> shown_;
  std::deque<std::string> changes_;
  std::vector<std::uint16_t> reached_;
  std::map<char, std::size_t> asked_;
  std::map<char, std::vector<std::string>> told_;
  std::int64_t time_ = 0;
};

}  // namespace btcheck
