// SPDX-License-Identifier: MIT
//
// Does a path demonstrate what it is said to?
#pragma once

#include "ltl/branching/ctl.hpp"
#include "reference/naive_ctl.hpp"

namespace btcheck::reference {

// What is wrong with a path that is said to begin in `start` and to show the
// claim, nullptr for nothing. What it leaves unshown must be true, and
// together with that it must be a proof, made from the labels alone.
const char* flaw(const ToySystem& system, const NaiveCtl& naive,
                 const std::vector<NaiveFairness>& conditions,
                 const FormulaPool& pool, const GraphPath& path, Claim claim,
                 std::uint32_t start);

}  // namespace btcheck::reference
