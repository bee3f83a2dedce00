// SPDX-License-Identifier: MIT
#include "cli/options/batch_options.hpp"

#include <charconv>
#include <string_view>

namespace btcheck {
namespace {

constexpr unsigned kMostShards = 10'000;

std::optional<unsigned> number_in(std::string_view text) {
  unsigned number = 0;
  const char* end = text.data() + text.size();
  const auto [at, fault] = std::from_chars(text.data(), end, number);
  if (fault != std::errc() || at != end || number > kMostShards) return {};
  return number;
}

}  // namespace

std::optional<Shard> shard_of(const std::string& text) {
  const std::size_t stroke = text.find('/');
  if (stroke == text.npos) return std::nullopt;
  const auto index = number_in(std::string_view(text).substr(0, stroke));
  const auto count = number_in(std::string_view(text).substr(stroke + 1));
  if (!index || !count || *index < 1 || *index > *count) return std::nullopt;
  return Shard{*index, *count};
}

}  // namespace btcheck
