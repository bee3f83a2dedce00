// SPDX-License-Identifier: MIT
//
// A suite as files: tests of GoogleTest and of pytest, and lines of JSON.
#pragma once

#include <string>
#include <vector>

#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"
#include "suites/described_suite.hpp"
#include "suites/suite.hpp"

namespace btcheck {

struct SuiteFile {
  std::string name;
  std::string text;
};

// All that is written into a folder begins with a line that has these words, or
// has them in its first object: so it is known again.
inline constexpr std::string_view kSuiteMark = "Written by `btcheck tests`";

// NAME_test.cpp, and the CMakeLists.txt of its folder. Of trees of
// BehaviorTree.CPP.
std::vector<SuiteFile> googletest_files(const DescribedSuite& described,
                                        const BehaviorTree& tree,
                                        const Suite& suite);

// test_NAME.py. `program` has the words that read the tree: "simulate",
// "robot.xml", "--leaves", "robot.leaves"; files are named from the folder.
SuiteFile pytest_file(const DescribedSuite& described, const BehaviorTree& tree,
                      const Suite& suite,
                      const std::vector<std::string>& program);

// NAME.tests.jsonl: a line for the suite and one for each test.
SuiteFile jsonl_file(const DescribedSuite& described, const BehaviorTree& tree,
                     const Suite& suite);

// "root=running Navigate=running": a tick as `btcheck simulate` has it, without
// its number and the variables; "throws".
std::string tick_text(const DescribedSuite& described, const SuiteTick& tick);

// The script of a test, as `btcheck simulate --script` reads it.
std::string script_text(const DescribedSuite& described,
                        const BehaviorTree& tree, const SuiteTest& test);
// The ticks of such a script, as tick_text has them; where it asks for what the
// tree cannot do, that message is the last.
std::vector<std::string> played_script(const BehaviorTree& tree,
                                       const Network& network,
                                       const std::string& script, int ticks);
// Finds out which tests a script can play: not all of what a leaf writes by a
// port can be said in one.
void note_scripts(const DescribedSuite& described, const BehaviorTree& tree,
                  const Network& network, Suite& suite);

// "running*2 success", of answers in a row.
std::string answers_text(const std::vector<LeafAnswer>& answers);

}  // namespace btcheck
