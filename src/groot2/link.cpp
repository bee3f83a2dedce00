// SPDX-License-Identifier: MIT
#include "groot2/link.hpp"

#include <fmt/format.h>
#include <zmq.h>

#include <algorithm>
#include <cerrno>
#include <random>
#include <system_error>
#include <utility>

namespace btcheck::groot2 {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook{50};  // whether it is over
// A reply has two; more are not waited for.
constexpr std::size_t kMostParts = 4;
constexpr std::int64_t kMostTold = 65'536;  // bytes of a message unasked
constexpr int kMostHeard = 1000;            // of those that mean nothing

[[noreturn]] void fail(const char* what) {
  throw std::system_error(::zmq_errno(), std::generic_category(), what);
}

void set(void* socket, int option, int value) {
  ::zmq_setsockopt(socket, option, &value, sizeof(value));
}

void* opened(void* context, int type, const std::string& place,
             std::int64_t most_bytes) {
  void* socket = ::zmq_socket(context, type);
  if (socket == nullptr) fail("a socket of ZeroMQ");
  set(socket, ZMQ_LINGER, 0);
  set(socket, ZMQ_IMMEDIATE, 1);
  set(socket, ZMQ_RECONNECT_IVL, 50);
  set(socket, ZMQ_RECONNECT_IVL_MAX, 1000);
  set(socket, ZMQ_CONNECT_TIMEOUT, 2000);
  set(socket, ZMQ_HANDSHAKE_IVL, 2000);
  if (place.find('[') != std::string::npos) set(socket, ZMQ_IPV6, 1);
  ::zmq_setsockopt(socket, ZMQ_MAXMSGSIZE, &most_bytes, sizeof(most_bytes));
  if (::zmq_connect(socket, place.c_str()) != 0) {
    ::zmq_close(socket);
    return nullptr;
  }
  return socket;
}

std::string place_of(const std::string& host, unsigned port) {
  return fmt::format("tcp://{}:{}", host, port);
}

// A message as it is there; nothing where there is none, or too many parts.
std::optional<Parts> received(void* socket) {
  Parts parts;
  for (int more = 1; more != 0;) {
    zmq_msg_t message;
    ::zmq_msg_init(&message);
    const int size = ::zmq_msg_recv(&message, socket, ZMQ_DONTWAIT);
    if (size < 0) {
      ::zmq_msg_close(&message);
      return std::nullopt;
    }
    if (parts.size() < kMostParts) {
      parts.emplace_back(static_cast<const char*>(::zmq_msg_data(&message)),
                         static_cast<std::size_t>(size));
    }
    more = ::zmq_msg_more(&message);
    ::zmq_msg_close(&message);
  }
  return parts;
}

}  // namespace

Context::Context() : context_(::zmq_ctx_new()) {
  if (context_ == nullptr) fail("ZeroMQ");
}

Context::~Context() { ::zmq_ctx_term(context_); }

Link::Link(Context& context, const Address& address,
           std::function<bool()> is_over)
    : context_(context),
      place_(place_of(address.host, address.port)),
      is_over_(std::move(is_over)),
      number_(std::random_device()()) {}

Link::~Link() { close(); }

bool Link::open() {
  if (socket_ == nullptr) {
    socket_ = opened(context_.context_, ZMQ_REQ, place_, kMostBytes);
  }
  return socket_ != nullptr;
}

void Link::close() {
  if (socket_ != nullptr) ::zmq_close(std::exchange(socket_, nullptr));
}

bool Link::wait(Direction direction, Clock::time_point until) const {
  const bool is_out = direction == Direction::Out;
  while (!is_over_()) {
    const auto rest = std::chrono::duration_cast<std::chrono::milliseconds>(
        until - Clock::now());
    zmq_pollitem_t item{
        socket_, 0, static_cast<short>(is_out ? ZMQ_POLLOUT : ZMQ_POLLIN), 0};
    const auto pause = std::clamp(rest, std::chrono::milliseconds(0), kLook);
    if (::zmq_poll(&item, 1, static_cast<long>(pause.count())) > 0) return true;
    if (rest.count() <= 0) return false;
  }
  return false;
}

// A request without its reply: the next one goes through a socket of its own.
Answer Link::failed(Answer::Kind kind, std::string text) {
  close();
  return {is_over_() ? Answer::Kind::Over : kind, {}, std::move(text)};
}

Answer Link::ask(Request kind, std::chrono::milliseconds patience,
                 std::optional<std::string_view> argument) {
  const Clock::time_point until = Clock::now() + patience;
  if (!open()) {
    return failed(Answer::Kind::Foreign,
                  fmt::format("{} is no address: {}", place_,
                              ::zmq_strerror(::zmq_errno())));
  }
  if (!wait(Direction::Out, until)) {  // it goes on trying
    return {is_over_() ? Answer::Kind::Over : Answer::Kind::Absent, {}, ""};
  }
  const std::string head = request_head(kind, ++number_);
  const int more = argument ? ZMQ_SNDMORE : 0;
  if (::zmq_send(socket_, head.data(), head.size(), ZMQ_DONTWAIT | more) < 0 ||
      (argument && ::zmq_send(socket_, argument->data(), argument->size(),
                              ZMQ_DONTWAIT) < 0)) {
    return failed(Answer::Kind::Absent);
  }
  if (!wait(Direction::In, until)) return failed(Answer::Kind::Silent);
  const auto parts = received(socket_);
  if (!parts) return failed(Answer::Kind::Silent);
  Reply reply = reply_in(*parts, kind, number_);
  if (reply.kind == Reply::Kind::Foreign) {
    return failed(Answer::Kind::Foreign, std::move(reply.text));
  }
  return {reply.kind == Reply::Kind::Good ? Answer::Kind::Good
                                          : Answer::Kind::Refused,
          reply.tree, std::move(reply.text)};
}

Ear::Ear(Context& context, const Address& address)
    : socket_(opened(context.context_, ZMQ_SUB,
                     place_of(address.host, address.port + 1u), kMostTold)) {
  if (socket_ != nullptr) ::zmq_setsockopt(socket_, ZMQ_SUBSCRIBE, "", 0);
}

Ear::~Ear() {
  if (socket_ != nullptr) ::zmq_close(socket_);
}

std::optional<std::uint16_t> Ear::hear() {
  for (int i = 0; socket_ != nullptr && i < kMostHeard; ++i) {
    const auto parts = received(socket_);
    if (!parts) return std::nullopt;
    if (const auto uid = reached_in(*parts)) return uid;
  }
  return std::nullopt;
}

}  // namespace btcheck::groot2
