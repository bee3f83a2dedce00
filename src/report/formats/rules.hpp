// SPDX-License-Identifier: MIT
//
// The kinds of things that btcheck finds, by their codes.
#pragma once

#include <span>
#include <string_view>

#include "cli/codes/codes.hpp"

namespace btcheck {

// A kind of verdict or finding that is worth reporting.
using Rule = CodeRow;

// In the order of their codes.
std::span<const Rule> rules();

namespace rule {
inline constexpr std::string_view kViolated = "BT2001";
inline constexpr std::string_view kHolds = "BT2002";
inline constexpr std::string_view kUndecided = "BT2003";
inline constexpr std::string_view kVacuous = "BT2004";
inline constexpr std::string_view kFault = "BT2101";
inline constexpr std::string_view kZeroTimeLoop = "BT2102";
inline constexpr std::string_view kStuck = "BT2103";
inline constexpr std::string_view kCannotEnd = "BT2104";
inline constexpr std::string_view kCannotSucceed = "BT2105";
inline constexpr std::string_view kNeverTicked = "BT2201";
inline constexpr std::string_view kNeverSucceeds = "BT2202";
inline constexpr std::string_view kAlwaysTrue = "BT2203";
inline constexpr std::string_view kNeverTrue = "BT2204";
inline constexpr std::string_view kStaleGuards = "BT2205";
inline constexpr std::string_view kLeftRunning = "BT2206";
inline constexpr std::string_view kInternal = "BT9002";
}  // namespace rule

// The rule of that code; nullptr for the code of a diagnostic.
const Rule* rule_of(std::string_view code);

// What a diagnostic of that code is about, in a few words without a full stop;
// for a code that is not known, words that fit every one.
std::string_view diagnostic_summary(std::string_view code);

}  // namespace btcheck
