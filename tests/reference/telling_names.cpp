// SPDX-License-Identifier: MIT
#include "reference/telling_names.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <string_view>
#include <utility>
#include <vector>

#include "reference/random_tree.hpp"

namespace btcheck::reference {
namespace {

using Names = std::vector<std::string_view>;

Names shuffled(Names names, SplitMix64& random) {
  for (std::size_t i = names.size(); i > 1; --i) {
    const int other = random.below(static_cast<int>(i));
    std::swap(names[i - 1], names[static_cast<std::size_t>(other)]);
  }
  return names;
}

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// The name for "a3" or "c2"; the word itself where it is none of these.
std::string_view name_for(std::string_view word, const Names& deeds,
                          const Names& conditions) {
  if (word.size() < 2 || (word[0] != 'a' && word[0] != 'c')) return word;
  std::size_t number = 0;
  const auto [end, fault] =
      std::from_chars(word.data() + 1, word.data() + word.size(), number);
  const Names& names = word[0] == 'a' ? deeds : conditions;
  const bool is_leaf = fault == std::errc{} &&
                       end == word.data() + word.size() && number > 0 &&
                       number <= names.size();
  return is_leaf ? names[number - 1] : word;
}

}  // namespace

std::string with_telling_names(const std::string& text, std::uint64_t seed) {
  SplitMix64 random(seed);
  const Names deeds =
      shuffled({"OpenGripper", "CloseGripper", "StartVacuum", "StopVacuum",
                "ArmMotors", "DisarmMotors", "MoveToShelf", "Reverse", "Land",
                "RaiseAlarm", "PlayMusic", "CheckInbox", "LoadCup", "HandOver",
                "Charge", "ReportError"},
               random);
  const Names conditions =
      shuffled({"IsBatteryLow", "BatteryOk", "IsStuck", "NotStuck",
                "GoalReached", "IsDoorOpen", "ObstacleNear", "PathValid",
                "IsCharging", "IsVacuumOn", "Cancelled", "GripperClosed"},
               random);
  std::string named;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_word(text[end])) ++end;
    if (end == at) {
      named += text[at++];
      continue;
    }
    named += name_for(std::string_view(text).substr(at, end - at), deeds,
                      conditions);
    at = end;
  }
  return named;
}

}  // namespace btcheck::reference
