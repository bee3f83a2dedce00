// SPDX-License-Identifier: MIT
//
// The connection to a publisher: one request at a time and its reply, and what
// is told unasked. ZeroMQ connects anew by itself, and as often as it takes.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "groot2/wire.hpp"

namespace btcheck::groot2 {

// What a publisher may make us keep at once: the XML of a tree of 65,535 nodes
// has a quarter of it.
inline constexpr std::int64_t kMostBytes = std::int64_t{64} << 20;

// The threads of ZeroMQ, which hear no signals. Must outlive its links.
class Context {
 public:
  // Throws std::exception where the system has no threads or files left.
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

 private:
  friend class Link;
  friend class Ear;
  void* context_;
};

struct Answer {
  enum class Kind : std::uint8_t {
    Good,
    Absent,   // nobody speaks ZeroMQ there
    Silent,   // somebody does, and has not answered in time
    Refused,  // by the server: `text` says why
    Foreign,  // not of the protocol: `text` says what is wrong
    Over      // nobody waits for it any more
  };
  Kind kind = Kind::Over;
  TreeId tree{};
  std::string text;
};

class Link {
 public:
  // `is_over` is asked twenty times a second while something is waited for.
  Link(Context& context, const Address& address, std::function<bool()> is_over);
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  Answer ask(Request kind, std::chrono::milliseconds patience,
             std::optional<std::string_view> argument = std::nullopt);

 private:
  enum class Direction : std::uint8_t { Out, In };

  bool open();
  void close();
  bool wait(Direction direction,
            std::chrono::steady_clock::time_point until) const;
  Answer failed(Answer::Kind kind, std::string text = {});

  Context& context_;
  std::string place_;
  std::function<bool()> is_over_;
  void* socket_ = nullptr;
  std::uint32_t number_ = 0;
};

// What the publisher of a robot tells: that a node with a hook is reached.
class Ear {
 public:
  Ear(Context& context, const Address& address);
  ~Ear();
  Ear(const Ear&) = delete;
  Ear& operator=(const Ear&) = delete;

  // The node of the next message, if there is one.
  std::optional<std::uint16_t> hear();

 private:
  void* socket_ = nullptr;
};

}  // namespace btcheck::groot2
