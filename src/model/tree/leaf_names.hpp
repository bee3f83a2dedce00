// SPDX-License-Identifier: MIT
//
// What the name of a leaf tells of it where nothing else does. A guess: for
// words and hints, never for what is checked.
#pragma once

#include <string_view>

namespace btcheck {

// Whether a leaf of this name asks something and does nothing: `IsReady`,
// `battery_ok`, `GoalReached`, `AltitudeAbove3`. In camel or in snake case.
bool sounds_like_condition(std::string_view id);

}  // namespace btcheck
