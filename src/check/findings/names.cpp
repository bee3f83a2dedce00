// SPDX-License-Identifier: MIT
#include "check/findings/names.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "text/utf8.hpp"

namespace btcheck {
namespace {

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

constexpr std::array kAsking = {Word("check"),    Word("is"),    Word("has"),
                                Word("have"),     Word("are"),   Word("can"),
                                Word("validate"), Word("test"),  Word("was"),
                                Word("should"),   Word("verify")};

constexpr std::array kLooking = {
    Word("read"),     Word("get"),      Word("update"),    Word("detect"),
    Word("listen"),   Word("measure"),  Word("sense"),     Word("look"),
    Word("monitor"),  Word("query"),    Word("receive"),   Word("observe"),
    Word("find"),     Word("estimate"), Word("locate"),    Word("localize"),
    Word("compute"),  Word("calc"),     Word("calculate"), Word("select"),
    Word("log"),      Word("print"),    Word("debug"),     Word("watch"),
    Word("truncate"), Word("decide"),   Word("choose"),    Word("wait"),
    Word("poll"),     Word("fetch"),    Word("load"),      Word("subscribe")};

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

std::vector<std::string> words_in(std::string_view name) {
  std::vector<std::string> words;
  const auto is_upper = [](char c) { return c >= 'A' && c <= 'Z'; };
  bool begins = true;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!is_letter(c) || c == '_') {
      begins = true;
      continue;
    }
    const bool is_first_upper =
        is_upper(c) && i > 0 &&
        (!is_upper(name[i - 1]) ||
         (i + 1 < name.size() && !is_upper(name[i + 1]) &&
          is_letter(name[i + 1]) && name[i + 1] != '_'));
    if (begins || is_first_upper) words.emplace_back();
    words.back() += lowered(c);
    begins = false;
  }
  return words;
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

bool sounds_like_condition(std::string_view name) {
  const std::vector<std::string> words = words_in(name);
  return !words.empty() && is_among(kAsking, words.front());
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
