// SPDX-License-Identifier: MIT
//
// The messages that Groot2 and the Groot2Publisher of BehaviorTree.CPP 4
// exchange, as bytes (include/behaviortree_cpp/loggers/groot2_protocol.h of
// 4.10). A request is answered by one reply, both of several parts; the first
// has the kind of the request and a number that comes back. Every number has
// the least significant byte first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trace/logs/behavior_log.hpp"

namespace btcheck::groot2 {

inline constexpr std::uint8_t kProtocol = 2;
inline constexpr std::uint16_t kDefaultPort = 1667;

// Where a robot's publisher listens.
struct Address {
  std::string host;  // an IPv6 address in brackets
  std::uint16_t port = kDefaultPort;

  // "robot:1667"
  std::string text() const;

  friend bool operator==(const Address&, const Address&) = default;
};

// "groot2://robot:1667", the port may be left out; or why it is none.
struct ReadAddress {
  std::optional<Address> address;
  std::string flaw;
};
ReadAddress address_in(std::string_view text);

enum class Request : char {
  Tree = 'T',         // its XML
  Statuses = 'S',     // of all nodes
  Entries = 'B',      // of blackboards, by the names of their trees
  Record = 'r',       // "start" or "stop"
  Changes = 't',      // of statuses, since the last time
  InsertHook = 'I',   // the last three: JSON
  RemoveHook = 'R',   //
  UnlockHook = 'U',   //
  BreakReached = 'N'  // this comes unasked
};

using Parts = std::vector<std::string>;

// The first part of a request.
std::string request_head(Request kind, std::uint32_t number);

// A new one each time that the program starts.
using TreeId = std::array<char, 16>;

// What a reply to that request says.
struct Reply {
  enum class Kind : std::uint8_t {
    Good,
    Refused,  // by the server: `text` says why
    Foreign   // not of this protocol: `text` says what is wrong
  };
  Kind kind = Kind::Good;
  TreeId tree{};
  std::string text;  // the payload; "" where there is none
};
Reply reply_in(const Parts& parts, Request kind, std::uint32_t number);

// The status of a node, as the server has it.
struct NodeStatus {
  std::uint16_t uid = 0;
  LogStatus status = LogStatus::Idle;
};

// Both say what is wrong in `flaw`, else "".
struct StatusesRead {
  std::vector<NodeStatus> statuses;
  std::string flaw;
};
StatusesRead statuses_in(std::string_view payload);

// The server keeps this many changes, and drops older ones.
inline constexpr std::size_t kMostKept = 1000;

// A change as it is told: what the status was before is not.
struct Change {
  std::int64_t time = 0;  // microseconds since the recording began
  std::uint16_t uid = 0;
  LogStatus after = LogStatus::Idle;
};
struct ChangesRead {
  std::vector<Change> changes;
  std::string flaw;
};
ChangesRead changes_in(std::string_view payload);

// --- Hooks -------------------------------------------------------------------

// What is to happen where a node is about to be ticked.
struct Hook {
  std::uint16_t uid = 0;
  bool is_break = false;  // it waits there; else it answers instead of the node
  bool is_once = false;
  LogStatus answer = LogStatus::Success;  // that of a node that is replaced
};
std::string insert_text(const Hook& hook);
std::string remove_text(std::uint16_t uid);
// The node is ticked as ever from there.
std::string unlock_text(std::uint16_t uid);

// The node that a message of the publisher is about.
std::optional<std::uint16_t> reached_in(const Parts& parts);

}  // namespace btcheck::groot2
