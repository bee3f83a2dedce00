// SPDX-License-Identifier: MIT
//
// Answers that rest on values that the engine does not have.
#pragma once

#include <cstddef>
#include <set>

#include "check/check.hpp"
#include "model/btcpp/expand/expansion.hpp"

namespace btcheck {

// The groups of entries because of which something that was found is not what
// the engine does: a run of which the real values make another one, or a
// verdict of branching time, or what can always still happen, where entries are
// told apart too roughly to know.
std::set<std::size_t> groups_in_doubt(const CheckResult& result);

// Has these groups told apart more closely; false when they are already told
// apart as closely as it is tried, or there is nothing to tell apart.
bool look_closer(const BehaviorTree& tree, const std::set<std::size_t>& groups,
                 btcpp::ScriptDetail& detail);

// Makes every such answer undecided, with the reason.
void withdraw_doubtful(CheckResult& result);

}  // namespace btcheck
