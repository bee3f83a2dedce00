// SPDX-License-Identifier: MIT
#include "model/tree/leaf_names.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>
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

using Word = std::string_view;

constexpr Word kQuestions[] = {
    "is",   "are", "has",  "have", "can",   "should", "needs",  "was", "were",
    "does", "did", "will", "must", "would", "check",  "verify", "any"};

// "SetEnabled", "WaitUntilReady" and "CheckAndStandUp" do something.
constexpr Word kVerbs[] = {
    "set",   "wait", "make",   "get",    "clear",   "reset", "mark", "keep",
    "until", "and",  "ensure", "report", "publish", "move",  "go",   "then"};

constexpr Word kStates[] = {
    "ok",       "okay",     "low",      "high",      "reached",  "available",
    "enabled",  "disabled", "valid",    "invalid",   "present",  "missing",
    "detected", "expired",  "open",     "opened",    "closed",   "ready",
    "visible",  "known",    "unknown",  "empty",     "full",     "found",
    "received", "updated",  "required", "requested", "charged",  "free",
    "blocked",  "occupied", "active",   "connected", "finished", "done",
    "reliable", "check"};

constexpr Word kComparisons[] = {"below", "above", "within", "exceeds"};

constexpr Word kGood[] = {
    "ok",      "okay",      "safe",      "clear",      "healthy", "valid",
    "alive",   "connected", "enough",    "good",       "normal",  "stable",
    "enabled", "within",    "below",     "above",      "under",   "seen",
    "visible", "present",   "required",  "nominal",    "fine",    "secure",
    "tracked", "localized", "calm",      "sufficient", "allowed", "permitted",
    "fixed",   "charged",   "reachable", "held",       "inside",  "intact"};

constexpr Word kBad[] = {
    "low",      "critical", "obstacle", "blocked",  "collision",  "bumped",
    "fault",    "faulty",   "error",    "failed",   "lost",       "emergency",
    "estop",    "abort",    "aborted",  "hot",      "stuck",      "danger",
    "alarm",    "attacked", "hit",      "unsafe",   "depleted",   "weak",
    "jammed",   "leak",     "leaking",  "smoke",    "fire",       "cancelled",
    "canceled", "storm",    "loose",    "slipping", "overheated", "intruder",
    "human",    "person",   "violated", "exceeded", "tilted",     "flooded",
    "broken",   "windy"};

constexpr Word kNo[] = {"not", "no", "non", "never", "isnt"};

constexpr Word kLooking[] = {
    "read",      "get",      "update",  "detect",   "listen",  "measure",
    "sense",     "look",     "monitor", "query",    "receive", "observe",
    "find",      "estimate", "locate",  "localize", "compute", "calc",
    "calculate", "select",   "log",     "print",    "debug",   "watch",
    "truncate",  "decide",   "choose",  "wait",     "poll",    "validate",
    "test",      "fetch",    "load",    "subscribe"};

constexpr Word kBeside[] = {
    "track", "monitor", "watch", "record",  "hold",   "keep",   "stream",
    "blink", "play",    "wait",  "sleep",   "timer",  "guard",  "timeout",
    "show",  "display", "scan",  "observe", "listen", "publish"};

// What is begun with one word is ended with the other.
constexpr std::array<std::pair<Word, Word>, 11> kPairs = {
    {{"start", "stop"},
     {"begin", "end"},
     {"open", "close"},
     {"on", "off"},
     {"enable", "disable"},
     {"arm", "disarm"},
     {"activate", "deactivate"},
     {"engage", "disengage"},
     {"acquire", "release"},
     {"lower", "raise"},
     {"pause", "resume"}}};

bool is_among(std::span<const Word> table, Word word) {
  return std::ranges::find(table, word) != table.end();
}

bool any_among(std::span<const Word> table, const Words& words) {
  return std::ranges::any_of(
      words, [&](const std::string& word) { return is_among(table, word); });
}

}  // namespace

std::vector<std::string> words_in(std::string_view id) {
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

bool sounds_like_condition(std::string_view id) {
  const Words words = words_in(id);
  if (words.size() < 2 || any_among(kVerbs, words)) return false;
  return is_among(kQuestions, words.front()) ||
         is_among(kStates, words.back()) || any_among(kComparisons, words);
}

Tidings tidings_of(std::string_view condition) {
  const Words words = words_in(condition);
  const bool is_turned = any_among(kNo, words);
  if (any_among(kBad, words)) return is_turned ? Tidings::Good : Tidings::Bad;
  if (any_among(kGood, words)) return is_turned ? Tidings::Bad : Tidings::Good;
  return Tidings::Neither;
}

bool only_looks(std::string_view name) {
  const Words words = words_in(name);
  return sounds_like_condition(name) ||
         (!words.empty() && is_among(kLooking, words.front()));
}

bool goes_on_beside(std::string_view name) {
  return any_among(kBeside, words_in(name));
}

std::vector<std::string> words_of_undoing(std::string_view name) {
  Words words = words_in(name);
  for (std::string& word : words) {
    for (const auto& [begun, ended] : kPairs) {
      if (word != begun) continue;
      word = ended;
      return words;
    }
  }
  return {};
}

}  // namespace btcheck
