// SPDX-License-Identifier: MIT
//
// Memory of what nodes have answered in the tick that is going on: a status is
// reset when its node is called again, or by its parent, in mid-tick.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "model/automata/network.hpp"

namespace btcheck {

// The name of the local that remembers, and its value before any answer:
// `none`.
inline constexpr std::string_view kAnswerName = "answer";
inline constexpr int kNoAnswer = 0;

// What is remembered, in the order of its values behind `none`.
inline constexpr std::array<std::pair<LocationRole, std::string_view>, 4>
    kAnswers = {{{LocationRole::Success, "success"},
                 {LocationRole::Failure, "failure"},
                 {LocationRole::Running, "running"},
                 {LocationRole::Skipped, "skipped"}}};

// Gives each of these nodes, and the root of its tree, an `answer`: the last
// one since its root began to tick, `none` before that. A halt is no answer.
// All are forgotten with the step that leaves the root's own answer; where the
// root stays there for ever, by a step of its own, before time passes. So a
// tick ends exactly in the states in which its root's answer is not `none`.
// Nodes that have one already keep it.
void remember_answers(const BehaviorTree& tree, std::span<const NodeId> nodes,
                      Network& network);

// What remembers the answers of the node, if anything does.
std::optional<VariableId> answer_of(const Network& network, NodeId node);

}  // namespace btcheck
