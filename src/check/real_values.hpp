// SPDX-License-Identifier: MIT
//
// Runs over blackboard entries, executed with the real values.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "check/bind/verdict.hpp"
#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// Why the engine cannot take a run: a script comes out otherwise.
struct Refutation {
  std::int32_t program = kNoProgram;
  std::string words;  // "`battery > 20` cannot be false: battery is 199"
};

// A state variable of an entry may stand for many values, and a script over
// them may then come out either way. Executes all scripts of the run on real
// values, which only the program around the tree may know; a loop until its
// values come again, or nothing in it is left open. Nothing when the engine can
// take the run.
std::optional<Refutation> refutation_of(const BehaviorTree& tree,
                                        const Network& network, const Run& run);

// The groups of entries that a program is about (btcpp::ProgramEntry).
std::set<std::size_t> groups_of(const BehaviorTree& tree, std::int32_t program);

// Of the entries that scripts alone write: where a state variable says less
// than the engine knows.
std::set<std::size_t> rough_groups(const BehaviorTree& tree);
// "`n`: it takes more than 128 values (line 3)", for all of these groups.
std::string rough_words(const BehaviorTree& tree,
                        const std::set<std::size_t>& groups);

}  // namespace btcheck
