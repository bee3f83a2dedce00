// SPDX-License-Identifier: MIT
//
// Answers that rest on values that the engine does not have.
#pragma once

#include <cstddef>
#include <optional>
#include <set>

#include "check/check.hpp"
#include "model/btcpp/expand/expansion.hpp"

namespace btcheck {

// The groups of entries because of which the engine may not do what was found:
// the real values make another run of it; or the answer is a verdict of
// branching time, or what can always still happen, and entries are told apart
// too roughly. Nothing where no answer is in doubt.
std::optional<std::set<std::size_t>> groups_in_doubt(const CheckResult& result);

// Has these groups told apart more closely; false when they are already told
// apart as closely as it is tried, or there is nothing to tell apart.
bool look_closer(const BehaviorTree& tree, const std::set<std::size_t>& groups,
                 btcpp::ScriptDetail& detail);

// Makes every such answer undecided, with the reason.
void withdraw_doubtful(CheckResult& result);

}  // namespace btcheck
