// SPDX-License-Identifier: MIT
//
// What the name of a leaf tells of it where nothing else does. A guess: for
// words and hints, never for what is checked.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace btcheck {

// The name as a file of leaf contracts has it, in quotes where it needs them.
// Nothing for one that cannot stand there: with quotes or line ends in it.
std::optional<std::string> contract_name(std::string_view name);

// The words of a name in small letters, numbers among them: "IsBatteryLow",
// "is_battery_low" and "isBatteryLOW" are {"is", "battery", "low"}.
std::vector<std::string> words_in(std::string_view name);

// Whether a leaf of this name asks something and does nothing: `IsReady`,
// `battery_ok`, `GoalReached`, `AltitudeAbove3`. In camel or in snake case.
bool sounds_like_condition(std::string_view id);

// What a condition says where it succeeds: that all is well ("BatteryOk",
// "WindBelowLimit", "NotStuck"), or that something is wrong ("IsBatteryLow").
enum class Tidings : unsigned char { Good, Bad, Neither };
Tidings tidings_of(std::string_view condition);

// Whether a leaf only looks, by its name: "CheckInbox", "ReadTool".
bool only_looks(std::string_view name);

// Whether what the condition asks is no longer so when the deed has begun:
// "UndockRobot" and "IsCharging", "OpenRoof" and "IsRoofClosed".
bool undoes_at_once(std::string_view deed, std::string_view condition);

// Whether by its name it makes ready what comes next: "CloseDrainValve".
bool prepares(std::string_view deed);

// Whether a condition is true for a moment only: "IsAttacked", "ButtonPressed".
bool tells_of_moment(std::string_view condition);

// Whether it tells a machine something, and is done at once: "PubGoal".
bool only_sends(std::string_view name);

// Whether a port has the least, or the most, that a value may be: "hp_min".
bool bounds_below(std::string_view port);
bool bounds_above(std::string_view port);

// Whether it only tells somebody: "LogNoSlot", "ReportFailure", "SayGoodbye".
bool only_tells(std::string_view name);

// Whether it goes on beside something else, without an end of its own:
// "CameraTrack", "PlayMusic".
bool goes_on_beside(std::string_view name);

// The name of what undoes it: "StopVacuum" for "StartVacuum"; "" for none. The
// words are those of the name, in the same order.
std::vector<std::string> words_of_undoing(std::string_view name);

}  // namespace btcheck
