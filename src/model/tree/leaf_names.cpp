// SPDX-License-Identifier: MIT
#include "model/tree/leaf_names.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "text/utf8.hpp"

namespace btcheck {
namespace {

using Words = std::vector<std::string>;

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }

// "isBatteryOK2", "ISOCheck": a word begins at a capital behind a small letter,
// at one before a small letter, and at a digit.
bool begins_word(std::string_view id, std::size_t at) {
  const char before = id[at - 1];
  if (is_digit(id[at])) return !is_digit(before);
  if (!is_upper(id[at])) return is_digit(before);
  const bool is_capitalised = at + 1 < id.size() && is_lower(id[at + 1]);
  return !is_upper(before) || is_capitalised;
}

// In small letters.
Words words_of(std::string_view id) {
  Words words(1);
  for (std::size_t at = 0; at < id.size(); ++at) {
    if (!is_letter(id[at]) && !is_digit(id[at])) {
      words.emplace_back();
      continue;
    }
    if (at > 0 && begins_word(id, at)) words.emplace_back();
    words.back() += lowered(id[at]);
  }
  std::erase(words, "");
  return words;
}

template <std::size_t N>
bool is_one_of(const std::array<std::string_view, N>& words,
               std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

bool begins_question(std::string_view word) {
  constexpr std::array<std::string_view, 17> kQuestions = {
      "is",   "are", "has",  "have", "can",   "should", "needs",  "was", "were",
      "does", "did", "will", "must", "would", "check",  "verify", "any"};
  return is_one_of(kQuestions, word);
}

// "SetEnabled", "WaitUntilReady" and "CheckAndStandUp" do something.
bool tells_to_act(const Words& words) {
  constexpr std::array<std::string_view, 16> kVerbs = {
      "set",   "wait", "make",   "get",    "clear",   "reset", "mark", "keep",
      "until", "and",  "ensure", "report", "publish", "move",  "go",   "then"};
  return std::ranges::any_of(
      words, [&](const std::string& word) { return is_one_of(kVerbs, word); });
}

bool tells_state(std::string_view word) {
  constexpr std::array<std::string_view, 38> kStates = {
      "ok",       "okay",     "low",      "high",      "reached",  "available",
      "enabled",  "disabled", "valid",    "invalid",   "present",  "missing",
      "detected", "expired",  "open",     "opened",    "closed",   "ready",
      "visible",  "known",    "unknown",  "empty",     "full",     "found",
      "received", "updated",  "required", "requested", "charged",  "free",
      "blocked",  "occupied", "active",   "connected", "finished", "done",
      "reliable", "check"};
  return is_one_of(kStates, word);
}

bool compares(std::string_view word) {
  constexpr std::array<std::string_view, 4> kComparisons = {
      "below", "above", "within", "exceeds"};
  return is_one_of(kComparisons, word);
}

}  // namespace

bool sounds_like_condition(std::string_view id) {
  const Words words = words_of(id);
  if (words.size() < 2 || tells_to_act(words)) return false;
  return begins_question(words.front()) || tells_state(words.back()) ||
         std::ranges::any_of(words, compares);
}

}  // namespace btcheck
