// SPDX-License-Identifier: MIT
#include "groot2/wire.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "text/json.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"
#include "trace/run/little_endian.hpp"

namespace btcheck::groot2 {
namespace {

constexpr std::size_t kRequestHead = 6;
constexpr std::size_t kStatusBytes = 3;
constexpr std::size_t kChangeBytes = 9;
constexpr int kIdleFrom = 10;  // and the status before
constexpr std::size_t kMostSaid = 300;

// What a stranger says, as one line that is not long.
std::string quoted(std::string_view text) {
  std::string line = valid_utf8(unbroken(text.substr(0, kMostSaid)));
  return text.size() > kMostSaid ? line + "…" : line;
}

std::optional<LogStatus> status_of(int number) {
  if (number < 0 || number > static_cast<int>(LogStatus::Skipped)) {
    return std::nullopt;
  }
  return static_cast<LogStatus>(number);
}

}  // namespace

std::string Address::text() const { return fmt::format("{}:{}", host, port); }

ReadAddress address_in(std::string_view text) {
  constexpr std::string_view kScheme = "groot2://";
  const auto refused = [](std::string why) {
    return ReadAddress{std::nullopt, std::move(why)};
  };
  if (!text.starts_with(kScheme)) {
    return refused("an address of a robot begins with `groot2://`");
  }
  text.remove_prefix(kScheme.size());
  if (text.ends_with('/')) text.remove_suffix(1);
  Address address;
  const std::size_t bracket = text.starts_with('[') ? text.find(']') : 0;
  if (bracket == std::string_view::npos) return refused("there is no `]`");
  const std::size_t colon = text.find(':', bracket);
  address.host = text.substr(0, colon);
  const bool is_name =
      !address.host.empty() && std::ranges::all_of(address.host, [](char c) {
        return is_letter(c) || is_digit(c) || c == '.' || c == '-' ||
               c == '_' || c == ':' || c == '[' || c == ']' || c == '%';
      });
  if (!is_name) return refused("it names no machine");
  if (colon == std::string_view::npos) return {address, ""};
  const auto port = as_number<std::uint16_t>(text.substr(colon + 1));
  // The next one is that of its publisher.
  if (!port || *port == 0 || *port == UINT16_MAX) {
    return refused(fmt::format("`{}` is no port", text.substr(colon + 1)));
  }
  address.port = *port;
  return {address, ""};
}

std::string request_head(Request kind, std::uint32_t number) {
  std::string head;
  append_number(head, kProtocol, 1);
  head += static_cast<char>(kind);
  append_number(head, number, 4);
  return head;
}

Reply reply_in(const Parts& parts, Request kind, std::uint32_t number) {
  const auto foreign = [](std::string what) {
    return Reply{Reply::Kind::Foreign, {}, std::move(what)};
  };
  if (parts.size() == 2 && parts[0] == "error") {
    return {Reply::Kind::Refused, {}, quoted(parts[1])};
  }
  TreeId tree{};
  if (parts.empty() || parts[0].size() != kRequestHead + tree.size()) {
    return foreign(fmt::format("a reply begins with {} bytes; {} are expected",
                               parts.empty() ? 0 : parts[0].size(),
                               kRequestHead + tree.size()));
  }
  if (const auto protocol = number_at(parts[0], 0, 1); protocol != kProtocol) {
    return foreign(
        fmt::format("it speaks version {} of the protocol; {} is "
                    "known",
                    protocol, int{kProtocol}));
  }
  if (!parts[0].starts_with(request_head(kind, number))) {
    return foreign("a reply is to another request than was sent");
  }
  if (parts.size() > 2) {
    return foreign(
        fmt::format("a reply has {} parts; 2 are expected", parts.size()));
  }
  std::ranges::copy(std::string_view(parts[0]).substr(kRequestHead),
                    tree.begin());
  return {Reply::Kind::Good, tree, parts.size() < 2 ? "" : parts[1]};
}

StatusesRead statuses_in(std::string_view payload) {
  StatusesRead read;
  if (payload.size() % kStatusBytes != 0) {
    read.flaw = fmt::format(
        "the statuses have {} bytes, which is no multiple "
        "of {}",
        payload.size(), kStatusBytes);
    return read;
  }
  for (std::size_t at = 0; at < payload.size(); at += kStatusBytes) {
    const auto uid = static_cast<std::uint16_t>(number_at(payload, at, 2));
    const auto number = static_cast<int>(number_at(payload, at + 2, 1));
    const auto status = status_of(number % kIdleFrom);
    if (!status || number >= 2 * kIdleFrom) {
      read.flaw = fmt::format("node {} has the status {}", uid, number);
      return read;
    }
    read.statuses.push_back(
        {uid, number >= kIdleFrom ? LogStatus::Idle : *status});
  }
  return read;
}

ChangesRead changes_in(std::string_view payload) {
  ChangesRead read;
  if (payload.size() % kChangeBytes != 0) {
    read.flaw = fmt::format(
        "the changes have {} bytes, which is no multiple "
        "of {}",
        payload.size(), kChangeBytes);
    return read;
  }
  if (payload.size() > kMostKept * kChangeBytes) {
    read.flaw = fmt::format("{} changes came at once; a publisher keeps {}",
                            payload.size() / kChangeBytes, kMostKept);
    return read;
  }
  constexpr std::uint64_t kEarlier = std::uint64_t{1} << 47;
  for (std::size_t at = 0; at < payload.size(); at += kChangeBytes) {
    const std::uint64_t time = number_at(payload, at, 6);
    const auto uid = static_cast<std::uint16_t>(number_at(payload, at + 6, 2));
    const auto number = static_cast<int>(number_at(payload, at + 8, 1));
    const auto status = status_of(number);
    if (!status) {
      read.flaw = fmt::format("node {} has got the status {}", uid, number);
      return read;
    }
    // What began just before the recording has a time below zero.
    read.changes.push_back(
        {time >= kEarlier ? 0 : static_cast<std::int64_t>(time), uid, *status});
  }
  return read;
}

// --- Hooks -------------------------------------------------------------------

std::string insert_text(const Hook& hook) {
  const auto answer = static_cast<std::size_t>(
      hook.is_break ? LogStatus::Skipped : hook.answer);
  return Json{{"enabled", true},
              {"uid", int{hook.uid}},
              {"mode", hook.is_break ? 0 : 1},
              {"once", hook.is_once},
              {"desired_status", kLogStatusNames[answer]},
              {"position", 0}}
      .text();
}

std::string remove_text(std::uint16_t uid) {
  return Json{{"uid", int{uid}}, {"position", 0}}.text();
}

std::string unlock_text(std::uint16_t uid) {
  return Json{{"uid", int{uid}},
              {"position", 0},
              {"desired_status", "SKIPPED"},
              {"remove_when_done", false}}
      .text();
}

std::optional<std::uint16_t> reached_in(const Parts& parts) {
  if (parts.size() != 2 || parts[0].size() != kRequestHead ||
      parts[0][1] != static_cast<char>(Request::BreakReached)) {
    return std::nullopt;
  }
  return as_number<std::uint16_t>(parts[1]);
}

}  // namespace btcheck::groot2
