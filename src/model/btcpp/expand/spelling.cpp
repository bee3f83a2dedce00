// SPDX-License-Identifier: MIT
//
// Which names of entries are likely to be meant for one another.
#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "model/btcpp/expand/checks.hpp"
#include "text/diagnostic.hpp"
#include "text/utf8.hpp"

namespace btcheck::btcpp {
namespace {

constexpr std::size_t kShortest = 5;

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

std::vector<std::string_view> words_of(std::string_view name) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at <= name.size();) {
    const std::size_t end = std::min(name.find('_', at), name.size());
    words.push_back(name.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

std::string digits_of(std::string_view name) {
  std::string digits;
  std::ranges::copy_if(name, std::back_inserter(digits), is_digit);
  return digits;
}

// min_x and max_x, pos_x and pos_y, leg_1 and leg_2.
bool are_told_apart(std::string_view left, std::string_view right) {
  if (digits_of(left) != digits_of(right)) return true;
  const auto ours = words_of(left);
  const auto theirs = words_of(right);
  if (ours.size() != theirs.size()) return false;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    if (ours[i] == theirs[i]) continue;
    if (ours[i].size() > 3 || theirs[i].size() > 3) return false;
  }
  return true;
}

}  // namespace

std::string folded_name(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (c == '_' || c == '-') continue;
    letters += lowered(c);
  }
  return letters;
}

bool is_one_slip(std::string_view left, std::string_view right) {
  if (left.size() < right.size()) std::swap(left, right);
  if (right.size() < kShortest || left.size() > right.size() + 1) return false;
  const std::size_t at = common_beginning(left, right);
  return at < left.size() && is_mended_at(left, right, at);
}

bool is_similar(std::string_view left, std::string_view right) {
  if (left.size() < right.size()) std::swap(left, right);
  if (right.size() < 4 || are_told_apart(left, right)) return false;
  if (left.starts_with(right) || left.ends_with(right)) return true;
  return edit_distance(left, right) <= (right.size() < 6 ? 1U : 2U);
}

}  // namespace btcheck::btcpp
