// SPDX-License-Identifier: MIT
#include "cli/options/interface.hpp"

#include <charconv>

namespace btcheck {

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t number = 0;
  const char* end = text.data() + text.size();
  const auto [at, fault] = std::from_chars(text.data(), end, number);
  if (fault != std::errc() || at != end) return std::nullopt;
  return number;
}

std::optional<Shard> shard_of(std::string_view text) {
  constexpr unsigned kMostShards = 10'000;
  const std::size_t stroke = text.find('/');
  if (stroke == text.npos) return std::nullopt;
  const auto index = whole_number(text.substr(0, stroke));
  const auto count = whole_number(text.substr(stroke + 1));
  if (!index || !count || *index < 1 || *index > *count ||
      *count > kMostShards) {
    return std::nullopt;
  }
  return Shard{static_cast<unsigned>(*index), static_cast<unsigned>(*count)};
}

}  // namespace btcheck
