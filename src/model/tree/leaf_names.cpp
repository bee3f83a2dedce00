// SPDX-License-Identifier: MIT
#include "model/tree/leaf_names.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
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

using Word = std::string_view;

constexpr std::array kGood = {
    Word("ok"),        Word("okay"),      Word("safe"),    Word("clear"),
    Word("healthy"),   Word("valid"),     Word("alive"),   Word("connected"),
    Word("enough"),    Word("good"),      Word("normal"),  Word("stable"),
    Word("enabled"),   Word("within"),    Word("below"),   Word("above"),
    Word("under"),     Word("seen"),      Word("visible"), Word("present"),
    Word("required"),  Word("nominal"),   Word("fine"),    Word("secure"),
    Word("tracked"),   Word("localized"), Word("calm"),    Word("sufficient"),
    Word("allowed"),   Word("permitted"), Word("fixed"),   Word("charged"),
    Word("reachable"), Word("held"),      Word("inside"),  Word("intact")};

constexpr std::array kBad = {
    Word("low"),       Word("critical"),  Word("obstacle"),   Word("blocked"),
    Word("collision"), Word("bumped"),    Word("fault"),      Word("faulty"),
    Word("error"),     Word("failed"),    Word("lost"),       Word("emergency"),
    Word("estop"),     Word("abort"),     Word("aborted"),    Word("hot"),
    Word("stuck"),     Word("danger"),    Word("alarm"),      Word("attacked"),
    Word("hit"),       Word("unsafe"),    Word("depleted"),   Word("weak"),
    Word("jammed"),    Word("leak"),      Word("leaking"),    Word("smoke"),
    Word("fire"),      Word("cancelled"), Word("canceled"),   Word("storm"),
    Word("loose"),     Word("slipping"),  Word("overheated"), Word("intruder"),
    Word("human"),     Word("person"),    Word("violated"),   Word("exceeded"),
    Word("tilted"),    Word("flooded"),   Word("broken"),     Word("windy")};

constexpr std::array kNo = {Word("not"), Word("no"), Word("non"), Word("never"),
                            Word("isnt")};

constexpr std::array kLooking = {
    Word("read"),     Word("get"),      Word("update"),    Word("detect"),
    Word("listen"),   Word("measure"),  Word("sense"),     Word("look"),
    Word("monitor"),  Word("query"),    Word("receive"),   Word("observe"),
    Word("find"),     Word("estimate"), Word("locate"),    Word("localize"),
    Word("compute"),  Word("calc"),     Word("calculate"), Word("select"),
    Word("log"),      Word("print"),    Word("debug"),     Word("watch"),
    Word("truncate"), Word("decide"),   Word("choose"),    Word("wait"),
    Word("poll"),     Word("validate"), Word("test"),      Word("fetch"),
    Word("load"),     Word("subscribe")};

constexpr std::array kBeside = {
    Word("track"), Word("monitor"), Word("watch"),  Word("record"),
    Word("hold"),  Word("keep"),    Word("stream"), Word("blink"),
    Word("play"),  Word("wait"),    Word("sleep"),  Word("timer"),
    Word("guard"), Word("timeout"), Word("show"),   Word("display"),
    Word("scan"),  Word("observe"), Word("listen"), Word("publish")};

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

bool is_among(std::span<const Word> words, Word word) {
  return std::ranges::find(words, word) != words.end();
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
  if (words.size() < 2 || tells_to_act(words)) return false;
  return begins_question(words.front()) || tells_state(words.back()) ||
         std::ranges::any_of(words, compares);
}

Tidings tidings_of(std::string_view condition) {
  const std::vector<std::string> words = words_in(condition);
  const auto any_of = [&](std::span<const Word> those) {
    return std::ranges::any_of(
        words, [&](const std::string& word) { return is_among(those, word); });
  };
  const bool is_turned = any_of(kNo);
  if (any_of(kBad)) return is_turned ? Tidings::Good : Tidings::Bad;
  if (any_of(kGood)) return is_turned ? Tidings::Bad : Tidings::Good;
  return Tidings::Neither;
}

bool only_looks(std::string_view name) {
  const std::vector<std::string> words = words_in(name);
  return sounds_like_condition(name) ||
         (!words.empty() && is_among(kLooking, words.front()));
}

bool goes_on_beside(std::string_view name) {
  const std::vector<std::string> words = words_in(name);
  return std::ranges::any_of(
      words, [](const std::string& word) { return is_among(kBeside, word); });
}

std::vector<std::string> words_of_undoing(std::string_view name) {
  std::vector<std::string> words = words_in(name);
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
