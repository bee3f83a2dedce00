// SPDX-License-Identifier: MIT
//
// A tree with its suite, as `btcheck tests` makes it of one that no entry of
// the program decides about; and a test played again by `simulate --script`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "check/questions/defaults.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"
#include "suites/driven_entries.hpp"
#include "suites/formats.hpp"
#include "suites/suite.hpp"

namespace btcheck::suite_tests {

inline TreeInput input_of(const std::string& xml, bool loops = false,
                          const std::string& leaves = "") {
  TreeInput input("t.xml", xml);
  input.reading.profile = Profile::Btcpp4;
  input.reading.loops = loops;
  if (!leaves.empty()) input.reading.leaves = {{"t.leaves", leaves}};
  return input;
}

// All of it stays where it is: networks and systems point to each other.
struct MadeSuite {
  explicit MadeSuite(TreeInput of) : input(std::move(of)) {
    LoweredInput whole = *lowered_input(input, {}, TickSemantics::Root).value;
    reported_tree = std::move(whole.tree);
    reported_network = std::move(whole.network);
    driven = driven_tree(input, reported_tree, TickSemantics::Root);
    const CompiledNetwork reported(reported_network);
    const CompiledNetwork system(network());
    const ForcedNetwork asked(reported_tree, reported);
    const ForcedNetwork forced(tree(), system);
    const DefaultReport defaults =
        check_defaults(reported_tree, reported, Reduction::None, {});
    suite = make_suite(forced, asked, defaults, {}, {});
    described = described_suite(driven ? driven->input : input, tree());
    note_scripts(described, tree(), network(), suite);
  }
  MadeSuite(const MadeSuite&) = delete;
  MadeSuite& operator=(const MadeSuite&) = delete;

  const BehaviorTree& tree() const {
    return driven ? driven->lowered.tree : reported_tree;
  }
  const Network& network() const {
    return driven ? driven->lowered.network : reported_network;
  }

  TreeInput input;
  BehaviorTree reported_tree;
  Network reported_network;
  std::optional<DrivenTree> driven;
  Suite suite;
  DescribedSuite described;
};

inline std::vector<std::string> played(const MadeSuite& made,
                                       const SuiteTest& test) {
  return played_script(made.tree(), made.network(),
                       script_text(made.described, made.tree(), test),
                       static_cast<int>(test.ticks.size()));
}

inline std::vector<std::string> expected(const MadeSuite& made,
                                         const SuiteTest& test) {
  std::vector<std::string> all;
  for (const SuiteTick& tick : test.ticks) {
    all.push_back(tick_text(made.described, tick));
  }
  return all;
}

}  // namespace btcheck::suite_tests
