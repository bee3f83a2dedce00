// SPDX-License-Identifier: MIT
#include "model/btcpp/expand/spelling.hpp"

#include <algorithm>
#include <utility>

namespace btcheck::btcpp {
namespace {

constexpr std::size_t kShortest = 5;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// How many bytes two names have in common from their beginning.
std::size_t common_beginning(std::string_view left, std::string_view right) {
  const std::size_t end = std::min(left.size(), right.size());
  std::size_t length = 0;
  while (length < end && left[length] == right[length]) ++length;
  return length;
}

// `left` is not the shorter one, and they part at `at`.
bool is_mended_at(std::string_view left, std::string_view right,
                  std::size_t at) {
  const std::string_view rest = left.substr(at);
  const std::string_view other = right.substr(at);
  if (left.size() > right.size()) {
    return !is_digit(rest[0]) && rest.substr(1) == other &&
           !(rest == "s" && other.empty());
  }
  const bool is_swapped = rest.size() > 1 && rest[0] == other[1] &&
                          rest[1] == other[0] &&
                          rest.substr(2) == other.substr(2);
  const bool is_replaced = rest.substr(1) == other.substr(1) &&
                           !is_digit(rest[0]) && !is_digit(other[0]);
  return is_swapped || is_replaced;
}

}  // namespace

std::string folded_name(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (c == '_' || c == '-') continue;
    letters += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return letters;
}

bool is_one_slip(std::string_view left, std::string_view right) {
  if (left.size() < right.size()) std::swap(left, right);
  if (right.size() < kShortest || left.size() > right.size() + 1) return false;
  const std::size_t at = common_beginning(left, right);
  return at < left.size() && is_mended_at(left, right, at);
}

}  // namespace btcheck::btcpp
