// SPDX-License-Identifier: MIT
#include "serve/wire.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "text/diagnostic.hpp"
#include "text/numbers.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostHeader = 8192;
constexpr std::string_view kLength = "Content-Length";

std::string too_large() {
  return fmt::format("a message has at most {} MiB", Wire::kMostBytes >> 20);
}

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

}  // namespace

bool Wire::fill() {
  const ssize_t count = in_.read(block_);
  at_ = 0;
  end_ = count > 0 ? static_cast<std::size_t>(count) : 0;
  return end_ > 0;
}

std::optional<std::string> Wire::line(std::size_t most, bool& is_cut) {
  std::string text;
  is_cut = false;
  for (;;) {
    if (at_ == end_ && !fill()) {
      return text.empty() && !is_cut ? std::nullopt : std::optional(text);
    }
    const char* begin = block_.data() + at_;
    const void* found = std::memchr(begin, '\n', end_ - at_);
    const std::size_t count =
        found == nullptr ? end_ - at_ : static_cast<const char*>(found) - begin;
    const std::size_t kept = std::min(count, most - text.size());
    text.append(begin, kept);
    is_cut = is_cut || kept < count;
    at_ += count;
    if (found == nullptr) continue;
    ++at_;
    if (!text.empty() && text.back() == '\r') text.pop_back();
    return text;
  }
}

bool Wire::bytes(std::size_t count, std::string* to) {
  while (count > 0) {
    if (at_ == end_ && !fill()) return false;
    const std::size_t some = std::min(count, end_ - at_);
    if (to != nullptr) to->append(block_.data() + at_, some);
    at_ += some;
    count -= some;
  }
  return true;
}

std::optional<Wire::Received> Wire::next_line() {
  for (;;) {
    bool is_cut = false;
    auto text = line(kMostBytes, is_cut);
    if (!text) return std::nullopt;
    if (is_cut) return Received{{}, too_large()};
    if (!trimmed(*text).empty()) return Received{std::move(*text), {}};
  }
}

std::optional<Wire::Received> Wire::next_framed() {
  std::optional<std::size_t> length;
  for (bool has_any = false;;) {
    bool is_cut = false;
    const auto header = line(kMostHeader, is_cut);
    if (!header) {
      if (has_any) fault_ = "the input ends within the header of a message";
      return std::nullopt;
    }
    if (header->empty() && has_any) break;
    if (header->empty()) continue;
    has_any = true;
    const std::string_view all = *header;
    const std::size_t colon = all.find(':');
    if (is_cut || colon == all.npos) {
      fault_ = "a message begins with a line `Content-Length: NUMBER`";
      return std::nullopt;
    }
    if (!equal_ignoring_case(all.substr(0, colon), kLength)) continue;
    length = as_number<std::size_t>(trimmed(all.substr(colon + 1)));
  }
  if (!length) {
    fault_ = "a message without a `Content-Length` that is a number";
    return std::nullopt;
  }
  const bool is_kept = *length <= kMostBytes;
  Received received;
  if (!bytes(*length, is_kept ? &received.text : nullptr)) {
    fault_ = "the input ends within a message";
    return std::nullopt;
  }
  if (!is_kept) received.refused = too_large();
  return received;
}

std::optional<Wire::Received> Wire::next() {
  return framing_ == Framing::Lines ? next_line() : next_framed();
}

bool Wire::send(const std::string& text) {
  const std::scoped_lock lock(sending_);
  if (is_closed_) return false;
  const bool is_sent = framing_ == Framing::Lines
                           ? out_.write(text + '\n')
                           : out_.write(fmt::format("{}: {}\r\n\r\n{}", kLength,
                                                    text.size(), text));
  is_closed_ = !is_sent;
  return is_sent;
}

bool Wire::is_heard() const {
  pollfd out{out_.number(), 0, 0};
  return ::poll(&out, 1, 0) <= 0 ||
         (out.revents & (POLLERR | POLLHUP | POLLNVAL)) == 0;
}

}  // namespace btcheck
