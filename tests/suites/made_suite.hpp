// SPDX-License-Identifier: MIT
//
// A tree with its suite, as `btcheck tests` makes it of one that no entry of
// the program decides about; and a test played again by `simulate --script`.
#pragma once

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "check/questions/defaults.hpp"
#include "check/simulate/course.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"
#include "suites/driven_entries.hpp"
#include "suites/formats.hpp"
#include "suites/suite.hpp"
#include "trace/formats/text.hpp"

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

// The ticks of a script, as TickLines has them, without number and variables;
// with an error at the end where the script asks for what cannot be.
inline std::vector<std::string> played(const BehaviorTree& tree,
                                       const Network& network,
                                       const std::string& script, int ticks) {
  std::vector<std::string> all;
  TickLines lines(tree, network);
  const auto take = [&](const std::string& line) {
    if (line.empty()) return;
    std::istringstream words(line.substr(line.find(": ") + 2));
    std::string text;
    for (std::string word; words >> word;) {
      const std::string name = word.substr(0, word.find('='));
      if (std::ranges::count(tree.variables, name, &StateVariable::name) > 0) {
        continue;
      }
      text += (text.empty() ? "" : " ") + word;
    }
    all.push_back(text.starts_with("root=none") ? "throws" : text);
  };
  Course course;
  course.ticks = ticks;
  course.told = [&](const Valuation&, const RunStep& step) {
    take(lines.take(step));
  };
  const SourceText source("script", script);
  const auto run = simulated_by_script(tree, network, source, course);
  if (run.value) {
    const std::string rest = lines.rest(run.value->state());
    if (!rest.empty()) take(rest.substr(0, rest.find('\n')));
  }
  if (has_error(run.diagnostics)) all.push_back(run.diagnostics[0].message);
  return all;
}

inline std::vector<std::string> played(const MadeSuite& made,
                                       const SuiteTest& test) {
  return played(made.tree(), made.network(),
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
