// SPDX-License-Identifier: MIT
//
// What tests are called: after what each shows that no other does.
#pragma once

#include <vector>

#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "suites/suite.hpp"

namespace btcheck {

// Gives each test a name of its own, and those without one what they are about.
void name_tests(const BehaviorTree& tree, const Network& network,
                std::vector<SuiteTest>& tests);

}  // namespace btcheck
