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
    "fixed",   "charged",   "reachable", "held",       "inside",  "intact",
    "free",    "closed",    "locked",    "latched",    "sealed",  "upright",
    "steady",  "online",    "link",      "signal",     "gps",     "coverage"};

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

constexpr Word kTelling[] = {
    "log",  "report",   "notify", "warn",  "say",    "speak",  "print",
    "tell", "announce", "alert",  "debug", "note",   "record", "display",
    "show", "beep",     "blink",  "play",  "inform", "message"};

// What the next step may well need: the drain closed before the barrel is
// filled.
constexpr Word kPreparing[] = {
    "close", "open",    "lock",    "unlock", "grasp",     "grip",     "grab",
    "pick",  "latch",   "secure",  "fasten", "strap",     "clamp",    "fix",
    "arm",   "fold",    "stow",    "insert", "calibrate", "connect",  "mount",
    "dock",  "undock",  "couple",  "engage", "brake",     "anchor",   "seal",
    "shut",  "tighten", "fill",    "load",   "inflate",   "align",    "lower",
    "raise", "extend",  "retract", "attach", "detach",    "localize", "home"};

// True for a moment, and over.
constexpr Word kMoments[] = {"attacked",   "hit",    "pressed", "clicked",
                             "touched",    "tapped", "bumped",  "triggered",
                             "received",   "pushed", "knocked", "called",
                             "interrupted"};

constexpr Word kSending[] = {"pub",  "publish", "send",
                             "post", "set",     "command"};

constexpr Word kAtLeast[] = {"min", "minimum", "least", "above"};
constexpr Word kAtMost[] = {"max", "maximum", "most", "below"};

constexpr Word kBeside[] = {
    "track", "monitor", "watch", "record",  "hold",   "keep",   "stream",
    "blink", "play",    "wait",  "sleep",   "timer",  "guard",  "timeout",
    "show",  "display", "scan",  "observe", "listen", "publish"};

// What is begun with one word is ended with the other.
constexpr std::array<std::pair<Word, Word>, 15> kPairs = {
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
     {"pause", "resume"},
     {"reserve", "release"},
     {"claim", "release"},
     {"ignite", "extinguish"},
     {"inflate", "deflate"}}};

// What is no longer so as soon as it is begun: "UndockRobot" and "IsCharging";
// "OpenRoof" and "IsRoofClosed", of the same thing only.
struct Undone {
  Word deed;
  std::array<Word, 6> states;
  bool is_of_same;
};
constexpr Undone kUndone[] = {
    {"undock",
     {"dock", "docked", "charging", "charger", "connected", "plugged"},
     false},
    {"unplug", {"plugged", "charging", "connected"}, false},
    {"takeoff", {"landed", "ground", "grounded"}, false},
    {"release", {"holding", "gripped", "grasped", "held"}, false},
    {"depart", {"docked", "station", "parked"}, false},
    {"unpark", {"parked"}, false},
    {"open", {"closed", "shut", "locked", "sealed"}, true},
    {"close", {"open", "opened"}, true},
    {"shut", {"open", "opened"}, true},
    {"lock", {"unlocked", "open"}, true},
    {"unlock", {"locked"}, true},
    {"lower", {"raised", "lifted", "up"}, true},
    {"raise", {"lowered", "down"}, true},
    {"lift", {"lowered", "down"}, true},
    {"fold", {"unfolded"}, true},
    {"unfold", {"folded", "stowed"}, true},
    {"deploy", {"folded", "stowed", "retracted"}, true},
    {"stow", {"unfolded", "deployed", "extended"}, true},
    {"extend", {"retracted"}, true},
    {"retract", {"extended", "deployed"}, true},
    {"leave", {"at", "in", "inside"}, true},
    {"empty", {"full", "filled", "loaded"}, true},
    {"unload", {"full", "filled", "loaded"}, true},
    {"fill", {"empty"}, true},
    {"load", {"empty", "unloaded"}, true},
    {"start", {"stopped", "idle", "off"}, true},
    {"stop", {"running", "moving", "on"}, true},
    {"pick", {"free"}, true},
    {"attach", {"detached", "free"}, true},
    {"detach", {"attached"}, true}};

bool is_among(std::span<const Word> table, Word word) {
  return std::ranges::find(table, word) != table.end();
}

bool any_among(std::span<const Word> table, const Words& words) {
  return std::ranges::any_of(
      words, [&](const std::string& word) { return is_among(table, word); });
}

bool share_word(const Words& one, const Words& other) {
  return std::ranges::any_of(one, [&](const std::string& word) {
    return std::ranges::count(other, word) > 0;
  });
}

}  // namespace

std::optional<std::string> contract_name(std::string_view name) {
  const auto is_plain = [](char c) {
    return is_letter(c) || is_digit(c) || c == '_';
  };
  const auto is_unfit = [](char c) {
    return c == '"' || static_cast<unsigned char>(c) < ' ';
  };
  if (name.empty() || std::ranges::any_of(name, is_unfit)) return std::nullopt;
  if (std::ranges::all_of(name, is_plain)) return std::string(name);
  return '"' + std::string(name) + '"';
}

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

bool prepares(std::string_view deed) {
  const Words words = words_in(deed);
  return !words.empty() && is_among(kPreparing, words.front());
}

bool tells_of_moment(std::string_view condition) {
  return any_among(kMoments, words_in(condition));
}

bool only_sends(std::string_view name) {
  const Words words = words_in(name);
  return words.size() > 1 && is_among(kSending, words.front());
}

bool bounds_below(std::string_view port) {
  return any_among(kAtLeast, words_in(port));
}

bool bounds_above(std::string_view port) {
  return any_among(kAtMost, words_in(port));
}

bool undoes_at_once(std::string_view deed, std::string_view condition) {
  const Words done = words_in(deed);
  const Words asked = words_in(condition);
  const bool is_of_same = share_word(done, asked);
  return std::ranges::any_of(kUndone, [&](const Undone& row) {
    return std::ranges::count(done, row.deed) > 0 &&
           any_among(row.states, asked) && (is_of_same || !row.is_of_same);
  });
}

bool only_tells(std::string_view name) {
  const Words words = words_in(name);
  return !words.empty() && is_among(kTelling, words.front());
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
